#include "base/nearest_word.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/joined.h"

namespace meshfolio {

namespace {

std::size_t edit_distance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
        }
    }
    return row.back();
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
