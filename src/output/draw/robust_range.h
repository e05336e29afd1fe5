/// @file
/// Statistics of the values of a figure.
#pragma once

#include <span>
#include <vector>

#include "output/draw/figure_request.h"

namespace meshfolio::output {

/// The finite values, panel after panel.
std::vector<double> finite_values(const std::vector<Panel>& panels);

/// Enters the shares of `values` that lie below and above the range; 0 without values.
void enter_clipped(ColorRange& range, const std::vector<double>& values);

/// The share of `values` in each of 96 equal bins over [low, high]; 48 or 24 bins for fewer than 32 values a bin, which would show noise.
/// Values outside count in the total but in no bin. Empty without values, or unless low < high.
std::vector<double> histogram(std::span<const double> values, double low, double high);

}   // namespace meshfolio::output
