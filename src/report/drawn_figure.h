/// @file
/// The data of drawn pictures that the writers need: their places, and the meaning of their colours.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace meshfolio::report {

/// The picture of a mesh seen from one side, as a part of the sheet of its figure.
struct DrawnPicture {
    std::string view;                               // "+x"; empty: three quarters
    int left = 0, top = 0, width = 0, height = 0;   // in the sheet [pixels]
    std::string file = {};                          // in full size; empty: none
    std::string jpeg = {};                          // bytes, cut out of the sheet
    /// Returns the view with a true minus sign: "−x" for "-x", others unchanged.
    std::string direction() const { return view.starts_with('-') ? "\u2212" + view.substr(1) : view; }
    bool operator==(const DrawnPicture&) const = default;
};

/// The meaning of the colours of a figure.
struct Legend {
    std::string quantity = {}, unit = {};
    double low = 0, high = 1;
    std::vector<std::string> colours = {};         // "#rrggbb", evenly from low to high
    double clipped_below = 0, clipped_above = 0;   // share of the values beyond
    std::string undefined = {};                    // colour of places without a value; empty: there are none
    std::vector<double> histogram = {};            // share of the values in equal bins
    bool log = false;                              // equal ratios are equally far apart
    bool operator==(const Legend&) const = default;
};

/// The pictures of one mesh: from three quarters, from six directions, or both.
struct DrawnPanel {
    std::string label = {};
    std::vector<DrawnPicture> pictures = {};   // three quarters first; none: an empty cell, with the reason as label
    std::optional<Legend> legend = {};         // of its own instead of the figure's
    /// True for a flat mesh among meshes seen from six directions: it has a front view alone.
    bool is_flat() const { return pictures.size() == 1 && !pictures[0].view.empty(); }
    bool operator==(const DrawnPanel&) const = default;
};

/// A mesh that readers of the page can turn.
struct DrawnModel {
    std::string label;      // of the panel; empty for the only one
    std::string file;       // "models/q3_creature.glb"
    std::string glb;        // its bytes, binary glTF 2.0
    std::string quantity;   // of the values at the vertices, with the unit: "H [1/length]"; empty: none
    bool operator==(const DrawnModel&) const = default;
};

/// A drawn figure. Paths are relative to the folder of the report.
struct DrawnFigure {
    std::string sheet = {};                             // "images/q1_plane_h_sheet.png"
    std::vector<std::string> columns = {}, rows = {};   // heads of a matrix; both empty: no matrix
    std::vector<DrawnPanel> panels = {};                // line by line
    int in_a_line = 1, states = 1;                      // numbers of panels: in a line, and consecutive ones of one mesh
    std::optional<Legend> legend = {};
    std::vector<DrawnModel> models = {};   // one, or two with linked cameras; empty: cannot be turned
    bool is_matrix() const { return !columns.empty() || !rows.empty(); }
    bool operator==(const DrawnFigure&) const = default;
};
using DrawnFigures = std::map<std::string, DrawnFigure>;   // by figure id

}   // namespace meshfolio::report
