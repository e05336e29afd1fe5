/// @file
/// Running text as data, without markup. The writers escape it for their format.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace meshfolio::report {

struct Run {
    enum class Kind { plain, strong, emphasis, code, math, reference };
    Kind kind = Kind::plain;
    std::string content;   // mathematics in Unicode: "λ_crit = 2/μ_max"; of a reference the id of its target
    bool operator==(const Run&) const = default;
};

using Text = std::vector<Run>;

inline Run strong(std::string s) { return {Run::Kind::strong, std::move(s)}; }
inline Run emphasis(std::string s) { return {Run::Kind::emphasis, std::move(s)}; }
inline Run code(std::string s) { return {Run::Kind::code, std::move(s)}; }
inline Run math(std::string s) { return {Run::Kind::math, std::move(s)}; }
inline Run ref(std::string id) { return {Run::Kind::reference, std::move(id)}; }

namespace detail {
/// Appends a run to a text; a plain run continues a plain run at its end.
inline void append(Text& text, Run run) {
    if (run.kind == Run::Kind::plain && !text.empty() && text.back().kind == Run::Kind::plain) text.back().content += run.content;
    else text.push_back(std::move(run));
}
inline void append(Text& text, std::string s) { append(text, Run{Run::Kind::plain, std::move(s)}); }
inline void append(Text& text, const char* s) { append(text, std::string(s)); }
inline void append(Text& text, const Text& more) {
    for (const Run& run : more) append(text, run);
}
}   // namespace detail

/// Appends words, runs and texts to a text.
template <class... Parts> void extend(Text& text, Parts&&... parts) { (detail::append(text, std::forward<Parts>(parts)), ...); }

/// Joins words, runs and texts: text("The error is ", readable(e), " (", ref("q1_errors"), ").").
template <class... Parts> Text text(Parts&&... parts) {
    Text joined;
    extend(joined, std::forward<Parts>(parts)...);
    return joined;
}

/// Returns the words of a text without markup; of references the ids.
std::string plain(const Text& text);

}   // namespace meshfolio::report
