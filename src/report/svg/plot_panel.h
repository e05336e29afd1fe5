/// @file
/// One frame of a plot: grid, bands, curves, marks, and the names at the ends of its curves.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/document.h"
#include "report/svg/plot_axis.h"
#include "report/svg/plot_ends.h"
#include "report/svg/plot_labels.h"
#include "report/svg/svg_elements.h"

namespace meshfolio::report {

/// A series and how it is drawn: alike wherever a plot has a series of that name.
struct PlotCurve {
    const Series* series;
    Look look;
    bool operator==(const std::string& name) const { return series->name == name; }
};

/// Points of a curve without a gap.
using Stretch = std::vector<Point>;

class PlotPanel {
public:
    PlotPanel(const Plot& plot, std::string name, const Axis& x, const Axis& y);

    const std::string& name() const { return name_; }
    const std::vector<PlotCurve>& curves() const { return curves_; }
    void set_frame(const Box& frame) { frame_ = frame; }

    /// With the numbers of the y axis at its left; with labels of the vertical lines.
    std::string svg(bool with_y_numbers, bool with_line_labels) const;
    /// At the right of the frame, and inside of it for curves that end early. @param width  of a line of a name
    std::string end_names(double width) const;
    /// Of the names one below another, at most that many pixels wide.
    double height_of_names(double width) const;

    /// Does the curve have one end, where its name can stand? Points scattered about have none.
    bool has_end(const PlotCurve& curve) const;

private:
    bool shows(double x, double y) const { return x_.shows(x) && y_.shows(y); }
    double at_x(double x) const { return frame_.left + x_.position(x) * (frame_.right - frame_.left); }
    double at_y(double y) const { return frame_.bottom - y_.position(y) * (frame_.bottom - frame_.top); }
    Point at(double x, double y) const { return {at_x(x), at_y(y)}; }

    /// The points of a series, broken where a value is undefined or the axis cannot show it.
    std::vector<Stretch> runs_of(const Series& series) const;
    std::vector<Marker> markers() const;   // of this panel, which the axes can show
    bool is_empty() const;
    bool ends_early(Point end) const { return end.x < frame_.right - 0.3 * (frame_.right - frame_.left); }
    std::optional<Point> end_of(const PlotCurve& curve) const;
    std::vector<Point> data_points() const;   // along all curves and lines, for the labels to keep clear of

    std::string grid(bool with_numbers) const;
    std::string axis_break() const;
    std::string band(const PlotCurve& curve) const;
    std::string drawn(const PlotCurve& curve) const;
    std::string vertical_lines() const;
    std::string labels(bool of_lines) const;

    const Plot& plot_;
    std::string name_;
    const Axis &x_, &y_;
    std::vector<PlotCurve> curves_;
    Box frame_;
};

/// The names of the panels of a plot, in the order of their series; one empty name where it has none.
std::vector<std::string> panel_names(const Plot& plot);
/// A piece of a curve with a point, from `left` on.
std::string curve_sample(const Look& look, Point left, double width);

}   // namespace meshfolio::report
