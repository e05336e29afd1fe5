/// @file
/// Diagrams of the geometry behind a formula: lines, areas and labels.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "report/text.h"

namespace meshfolio::report {

/// One or several panels beside each other, each with its own coordinates: y points upwards, and both axes have one scale.
struct Diagram {
    std::string id = {};   // images/<id>.svg
    std::string caption = {};
    std::string alt = {};   // the picture in words

    enum class Style { line, thin, dashed, area, accent, accent_area };   // accents: the subject of the formula
    /// A line or an area through points.
    struct Path {
        std::vector<double> x = {}, y = {};   // equally long; NaN leaves a gap
        Style style = Style::line;
        bool closed = false;
        bool arrow = false;   // a head at its last point
        bool operator==(const Path&) const = default;
    };

    enum class Side { centre, above, below, left, right, above_left, above_right, below_left, below_right };
    /// Words or mathematics beside a point.
    struct Label {
        double x = 0, y = 0;
        Text words = {};   // empty: the point alone
        Side side = Side::above;
        bool dot = false;      // the point itself is marked
        bool accent = false;   // in the colour of the accents
        bool operator==(const Label&) const = default;
    };

    struct Panel {
        std::string title = {};
        std::vector<Path> paths = {};   // drawn in order
        std::vector<Label> labels = {};
        bool operator==(const Panel&) const = default;
    };
    std::vector<Panel> panels = {};
    bool operator==(const Diagram&) const = default;
};

using DiagramPoint = std::array<double, 2>;

/// Returns the line through the points in their order; with `closed`, the polygon with these corners.
Diagram::Path path_through(const std::vector<DiagramPoint>& points, Diagram::Style style, bool closed = false);
/// Returns the arc around `vertex` from the direction of `a` to the direction of `b`, the short way round.
Diagram::Path angle_arc(DiagramPoint vertex, DiagramPoint a, DiagramPoint b, double radius, Diagram::Style style);
/// Returns the arc from angle `from` to angle `to` [radians], counter-clockwise if `to` is larger, as chords of at most 5°.
Diagram::Path arc(DiagramPoint centre, double radius, double from, double to, Diagram::Style style);
/// Returns the place of a label for the angle at `vertex` between `a` and `b`, below 180°: on its bisector, `radius` from the vertex.
DiagramPoint inside_angle(DiagramPoint vertex, DiagramPoint a, DiagramPoint b, double radius);

}   // namespace meshfolio::report
