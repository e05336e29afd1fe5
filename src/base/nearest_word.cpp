#include "base/nearest_word.h"

#include <algorithm>
#include <utility>

namespace meshfolio {

namespace {

/// Returns the number of insertions, deletions, replacements and exchanges of neighbours that turn `a` into `b` (optimal string alignment).
std::size_t edit_distance(const std::string& a, const std::string& b) {
    std::vector<std::vector<std::size_t>> least(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i) {
        for (std::size_t j = 0; j <= b.size(); ++j) {
            least[i][j] = i + j;
            if (i == 0 || j == 0) continue;
            const std::size_t replaced = least[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            least[i][j] = std::min({replaced, least[i - 1][j] + 1, least[i][j - 1] + 1});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                least[i][j] = std::min(least[i][j], least[i - 2][j - 2] + 1);
        }
    }
    return least.back().back();
}

}   // namespace

std::string nearest_word(const std::string& word, const std::vector<std::string>& known) {
    const auto nearest = std::min_element(known.begin(), known.end(), [&](const std::string& a, const std::string& b) {
        return edit_distance(word, a) < edit_distance(word, b);
    });
    return nearest == known.end() ? "" : *nearest;
}

std::string suggestion(const std::string& word, const std::vector<std::string>& known) {
    constexpr std::size_t most = 3;
    std::vector<std::pair<std::size_t, std::string>> near;   // with their distances
    for (const std::string& other : known) {
        const std::size_t distance = edit_distance(word, other);
        if (3 * distance <= std::max(word.size(), other.size())) near.emplace_back(distance, other);
    }
    std::sort(near.begin(), near.end());
    std::string text;
    for (std::size_t i = 0; i < std::min(near.size(), most); ++i)
        text += (text.empty() ? "did you mean '" : " or '") + near[i].second + "'";
    return text.empty() ? text : text + "? ";
}

}   // namespace meshfolio
