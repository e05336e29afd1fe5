/// @file
/// Requests for figures. The panels of a figure share the camera, the scale and, unless they have their own, the colour range.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesh/triangle_mesh.h"
#include "scene/sight.h"

namespace render {
struct Colormap;
}

namespace meshfolio::output {

struct ColorRange {
    std::string colormap;   // "pale"
    double low = 0, high = 1;
    std::string quantity, unit;                             // for the colour bar
    bool logarithmic = false;                               // colours by the logarithm; low > 0
    double clipped_below = 0, clipped_above = 0;            // shares of the finite values outside
    std::vector<double> sample = {};                        // finite values, taken evenly from their order, for the histogram
    std::shared_ptr<const render::Colormap> own_map = {};   // instead of a bundled one: a map that was read from a file
};

/// One mesh with values. Its view files are images/<name>_<view>.png.
struct Panel {
    std::string name;                           // "q5_cube_lambda0.1", unique; [a-zA-Z0-9_.-]
    std::string label;                          // "λ = 0.1, 20 iterations"
    std::shared_ptr<const TriangleMesh> mesh;   // null in a matrix: an empty cell, and the label says why
    Vector values = {};                         // one a vertex, NaN if undefined; empty: plain surface
    std::vector<int> marked_vertices = {};      // get a ring if they are visible
    std::optional<ColorRange> range = {};       // instead of the figure's; the label then has a small colour bar
    std::string view = {};                      // "+x", "hero", "camera": that picture; empty: from the camera, else from three quarters
};

enum class Layout {
    six_views,   // each panel from three quarters and along the axes; a flat mesh from its front only
    multiples,   // each panel from three quarters in its own frame; more than twelve panels at half the size, six in a line
    one_frame    // each panel from three quarters in the frame of `frame_panel`, so that sizes can be compared
};

struct FigureRequest {
    std::string id = {};   // of the report::Figure: images/<id>_sheet.png
    std::string title = {}, subtitle = {};
    std::vector<Panel> panels = {};
    std::optional<ColorRange> range = {};
    bool edges = false;
    /// Index of the panel whose box frames all panels, so that a mesh that blew up does not make others small; −1: the union of all boxes.
    int frame_panel = 0;
    Layout layout = Layout::six_views;
    bool turnable = false;        // the page gets models of its meshes, which readers can turn
    double isoline_spacing = 0;   // lines at the multiples of this value; 0: none
    int in_a_line = 0;            // panels in a line, without heads and six views; 0: as many as fit
    int new_line_after = 0;       // of one's own figure: panels, which have their labels even if there is one; 0: none
    std::vector<std::string> columns = {}, rows = {};   // heads of a matrix of panels, given row by row (one_frame, multiples)
    bool view_files = false;                            // also write each view in full size, as the assignment requires of some figures
    bool coarse_edges = false;                          // draw the edges of meshes of fewer than 3000 triangles
    /// Panels per group, which shows one mesh in several states, all in the frame of the first. 1: no groups.
    int states = 1;
    render::Sight sight = {};   // of the pictures from three quarters

    /// Returns the colour range of a panel: its own or that of the figure; null if there is none.
    const ColorRange* range_of(const Panel& panel) const { return panel.range ? &*panel.range : range ? &*range : nullptr; }
};

inline constexpr double usual_clip = 0.02;

/// Returns the range between the percentiles clip and 1 − clip of the finite values of all panels, with clipped shares and a sample of at
/// most 8192 values. A diverging map makes it symmetric about 0, up to 1.25 times the median at least, so that nearly equal values do not
/// all get the colour of an end. "pale" makes it begin at 0 if its low end is not negative. It is at least `floor` wide, so that rounding
/// noise gets one colour.
ColorRange robust_range(const std::vector<Panel>& panels, std::string colormap, std::string quantity, std::string unit, double floor,
                        double clip = usual_clip, std::shared_ptr<const render::Colormap> own_map = {});

/// Returns the finite values of all panels, panel after panel.
std::vector<double> finite_values(const std::vector<Panel>& panels);

/// Sets range.clipped_below and clipped_above to the shares of `values` below and above the range; 0 without values.
void enter_clipped(ColorRange& range, const std::vector<double>& values);

/// Returns the share of `values` in each of 96 equal bins over [low, high]; 48 or 24 bins if there are fewer than 32 values a bin. Values
/// outside count in the total but in no bin. Empty without values, and unless low < high.
std::vector<double> histogram(std::span<const double> values, double low, double high);

/// A mesh to write into meshes/.
struct MeshOutput {
    std::string name;   // "q4_armadillo_k5.ply"
    std::shared_ptr<const TriangleMesh> mesh;
};

}   // namespace meshfolio::output
