/// @file
/// Names that stand at the ends of curves, beside the frame of a plot.
#pragma once

#include <string>
#include <vector>

#include "report/svg/plot_labels.h"

namespace meshfolio::report {

/// Where the middles of boxes of these heights come to lie, as near to `wanted` as they can without one covering another. From `low` to
/// `high`, downwards from `low` where they do not fit.
std::vector<double> spread_apart(const std::vector<double>& wanted, const std::vector<double>& heights, double low, double high);

/// What stands at the end of one curve.
struct EndName {
    Point end;   // of the curve
    std::vector<std::string> lines;
    std::string sample;   // of the curve, drawn around (0, 0)
    std::string color;
    double height() const;
};
constexpr double end_sample_width = 20, end_gap = 7;   // of the sample, and before and behind it
/// The names one below another from x on, with thin lines to those that had to move.
std::string drawn_names(const std::vector<EndName>& names, double x, double low, double high);

}   // namespace meshfolio::report
