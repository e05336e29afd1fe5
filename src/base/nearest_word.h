/// @file
/// Corrections of misspelt words.
#pragma once

#include <string>
#include <vector>

namespace meshfolio {

/// Returns the known word with the smallest edit distance, in which an exchange of neighbouring letters is one edit; the first on a tie, ""
/// if none is known.
std::string nearest_word(const std::string& word, const std::vector<std::string>& known);

/// Returns "did you mean 'render' or 'rename'? " with up to three known words, nearest first, of which two thirds of the letters are right;
/// "" if there is none. A space follows.
std::string suggestion(const std::string& word, const std::vector<std::string>& known);

}   // namespace meshfolio
