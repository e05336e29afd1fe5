/// @file
/// Names that stand at the ends of curves, beside the frame of a plot.
#pragma once

#include <string>
#include <vector>

#include "report/svg/plot_labels.h"

namespace meshfolio::report {

/// Places boxes of these heights without overlap, their middles as near to `wanted` as possible, between `low` and `high`. Boxes that do
/// not fit are stacked from `low`.
std::vector<double> spread_apart(const std::vector<double>& wanted, const std::vector<double>& heights, double low, double high);

/// The name at the end of one curve.
struct EndName {
    Point end;   // of the curve
    std::vector<std::string> lines;
    std::string sample;   // of the curve, drawn around (0, 0)
    std::string color;
    double height() const;
};
constexpr double end_sample_width = 20, end_gap = 7;   // of the sample, and before and behind it
/// Draws the names below each other at x, with thin lines to those that were moved.
std::string drawn_names(const std::vector<EndName>& names, double x, double low, double high);

}   // namespace meshfolio::report
