#pragma once

#include <string>
#include <vector>

namespace meshfolio {

/// The known word with the smallest edit distance (Levenshtein); the first of them on a tie.
std::string nearest_word(const std::string& word, const std::vector<std::string>& known);

}   // namespace meshfolio
