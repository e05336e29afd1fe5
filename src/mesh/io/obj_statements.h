/// @file
/// The statements of an OBJ file: lines with a word, continued lines joined, comments left out.
#pragma once

#include <string>
#include <string_view>

#include "mesh/io/text_scanner.h"

namespace meshfolio {

class ObjStatements {
public:
    explicit ObjStatements(std::string_view text) : start_(text.data()), lines_(text) {}

    bool next();   // false at the end of the text

    std::string_view text() const { return statement_; }   // until the next one
    long line() const { return line_; }                    // on which it begins, from 1
    std::size_t begin() const { return begin_; }           // of its first line in the text
    std::size_t end() const { return lines_.offset(); }    // of its last line, behind what ends it
    bool is_cut_off() const { return cut_off_; }           // continued beyond the end of the text

private:
    const char* start_;
    LineScanner lines_;
    std::string_view statement_;
    std::string joined_;
    long line_ = 0;
    std::size_t begin_ = 0;
    bool cut_off_ = false;
};

}   // namespace meshfolio
