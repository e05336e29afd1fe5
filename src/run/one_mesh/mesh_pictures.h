/// @file
/// The pictures that `render` draws: views of a mesh with values, and their sheet.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "draw_mesh.h"
#include "output/draw/figure_request.h"
#include "run/one_mesh/fields.h"
#include "sheet/figure_sheet.h"

namespace meshfolio::run {

inline constexpr int largest_side = 8192;   // of a picture [pixels]

struct PictureRequest {
    render::DrawOptions draw = {};   // without a range, which comes from the field
    std::vector<render::View> views;
    std::string colormap = {};                             // empty: diverging for signed values, viridis for others
    std::optional<std::pair<double, double>> range = {};   // of the colours; nothing: without outliers
    std::string title = {};                                // of the sheet
    double em = 0;                                         // text size of the sheet [pixels]; 0: by its width
};

struct MeshPictures {
    std::optional<output::ColorRange> range;   // nothing if there are no values
    render::ContactSheet sheet;                // with a picture for each view
};

/// Parses a list with commas of +x, -x, +y, -y, +z, -z and hero; empty: the first six. @throws UsageError for another name
std::vector<render::View> views_named(const std::string& names);

/// Returns {low, high} for a range of colours that a colour bar can print: low < high, within ±1e100, at least 1e-100 wide.
/// @param name  of the range in messages @throws UsageError
std::pair<double, double> value_limits(double low, double high, const std::string& name);

/// Draws the views of a mesh in the colours of a field, and makes their sheet with title, counts and colour bar.
/// @throws UsageError for an unknown colour map, or isolines that are too dense
MeshPictures draw_pictures(const PreparedMesh& prepared, const Field& field, const PictureRequest& request);

/// A mesh of a pair with its field; either both fields have values or none.
struct PairedMesh {
    const PreparedMesh& prepared;
    const Field& field;
};
/// Draws two meshes from one camera, at one scale, in one range of colours: each view of the first beside that of the second.
/// @throws UsageError like draw_pictures()
MeshPictures draw_pair(const PairedMesh& left, const PairedMesh& right, const PictureRequest& request);

/// Returns a sheet as one picture. @param bare  the pictures alone, three in a row, without words and colour bar
render::Image composed(const render::ContactSheet& sheet, bool bare);
/// Returns the number of pixels of a bare sheet with this number of views, three in a row.
std::int64_t bare_sheet_pixels(std::size_t views, const render::DrawOptions& draw);

}   // namespace meshfolio::run
