#include "submission/source_listing.h"

#include <algorithm>
#include <cctype>

namespace meshfolio::submission {

namespace {

constexpr auto none = std::string_view::npos;

bool is_of_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == ':' || c == '~'; }

std::string_view name_at_end(std::string_view text) {
    std::size_t begin = text.size();
    while (begin > 0 && is_of_name(text[begin - 1])) --begin;
    return text.substr(begin);
}

/// Of the first parenthesis outside angle brackets.
std::size_t first_parenthesis(std::string_view line) {
    int angles = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '(' && angles == 0) return i;
        angles += line[i] == '<' ? 1 : line[i] == '>' ? -1 : 0;
    }
    return none;
}

/// The name of a type or a function that the line begins to define or to declare; empty: none. Variables are set by '='.
std::string_view name_in(std::string_view line) {
    if (line.empty() || line.starts_with("template") || line.find_first_of(" #}/\"") == 0) return {};
    for (const std::string_view kind : {"class ", "struct ", "union ", "enum class ", "enum "}) {
        if (!line.starts_with(kind)) continue;
        const std::string_view rest = line.substr(kind.size());
        return rest.substr(0, static_cast<std::size_t>(std::find_if_not(rest.begin(), rest.end(), is_of_name) - rest.begin()));
    }
    const std::size_t parenthesis = first_parenthesis(line);
    if (parenthesis == none || line.substr(0, parenthesis).find('=') != none) return {};
    return name_at_end(line.substr(0, parenthesis));
}

/// Whether a body follows, rather than the end of a declaration.
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
    long number = 0, of_member = 0;
    for (std::string_view rest = cpp; !rest.empty();) {
        const std::string_view line = rest.substr(0, rest.find('\n')), found = name_in(line);
        ++number;
        if (!name.empty() && found.ends_with(name) && is_definition(rest)) {
            if (found.size() == name.size()) return number;
            if (of_member == 0 && found.substr(0, found.size() - name.size()).ends_with("::")) of_member = number;
        }
        rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    }
    return of_member;
}

}   // namespace meshfolio::submission
