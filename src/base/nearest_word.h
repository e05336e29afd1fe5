#pragma once

#include <string>
#include <vector>

namespace meshfolio {

/// Returns the known word with the smallest edit distance (an exchange of neighbours is one edit): the first on a tie, "" if none is known.
std::string nearest_word(const std::string& word, const std::vector<std::string>& known);

/// Returns "did you mean 'render' or 'rename'? ", with a final space, for up to three known words at an edit distance of at most a third of
/// their letters, nearest first; "" if there is none.
std::string suggestion(const std::string& word, const std::vector<std::string>& known);

}   // namespace meshfolio
