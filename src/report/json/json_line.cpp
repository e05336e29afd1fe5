#include "report/json/json_line.h"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <vector>

namespace meshfolio::report {

namespace {

using Unordered = nlohmann::json;

/// Walks through the text and tracks how far the parser has read: at a value, to its last character or one further.
class CountingIterator {
public:
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;

    CountingIterator(const char* at, const char** furthest) : at_(at), furthest_(furthest) {}
    const char& operator*() const { return *at_; }
    CountingIterator& operator++() {
        *furthest_ = at_++;
        return *this;
    }
    bool operator==(const CountingIterator& other) const { return at_ == other.at_; }
    bool operator!=(const CountingIterator& other) const { return at_ != other.at_; }

private:
    const char* at_;
    const char** furthest_;
};

}   // namespace

long line_of_json(std::string_view text, const std::string& path) {
    using Event = Unordered::parse_event_t;
    struct Level {
        std::string path;
        bool is_list;
        std::size_t index = 0;
    };
    std::vector<Level> levels;
    std::string member;   // path of the value of the last key
    const auto next_path = [&] {
        if (levels.empty()) return std::string();
        if (!levels.back().is_list) return member;
        return levels.back().path + "[" + std::to_string(levels.back().index++) + "]";
    };
    const char *furthest = text.data(), *found = nullptr;
    const auto see = [&](int, Event event, Unordered& value) {
        if (event == Event::object_end || event == Event::array_end) {
            levels.pop_back();
        } else if (event == Event::key) {
            const std::string& before = levels.back().path;
            member = before + (before.empty() ? "" : ".") + value.get<std::string>();
        } else {
            const std::string here = next_path();
            if (found == nullptr && here == path) found = furthest;
            if (event != Event::value) levels.push_back({here, event == Event::array_start});
        }
        return true;
    };
    const char* const end = text.data() + text.size();
    const Unordered whole = Unordered::parse(CountingIterator(text.data(), &furthest), CountingIterator(end, &furthest), see, false);
    return whole.is_discarded() || found == nullptr ? 0 : line_of_byte(text, static_cast<std::size_t>(found - text.data()));
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
