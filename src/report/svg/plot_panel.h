/// @file
/// One frame of a plot: grid, bands, curves, markers, and the names at the ends of the curves.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/document.h"
#include "report/svg/plot_axis.h"
#include "report/svg/plot_labels.h"
#include "report/svg/svg_elements.h"

namespace meshfolio::report {

/// A series and its look, which series of one name in different panels share.
struct PlotCurve {
    const Series* series;
    Look look;
    bool operator==(const std::string& name) const { return series->name == name; }
};

class PlotPanel {
public:
    /// Takes the series of a plot that belong to the panel of this name.
    PlotPanel(const Plot& plot, std::string name, const Axis& x, const Axis& y);

    const std::string& name() const { return name_; }
    const std::vector<PlotCurve>& curves() const { return curves_; }
    void set_frame(const Box& frame) { frame_ = frame; }

    /// Returns the panel as SVG. @param with_y_numbers  at its left @param with_line_labels  of the vertical lines
    std::string svg(bool with_y_numbers, bool with_line_labels) const;
    /// Returns the names of the curves as SVG, at the right of the frame; inside it for curves that end in its left 70 %.
    /// @param width  of a line of a name
    std::string end_names(double width) const;
    /// Returns the height [pixels] of the names of curves with an end, below each other in lines no wider than `width`.
    double height_of_names(double width) const;

    /// True if the curve has an end for its name: a line or ascending x, and a point that the axes show. Scattered points have none.
    bool has_end(const PlotCurve& curve) const;

private:
    bool shows(double x, double y) const { return x_.shows(x) && y_.shows(y); }
    double at_x(double x) const { return frame_.left + x_.position(x) * (frame_.right - frame_.left); }
    double at_y(double y) const { return frame_.bottom - y_.position(y) * (frame_.bottom - frame_.top); }
    Point at(double x, double y) const { return {at_x(x), at_y(y)}; }

    /// Returns the points of a series, in pieces between values that the axes cannot show.
    std::vector<Stretch> runs_of(const Series& series) const;
    std::vector<Marker> markers() const;                         // of this panel, as far as the axes show them
    std::optional<Point> end_of(const PlotCurve& curve) const;   // empty for a curve without a name or an end
    std::vector<Point> data_points() const;                      // along all curves and lines, for labels to avoid

    std::string grid(bool with_numbers) const;         // axes, ticks and grid lines
    std::string band(const PlotCurve& curve) const;    // between y_low and y_high
    std::string drawn(const PlotCurve& curve) const;   // line and points
    std::string labels(bool of_lines) const;           // of markers, and of vertical lines

    const Plot& plot_;
    std::string name_;
    const Axis &x_, &y_;
    std::vector<PlotCurve> curves_;
    Box frame_;
};

/// Returns the names of the panels of a plot in the order of its series; one empty name for a plot without panels.
std::vector<std::string> panel_names(const Plot& plot);
/// Returns SVG of a horizontal piece of a curve, `width` long from `left`, with a point in its middle if the curve has points.
std::string curve_sample(const Look& look, Point left, double width);

}   // namespace meshfolio::report
