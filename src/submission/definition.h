/// @file
/// Where in C++ text a function or a class is defined, as a reader would find it: not a call, not a declaration, not a comment.
#pragma once

#include <string_view>

namespace meshfolio::submission {

/// The line, counted from 1, that holds the name in the definition of a function or a class at namespace scope; 0 if there is none. The
/// text is formatted: such a definition begins in the first column, and nothing else that looks like one does.
/// Of overloads the first counts. "Type::member" asks for a member defined outside its class; a bare name finds one too, when no
/// function or class of that name alone is defined: "SparseFactor" may be the constructor SparseFactor::SparseFactor.
long definition_line(std::string_view cpp, std::string_view name);

}   // namespace meshfolio::submission
