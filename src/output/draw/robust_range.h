/// @file
/// How the values of a figure are spread.
#pragma once

#include <span>
#include <vector>

#include "output/draw/figure_request.h"

namespace meshfolio::output {

/// Panel after panel.
std::vector<double> finite_values(const std::vector<Panel>& panels);

/// Enters the shares of `values` that lie below and above the range; 0 without values.
void enter_clipped(ColorRange& range, const std::vector<double>& values);

/// The share of `values` in each of 96 equal bins over [low, high] (48 or 24 where there are fewer than 32 values a bin, where noise
/// would be all one saw); what lies outside counts to the whole but to no bin. Empty when there are no values or
/// low < high does not hold.
std::vector<double> histogram(std::span<const double> values, double low, double high);

}   // namespace meshfolio::output
