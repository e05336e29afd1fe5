#pragma once

#include <string>
#include <vector>

namespace meshfolio {

/// The known word with the smallest edit distance, neighbours exchanged counting as one edit; the first of them on a tie.
std::string nearest_word(const std::string& word, const std::vector<std::string>& known);

/// The known words that may have been meant, nearest first: at most three, each with two thirds of its letters right.
std::vector<std::string> near_words(const std::string& word, std::vector<std::string> known);

/// "did you mean 'render'? ", of what is near enough; else empty.
std::string suggestion(const std::string& word, const std::vector<std::string>& known);

}   // namespace meshfolio
