/// @file
/// Lines and words of text files, each with the number of the physical line it stands on.
#pragma once

#include <string>
#include <string_view>

namespace meshfolio {

/// Removes the first word from `line` and returns it; empty if only white space is left.
std::string_view take_word(std::string_view& line);

/// Returns the text without the UTF-8 byte order mark that some editors put in front.
std::string_view without_bom(std::string_view text);

/// Returns `text` without white space and line ends at its beginning.
std::string_view without_leading_space(std::string_view text);

/// True if the words are equal but for the case of ASCII letters.
bool same_but_for_case(std::string_view a, std::string_view b);

/// Returns the line without its comment, which begins with a '#' at the start of a word. ("-1.#IND" is a bad number.)
std::string_view without_comment(std::string_view line);

/// Checks that a text has no NUL byte. @throws InputError at the line of the first one
void refuse_nul_bytes(std::string_view text, const std::string& file);

/// Iterates over the lines of a text. They may end in \n, \r\n or \r.
class LineScanner {
public:
    explicit LineScanner(std::string_view text);

    /// Moves to the next line; false at the end of the text.
    bool next();
    /// Moves to the next line that has a word outside of comments. `line()` is then without the comment.
    bool next_with_words();

    std::string_view line() const { return line_; }
    long number() const { return number_; }          // of line(), from 1
    std::size_t offset() const { return offset_; }   // of the byte behind line() and its end

private:
    std::string_view text_;
    std::string_view line_;
    std::size_t offset_ = 0;
    long number_ = 0;
    bool has_returns_;   // found once: most files have none
};

/// Iterates over the words of a text, on all its lines, without comments ("# …").
class WordScanner {
public:
    explicit WordScanner(std::string_view text) : lines_(text) {}

    /// Returns the next word on this or a later line; empty at the end of the text.
    std::string_view next();
    /// Returns the next word of the current line; empty at its end.
    std::string_view next_on_line() { return take_word(rest_); }
    /// Skips the rest of the current line.
    void skip_line() { rest_ = {}; }

    long line() const { return lines_.number(); }
    std::string_view rest_of_line() const { return rest_; }
    std::size_t offset() const { return lines_.offset() - rest_.size(); }   // bytes read so far, about

private:
    LineScanner lines_;
    std::string_view rest_;
};

}   // namespace meshfolio
