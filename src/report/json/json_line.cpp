#include "report/json/json_line.h"

#include <algorithm>
#include <vector>

namespace meshfolio::report {

long line_of_json(std::string_view text, const std::string& path) {
    constexpr std::string_view between = " \t\r\n:";
    struct Level {
        std::string path;
        bool is_list;
        std::size_t index = 0;
    };
    std::vector<Level> levels;
    std::string member;    // path of the value of the last key
    bool is_key = false;   // the next text is a key
    for (std::size_t at = 0, end = 0; (at = text.find_first_not_of(between, end)) < text.size();) {
        const char c = text[at];
        end = at + 1;
        if (c == '}' || c == ']') {
            if (!levels.empty()) levels.pop_back();
        } else if (c == ',') {
            is_key = !levels.empty() && !levels.back().is_list;
        } else {
            if (c == '"') {
                while (end < text.size() && text[end] != '"') end += text[end] == '\\' ? 2 : 1;
                ++end;
            } else if (c != '{' && c != '[') {
                end = text.find_first_of(" \t\r\n:,]}", end);
            }
            const std::string before = levels.empty() ? "" : levels.back().path;
            if (is_key) {
                member = before + (before.empty() ? "" : ".") + std::string(text.substr(at + 1, end - at - 2));
                is_key = false;
                continue;
            }
            const bool is_entry = !levels.empty() && levels.back().is_list;
            const std::string here = is_entry ? before + "[" + std::to_string(levels.back().index++) + "]" : member;
            if (here == path) return line_of_byte(text, at);
            if (c == '{' || c == '[') levels.push_back({here, c == '['});
            is_key = c == '{';
        }
    }
    return 0;
}

std::optional<std::size_t> deeper_than(int levels, std::string_view text) {
    int depth = 0;
    bool in_text = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '"') {
            in_text = !in_text;
        } else if (in_text) {
            if (c == '\\') ++i;
        } else if (c == '[' || c == '{') {
            if (++depth > levels) return i;
        } else if (c == ']' || c == '}') {
            --depth;
        }
    }
    return {};
}

long line_of_byte(std::string_view text, std::size_t byte) {
    const std::string_view before = text.substr(0, byte);
    return 1 + std::count(before.begin(), before.end(), '\n');
}

}   // namespace meshfolio::report
