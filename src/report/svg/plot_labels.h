/// @file
/// Places labels of a plot so that they cover neither each other nor the data, and names at the ends of its curves.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "report/svg/svg_elements.h"

namespace meshfolio::report {

class LabelPlacer {
public:
    /// Labels stay inside `frame`; `data` are points of the curves, which labels avoid where they can.
    LabelPlacer(const Box& frame, std::vector<Point> data) : frame_(frame), data_(std::move(data)) {}

    /// Keeps labels away from this box.
    void block(const Box& box) { taken_.push_back(box); }
    /// Returns the best candidate, moved into the frame if it sticks out, and blocks it. Earlier candidates win at equal cost.
    Box place(const std::vector<Box>& candidates);

private:
    double cost(const Box& box) const;   // of overlaps and covered data
    Box frame_;
    std::vector<Point> data_;
    std::vector<Box> taken_;
};

/// Returns boxes of a label's size around a point, nearest first.
std::vector<Box> around(Point point, double width, double height);

/// Places boxes of these heights without overlap between `low` and `high`, their middles as near to `wanted` as possible. Boxes that do not
/// fit are stacked from `low`.
/// @return the middles
std::vector<double> spread_apart(const std::vector<double>& wanted, const std::vector<double>& heights, double low, double high);

/// The name at the end of a curve.
struct EndName {
    Point end;   // of the curve
    std::vector<std::string> lines;
    std::string sample;   // of the curve, drawn around (0, 0)
    std::string color;
    double height() const;   // of its lines [pixels]
};
constexpr double end_sample_width = 20, end_gap = 7;   // of the sample, and before and behind it

/// Returns the names as SVG, below each other at x, with thin lines to those that were moved.
std::string drawn_names(const std::vector<EndName>& names, double x, double low, double high);

}   // namespace meshfolio::report
