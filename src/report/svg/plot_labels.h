/// @file
/// Places labels of a plot so that they cover neither each other nor the data. Units are pixels, y down.
#pragma once

#include <string>
#include <vector>

#include "report/text.h"

namespace meshfolio::report {

constexpr double font_size = 12.5, script_size = 11;   // 7.5 and 6.6 points where a drawing is 136 mm wide
inline constexpr const char* font_family = "'Report Sans', 'Report Math', system-ui, sans-serif";   // as in fonts.css; files stand alone

struct Point {
    double x = 0, y = 0;
};

struct Box {
    double left = 0, top = 0, right = 0, bottom = 0;
};

/// Width in pixels of a text in the regular sans of the pages.
double text_width(const std::string& text);
/// Of a text whose indices and exponents are smaller.
double text_width(const Text& text);
/// Broken at spaces so that no line is wider than `width`, a single word excepted.
std::vector<std::string> wrapped(const std::string& text, double width);

class LabelPlacer {
public:
    /// Labels stay inside `frame`; `data` are points of the curves, which labels avoid where they can.
    LabelPlacer(const Box& frame, std::vector<Point> data) : frame_(frame), data_(std::move(data)) {}

    /// Nothing will be placed over this box.
    void block(const Box& box) { taken_.push_back(box); }
    /// The best of the candidate boxes, moved into the frame where they stick out: earlier ones are preferred where the cost is equal. It
    /// is taken from then on.
    Box place(const std::vector<Box>& candidates);

private:
    double cost(const Box& box) const;
    Box frame_;
    std::vector<Point> data_;
    std::vector<Box> taken_;
};

/// Boxes of a label's size around a point, nearest first.
std::vector<Box> around(Point point, double width, double height);

}   // namespace meshfolio::report
