/// @file
/// What the writers need of the pictures of a document: where they are, and what their colours mean.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace meshfolio::report {

/// A mesh seen from one side: where it is in the sheet of its figure, which holds every picture of the page and of the paper.
struct DrawnPicture {
    std::string view;                               // "+x"; empty: from three quarters
    int left = 0, top = 0, width = 0, height = 0;   // in the sheet [pixels]
    std::string file = {};                          // of its own in full size; empty: none
    std::string jpeg = {};                          // bytes, cut out of the sheet
    /// The direction as people read it: "−x".
    std::string direction() const { return view.starts_with('-') ? "\u2212" + view.substr(1) : view; }
    bool operator==(const DrawnPicture&) const = default;
};

/// What the colours of a figure mean.
struct Legend {
    std::string quantity = {}, unit = {};
    double low = 0, high = 1;
    std::vector<std::string> colours = {};         // "#rrggbb", evenly from low to high
    double clipped_below = 0, clipped_above = 0;   // share of the values beyond
    std::string undefined = {};                    // colour of what has no value; empty: everything has one
    std::vector<double> histogram = {};            // share of the values in equal bins
    bool log = false;                              // equal ratios are equally far apart
    bool operator==(const Legend&) const = default;
};

/// One mesh, from three quarters or from six directions or both.
struct DrawnPanel {
    std::string label = {};
    std::vector<DrawnPicture> pictures = {};   // the one from three quarters first; none: an empty cell, the label says why
    std::optional<Legend> legend = {};         // of its own instead of the figure's
    /// Flat among meshes seen from six directions: only its front is shown.
    bool is_flat() const { return pictures.size() == 1 && !pictures[0].view.empty(); }
    bool operator==(const DrawnPanel&) const = default;
};

/// A mesh that readers of the page can turn.
struct DrawnModel {
    std::string label;      // of the panel; empty where a figure has one
    std::string file;       // "models/q3_creature.glb"
    std::string glb;        // its bytes, binary glTF 2.0
    std::string quantity;   // of the values at the vertices, with the unit: "H [1/length]"; empty: none
    bool operator==(const DrawnModel&) const = default;
};

/// A figure once drawn. Paths are relative to the report's folder.
struct DrawnFigure {
    std::string sheet = {};                             // "images/q1_plane_h_sheet.png"
    std::vector<std::string> columns = {}, rows = {};   // heads of a matrix; both empty: it is none
    std::vector<DrawnPanel> panels = {};                // line by line
    int in_a_line = 1, states = 1;                      // panels; those that show one mesh, one after another
    std::optional<Legend> legend = {};
    std::vector<DrawnModel> models = {};   // one, or before and after with linked cameras; empty: cannot be turned
    bool is_matrix() const { return !columns.empty() || !rows.empty(); }
    bool operator==(const DrawnFigure&) const = default;
};
using DrawnFigures = std::map<std::string, DrawnFigure>;   // by figure id

}   // namespace meshfolio::report
