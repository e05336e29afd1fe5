#include "mesh/io/text_scanner.h"

#include <algorithm>

#include "base/errors.h"
#include "base/lower_case.h"

namespace meshfolio {

static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

std::string_view take_word(std::string_view& line) {
    std::size_t begin = 0;
    while (begin < line.size() && is_blank(line[begin])) ++begin;
    std::size_t end = begin;
    while (end < line.size() && !is_blank(line[end])) ++end;
    const std::string_view word = line.substr(begin, end - begin);
    line.remove_prefix(end);
    return word;
}

std::string_view without_bom(std::string_view text) {
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    return text;
}

std::string_view without_leading_space(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
    return text;
}

bool same_but_for_case(std::string_view a, std::string_view b) {
    const auto lower = [](char c) { return lower_case(c); };
    return std::ranges::equal(a, b, {}, lower, lower);
}

std::string_view without_comment(std::string_view line) {
    for (std::size_t i = line.find('#'); i != std::string_view::npos; i = line.find('#', i + 1))
        if (i == 0 || is_blank(line[i - 1])) return line.substr(0, i);
    return line;
}

void refuse_nul_bytes(std::string_view text, const std::string& file) {
    const std::size_t nul = text.find('\0');
    if (nul == std::string_view::npos) return;
    LineScanner lines(text);
    while (lines.next() && lines.offset() <= nul) {
    }
    throw InputError({file, lines.number()}, "NUL byte, which no text has", "is this binary data or UTF-16 text?");
}

LineScanner::LineScanner(std::string_view text) : text_(text), has_returns_(text.find('\r') != std::string_view::npos) {}

bool LineScanner::next() {
    if (offset_ >= text_.size()) return false;
    const std::string_view rest = text_.substr(offset_);
    const std::size_t end = std::min(has_returns_ ? rest.find_first_of("\r\n") : rest.find('\n'), rest.size());
    line_ = rest.substr(0, end);
    offset_ += std::min(rest.size(), end + (rest.substr(end).starts_with("\r\n") ? 2 : 1));
    ++number_;
    return true;
}

bool LineScanner::next_with_words() {
    while (next()) {
        line_ = without_comment(line_);
        if (std::any_of(line_.begin(), line_.end(), [](char c) { return !is_blank(c); })) return true;
    }
    return false;
}

std::string_view WordScanner::next() {
    for (;;) {
        const std::string_view word = take_word(rest_);
        if (!word.empty()) return word;
        if (!lines_.next_with_words()) return {};
        rest_ = lines_.line();
    }
}

}   // namespace meshfolio
