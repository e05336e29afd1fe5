/// @file
/// Markdown that is too long to be shown. Private to the layer.
#pragma once

#include <string>

namespace meshfolio::report {

/// The same report with at most `limit` bytes, as far as there is anything to leave out: the longest parts are shortened, all to the same
/// length and with a word about it, rows of tables before sentences, conclusions last. Answers to questions stay whole as long as something
/// is left of the others. Links to what is left out lead to the page.
std::string shortened_markdown(const std::string& text, std::size_t limit);

}   // namespace meshfolio::report
