#include "submission/source_listing.h"

#include <algorithm>
#include <cctype>

namespace meshfolio::submission {

namespace {

bool is_name_character(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == ':' || c == '~'; }

/// Returns the name of the type or function that the line begins to define or declare; empty: none. A '=' tells variables apart.
std::string_view name_in(std::string_view line) {
    if (line.empty() || line.starts_with("template") || line.find_first_of(" #}/\"") == 0) return {};
    for (const std::string_view kind : {"class ", "struct ", "union ", "enum class ", "enum "}) {
        if (!line.starts_with(kind)) continue;
        const std::string_view rest = line.substr(kind.size());
        return rest.substr(0, static_cast<std::size_t>(std::ranges::find_if_not(rest, is_name_character) - rest.begin()));
    }
    std::size_t end = 0;   // of the name: the first parenthesis outside angle brackets
    for (int angles = 0; end < line.size() && (line[end] != '(' || angles != 0); ++end)
        angles += line[end] == '<' ? 1 : line[end] == '>' ? -1 : 0;
    if (end == line.size() || line.substr(0, end).find('=') != line.npos) return {};
    std::size_t begin = end;
    while (begin > 0 && is_name_character(line[begin - 1])) --begin;
    return line.substr(begin, end - begin);
}

/// True if a body follows, false if the text ends as a declaration.
bool is_definition(std::string_view text) {
    int parentheses = 0;
    for (const char c : text) {
        parentheses += c == '(' ? 1 : c == ')' ? -1 : 0;
        if (parentheses == 0 && (c == '{' || c == ';')) return c == '{';
    }
    return false;
}

}   // namespace

long definition_line(std::string_view cpp, std::string_view name) {
    long number = 0, line_of_member = 0;
    for (std::string_view rest = cpp; !rest.empty();) {
        const std::string_view line = rest.substr(0, rest.find('\n')), found = name_in(line);
        ++number;
        if (!name.empty() && found.ends_with(name) && is_definition(rest)) {
            if (found.size() == name.size()) return number;
            if (line_of_member == 0 && found.substr(0, found.size() - name.size()).ends_with("::")) line_of_member = number;
        }
        rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    }
    return line_of_member;
}

}   // namespace meshfolio::submission
