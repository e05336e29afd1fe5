/// @file
/// Lists of numbers: named in the settings, measured along a run.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace meshfolio {

/// Ascending, each value once: a step named twice in the settings is one run.
template <class Number>
std::vector<Number> each_once(std::vector<Number> values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    return values;
}

/// The last of the settings' values, or the question's own where they have none.
inline int last_or(const std::vector<int>& given, int own) { return given.empty() ? own : given.back(); }

/// Largest rise from one value to the next; 0 where none rises.
template <class Values>
double largest_rise(const Values& values) {
    double rise = 0;
    for (auto value = values.begin(), end = values.end(); value != end && value + 1 != end; ++value)
        rise = std::max(rise, value[1] - value[0]);
    return rise;
}

}   // namespace meshfolio
