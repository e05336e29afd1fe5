/// @file
/// What a question asks to be drawn. All panels of a figure share camera, scale and, unless they have their own, colour range.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace meshfolio::output {

struct ColorRange {
    std::string colormap;   // "pale"
    double low = 0, high = 1;
    std::string quantity, unit;                    // for the colour bar
    bool logarithmic = false;                      // equal ratios are equally far apart; low > 0
    double clipped_below = 0, clipped_above = 0;   // share of the finite values outside
    std::vector<double> sample = {};               // of the finite values, evenly through their order, for the histogram
};

/// One mesh with values, drawn from all six views: images/<name>_<view>.png.
struct Panel {
    std::string name;                           // "q5_cube_lambda0.1", unique; [a-zA-Z0-9_.-]
    std::string label;                          // "λ = 0.1, 20 iterations"
    std::shared_ptr<const TriangleMesh> mesh;   // null in a matrix: an empty cell, and the label says why
    Vector values = {};                         // one a vertex, NaN where undefined; empty: plain surface
    std::vector<int> marked_vertices = {};      // ringed where they are seen
    std::optional<ColorRange> range = {};       // its own instead of the figure's: its label has a small bar
};

enum class Layout {
    six_views,   // each panel from three quarters and from the six directions, but a flat one from its front alone
    multiples,   // one picture a panel, from three quarters, each in its own frame; beyond twelve at half the size, six in a line
    one_frame    // the same in one frame, that of `frame_panel`, for one mesh in several states: sizes can be compared
};

struct FigureRequest {
    std::string id = {};   // of the report::Figure: images/<id>_sheet.png
    std::string title = {}, subtitle = {};
    std::vector<Panel> panels = {};
    std::optional<ColorRange> range = {};
    bool edges = false;
    /// Frame all panels on this panel's box (a blown-up mesh must not shrink the others); −1: on the union of all boxes.
    int frame_panel = 0;
    Layout layout = Layout::six_views;
    bool turnable = false;        // readers of the page can turn the first panel, and with it the second if it has the same triangles
    double isoline_spacing = 0;   // lines where a value is a multiple of this; 0: none
    int in_a_line = 0;            // panels, where there are no heads and no six views; 0: as many as fit
    std::vector<std::string> columns = {}, rows = {};   // heads of a matrix of panels, which are given row by row (one_frame, multiples)
    bool view_files = false;     // each view is a file of full size as well, for what the assignment asks to be handed in
    bool coarse_edges = false;   // edges of the meshes so coarse that their shape is not seen without
    /// Panels in groups of so many, each one mesh in several states: from three quarters it fills the frame as the first does.
    int states = 1;

    const ColorRange* range_of(const Panel& panel) const { return panel.range ? &*panel.range : range ? &*range : nullptr; }
};

/// Robust range of the finite values of all panels: percentiles [clip, 1 − clip]; for a diverging map symmetric about 0 and at least 1.25
/// times the median, so that nearly equal values are not all in the end's colour; from 0 on for the pale one where nothing is below; never
/// narrower than `floor` (so that rounding noise is not stretched into colours); with the clipped shares and the sample filled in.
ColorRange robust_range(const std::vector<Panel>& panels, std::string colormap, std::string quantity, std::string unit, double floor,
                        double clip = 0.02);

/// The finite values, panel after panel.
std::vector<double> finite_values(const std::vector<Panel>& panels);

/// Enters the shares of `values` that lie below and above the range; 0 without values.
void enter_clipped(ColorRange& range, const std::vector<double>& values);

/// The share of `values` in each of 96 equal bins over [low, high]; 48 or 24 bins for fewer than 32 values a bin, which would show noise.
/// Values outside count in the total but in no bin. Empty without values, or unless low < high.
std::vector<double> histogram(std::span<const double> values, double low, double high);

/// A mesh to be written into meshes/.
struct MeshOutput {
    std::string name;   // "q4_armadillo_k5.ply"
    std::shared_ptr<const TriangleMesh> mesh;
};

}   // namespace meshfolio::output
