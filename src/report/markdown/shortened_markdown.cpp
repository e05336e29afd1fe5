#include "report/markdown/shortened_markdown.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <set>
#include <vector>

namespace meshfolio::report {

namespace {

/// The parts under a title of the second order, each with the anchor above its title.
std::vector<std::string> parts_of(const std::string& text) {
    std::vector<std::string> parts;
    std::size_t begin = 0;
    for (std::size_t title = text.find("\n## "); title != std::string::npos; title = text.find("\n## ", title + 1)) {
        const std::size_t line_before = text.rfind('\n', title - std::min<std::size_t>(title, 2)) + 1;
        const std::size_t start = text.compare(line_before, 7, "<a id=\"") == 0 ? line_before : title + 1;
        parts.push_back(text.substr(begin, start - begin));
        begin = start;
    }
    parts.push_back(text.substr(begin));
    return parts;
}

/// Does a part answer a question of the assignment? "## 4 Spectral reconstruction", where the others have letters or no number.
bool is_answer(const std::string& part) {
    const std::size_t title = part.find("## ");
    return title != std::string::npos && title + 3 < part.size() && part[title + 3] >= '0' && part[title + 3] <= '9';
}

/// The length that parts may have for all together to have at most `size`; those that are `kept` have theirs.
std::size_t length_for(const std::vector<std::string>& parts, std::size_t size, const std::function<bool(const std::string&)>& kept) {
    const auto size_with = [&](std::size_t longest) {
        std::size_t sum = 0;
        for (const std::string& part : parts) sum += kept(part) ? part.size() : std::min(part.size(), longest);
        return sum;
    };
    std::size_t fits = 0, too_long = size;
    while (too_long - fits > 1) {
        const std::size_t middle = fits + (too_long - fits) / 2;
        (size_with(middle) <= size ? fits : too_long) = middle;
    }
    return fits;
}

using Paragraphs = std::vector<std::string>;   // each with the empty line after it

Paragraphs paragraphs_of(const std::string& part) {
    Paragraphs paragraphs;
    for (std::size_t begin = 0; begin < part.size();) {
        const std::size_t gap = part.find("\n\n", begin);
        const std::size_t end = gap == std::string::npos ? part.size() : gap + 2;
        paragraphs.push_back(part.substr(begin, end - begin));
        begin = end;
    }
    return paragraphs;
}

std::string join(const Paragraphs& paragraphs) { return std::accumulate(paragraphs.begin(), paragraphs.end(), std::string()); }

std::size_t size_of(const Paragraphs& paragraphs) {
    return std::accumulate(paragraphs.begin(), paragraphs.end(), std::size_t{0},
                           [](std::size_t sum, const std::string& paragraph) { return sum + paragraph.size(); });
}

/// The rows to drop first, as their caption links the CSV file: those of the smallest table whose loss is enough, else of the largest.
/// The end: no table is worth dropping.
Paragraphs::iterator dispensable_rows(Paragraphs& paragraphs, std::size_t enough) {
    constexpr std::size_t worth_dropping = 500;
    auto chosen = paragraphs.end();
    for (auto it = paragraphs.begin(); it != paragraphs.end(); ++it) {
        if (it == paragraphs.begin() || it->front() != '|' || it->size() < worth_dropping || !std::prev(it)->starts_with("**Table "))
            continue;
        if (chosen == paragraphs.end() ||
            (chosen->size() < enough ? it->size() > chosen->size() : it->size() >= enough && it->size() < chosen->size()))
            chosen = it;
    }
    return chosen;
}

/// The paragraphs from the last title on: what is concluded.
Paragraphs last_words(const Paragraphs& paragraphs) {
    for (std::size_t i = paragraphs.size(); i-- > 0;) {
        if (paragraphs[i].starts_with("### ")) return {paragraphs.begin() + static_cast<std::ptrdiff_t>(i), paragraphs.end()};
    }
    return {};
}

/// A part without what is left out of it: first rows of tables, then what stands before its last title, where the conclusions are short
/// enough to stay, or else its end.
std::string shortened(const std::string& part, std::size_t longest) {
    const std::string
        no_rows = "*Its rows are left out, because this file would be too large to be shown; see the CSV file or* `index.html`.\n\n",
        no_rest = "*What stood here is left out, because this file would be too large to be shown; see* `index.html`.\n\n";
    Paragraphs head = paragraphs_of(part);
    for (std::size_t size = size_of(head); size > longest; size = size_of(head)) {
        const auto rows = dispensable_rows(head, size - longest + no_rows.size());
        if (rows == head.end()) break;
        *rows = no_rows;
    }
    if (size_of(head) <= longest) return join(head);
    Paragraphs tail = last_words(head);
    if (2 * size_of(tail) > longest) tail.clear();
    head.resize(head.size() - tail.size());
    const std::size_t kept = longest - std::min(longest, size_of(tail) + no_rest.size());
    while (!head.empty() && (size_of(head) > kept || head.back().starts_with("<a id=\"") || head.back().starts_with("### ")))
        head.pop_back();
    return join(head) + no_rest + join(tail);
}

/// Links to what this file does not hold lead to the page, which holds everything.
std::string with_links_to_page(const std::string& text) {
    const std::string opening = "](#", anchor = "<a id=\"";
    std::set<std::string> held;
    for (std::size_t at = text.find(anchor); at != std::string::npos; at = text.find(anchor, at + 1))
        held.insert(text.substr(at + anchor.size(), text.find('"', at + anchor.size()) - at - anchor.size()));
    std::string linked;
    std::size_t begin = 0;
    for (std::size_t at = text.find(opening); at != std::string::npos; at = text.find(opening, at + 1)) {
        const std::size_t id = at + opening.size();
        if (held.contains(text.substr(id, text.find(')', id) - id))) continue;
        linked += text.substr(begin, at + 2 - begin) + "index.html";
        begin = at + 2;
    }
    return linked + text.substr(begin);
}

/// All parts, the longest of them shortened so that about `size` bytes are left.
std::string cut(const std::string& text, std::size_t size) {
    constexpr std::size_t worth_reading = 3000;
    const Paragraphs parts = parts_of(text);
    std::size_t longest = length_for(parts, size, is_answer);
    const bool answers_whole = longest >= worth_reading;
    if (!answers_whole) longest = length_for(parts, size, [](const std::string&) { return false; });
    std::string all;
    for (const std::string& part : parts) {
        const bool whole = part.size() <= longest || (answers_whole && is_answer(part));
        all += whole ? part : shortened(part, longest);
    }
    return with_links_to_page(all);
}

}   // namespace

std::string shortened_markdown(const std::string& text, std::size_t limit) {
    // Links to the page are longer than those within: what they take is taken off the size asked for.
    std::size_t size = limit;
    std::string shorter = cut(text, size);
    while (shorter.size() > limit && size > 0) {
        size -= std::min(size, shorter.size() - limit);
        shorter = cut(text, size);
    }
    return shorter;
}

}   // namespace meshfolio::report
