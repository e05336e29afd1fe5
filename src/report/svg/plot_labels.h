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
    /// Places labels inside `frame` and, where they can, away from `data`, points of the curves.
    LabelPlacer(const Box& frame, std::vector<Point> data) : frame_(frame), data_(std::move(data)) {}

    /// Makes covering this box costly; labels avoid it where they can.
    void block(const Box& box) { taken_.push_back(box); }
    /// Returns the candidate, moved into the frame if it sticks out, that costs least by area outside the frame, covered boxes, covered
    /// data and place in the list; and blocks it.
    Box place(const std::vector<Box>& candidates);

private:
    double cost(const Box& box) const;   // of overlaps and covered data
    Box frame_;
    std::vector<Point> data_;
    std::vector<Box> taken_;
};

/// Returns 32 boxes of a label's size around a point: 8 at each of 4 distances, nearest first.
std::vector<Box> around(Point point, double width, double height);

/// Places boxes of these heights without overlap between `low` and `high`, their middles as near to `wanted` as possible (least squares).
/// If they do not fit, they are stacked from `low` beyond `high`.
/// @return the middles, in the order of `wanted`
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

/// Returns the names as SVG, below each other at x between `low` and `high`; a thin line joins a name to the end of its curve if it was
/// moved.
std::string drawn_names(const std::vector<EndName>& names, double x, double low, double high);

}   // namespace meshfolio::report
