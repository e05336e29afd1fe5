/// @file
/// The gate in front of tinyobjloader, which accepts many bad files silently and crashes on some. Every statement of a file is checked
/// first; the result is a text that cannot be misread.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mesh/io/polygon_list.h"
#include "mesh/io/text_scanner.h"

namespace meshfolio {

struct CheckedObj {
    std::vector<double> coordinates;   // x y z of each vertex, correctly rounded
    std::vector<double> colors;        // r g b of each vertex with a colour
    std::vector<int> colored;          // the vertices with a colour
    std::string text;                  // "f a b c …" only, one face a line, indices counted from 1
    std::vector<long> face_lines;      // in the file, of each "f" of the text
    WarningTally warnings;
    bool free_form = false;   // there were free-form surfaces
    std::string unknown;      // the first unknown statement and its line, for messages; empty: none
};

/// Checks every number, index and keyword of an OBJ file and returns the facts that the reader needs. Too large indices pass, because faces
/// may name vertices that come later.
/// @throws InputError with the physical line
CheckedObj check_obj(std::string_view text, const std::string& file);

/// Iterates over the statements of an OBJ file: lines with a word, continued lines joined, comments left out. A line that ends in "\\" is
/// continued, unless the next line begins with a keyword and the statement is no position or face: names may end so ("g C:\\parts\\").
class ObjStatements {
public:
    explicit ObjStatements(std::string_view text) : start_(text.data()), lines_(text) {}

    bool next();   // false at the end of the text

    std::string_view text() const { return statement_; }                // valid until the next call of next()
    long line() const { return line_; }                                 // its first line, from 1
    std::size_t begin() const { return begin_; }                        // offset of its first line in the text
    std::size_t end() const { return lines_.offset(); }                 // offset behind its last line and its line end
    bool is_cut_off() const { return cut_off_; }                        // continued beyond the end of the text
    bool ends_before_keyword() const { return ends_before_keyword_; }   // ends in "\\" that does not continue it

private:
    const char* start_;
    LineScanner lines_;
    std::string_view statement_;
    std::string joined_;
    long line_ = 0;
    std::size_t begin_ = 0;
    bool cut_off_ = false, ends_before_keyword_ = false;
};

}   // namespace meshfolio
