/// @file
/// Numbers that are not measured: counts, limits, tolerances. readable() would give them digits they do not have.
#pragma once

#include <string>

namespace meshfolio::report {

/// A whole number below 1e9 with all its digits, for people: 40 962.
std::string readable_integer(double x);

/// With as few digits as say the same as `most` digits: 2, 0.01, 1e-6 instead of 2.000, 0.01000, 1.000e-6.
std::string brief(double x, int most);

}   // namespace meshfolio::report
