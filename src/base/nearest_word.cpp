#include "base/nearest_word.h"

#include <algorithm>
#include <utility>

#include "base/joined.h"

namespace meshfolio {

namespace {

/// Letters put in, left out or replaced, and neighbours exchanged, each pair once (optimal string alignment).
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

std::vector<std::string> near_words(const std::string& word, std::vector<std::string> known) {
    constexpr std::size_t most = 3;
    std::vector<std::pair<std::size_t, std::string>> near;
    for (std::string& one : known) {
        const std::size_t distance = edit_distance(word, one);
        if (3 * distance <= std::max(word.size(), one.size())) near.emplace_back(distance, std::move(one));
    }
    std::sort(near.begin(), near.end());
    near.resize(std::min(near.size(), most));
    std::vector<std::string> words;
    for (auto& [distance, one] : near) words.push_back(std::move(one));
    return words;
}

std::string suggestion(const std::string& word, const std::vector<std::string>& known) {
    const std::vector<std::string> near = near_words(word, known);
    return near.empty() ? "" : "did you mean '" + joined(near, "' or '") + "'? ";
}

}   // namespace meshfolio
