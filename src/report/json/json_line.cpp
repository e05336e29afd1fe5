#include "report/json/json_line.h"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <vector>

namespace meshfolio::report {

namespace {

using Unordered = nlohmann::json;

/// Walks through the text and counts how far the parser has read: at a value, its last character or one beyond.
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

/// Follows the path of each value as the parser meets it and stops at the one that is looked for.
class PathFinder : public Unordered::json_sax_t {
public:
    explicit PathFinder(std::string wanted) : wanted_(std::move(wanted)) {}
    bool is_found() const { return found_; }

    bool null() override { return value(); }
    bool boolean(bool) override { return value(); }
    bool number_integer(number_integer_t) override { return value(); }
    bool number_unsigned(number_unsigned_t) override { return value(); }
    bool number_float(number_float_t, const string_t&) override { return value(); }
    bool string(string_t&) override { return value(); }
    bool binary(binary_t&) override { return value(); }
    bool start_object(std::size_t) override { return open(false); }
    bool start_array(std::size_t) override { return open(true); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }
    bool key(string_t& name) override {
        const std::string& before = levels_.back().path;
        next_ = before + (before.empty() ? "" : ".") + name;
        return true;
    }
    bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override { return false; }

private:
    struct Level {
        std::string path;
        bool is_list;
        std::size_t index = 0;
    };
    std::string wanted_, next_;
    std::vector<Level> levels_;
    bool found_ = false;

    /// The path of the value that begins now.
    std::string here() {
        if (levels_.empty()) return "";
        if (!levels_.back().is_list) return next_;
        return levels_.back().path + "[" + std::to_string(levels_.back().index++) + "]";
    }
    bool value() { return !(found_ = here() == wanted_); }
    bool open(bool is_list) {
        levels_.push_back({here(), is_list});
        return !(found_ = levels_.back().path == wanted_);
    }
    bool close() {
        levels_.pop_back();
        return true;
    }
};

}   // namespace

long line_of_json(std::string_view text, const std::string& path) {
    PathFinder finder(path);
    const char* furthest = text.data();
    Unordered::sax_parse(CountingIterator(text.data(), &furthest), CountingIterator(text.data() + text.size(), &furthest), &finder);
    return finder.is_found() ? line_of_byte(text, static_cast<std::size_t>(furthest - text.data())) : 0;
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
