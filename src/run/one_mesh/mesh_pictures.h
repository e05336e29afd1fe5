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
    render::DrawOptions draw = {};   // its range is that of the field
    std::vector<render::View> views;
    std::string colormap = {};                             // empty: diverging for signed values, viridis for others
    std::optional<std::pair<double, double>> range = {};   // of the colours; nothing: robust
    std::string title = {};                                // of the sheet
    double em = 0;                                         // its text size [pixels]; 0: by its width
};

struct MeshPictures {
    std::optional<output::ColorRange> range;   // nothing where there are no values
    render::ContactSheet sheet;                // with the pictures, one a view
};

/// Some of +x, -x, +y, -y, +z, -z and hero, by commas; empty: the six. @throws UsageError
std::vector<render::View> views_named(const std::string& names);

/// Checks the range of the colours: a colour bar must be able to print it. @param told  its name in messages @throws UsageError
std::pair<double, double> value_limits(double low, double high, const std::string& told);

/// @throws UsageError for an unknown colour map
MeshPictures draw_pictures(const PreparedMesh& prepared, const Field& field, const PictureRequest& request);

/// One mesh of a pair, and what is drawn on it: values of both or of none.
struct PairedMesh {
    const PreparedMesh& prepared;
    const Field& field;
};
/// Both from one camera, at one scale, in one range of colours: each view of the first beside that of the second.
/// @throws UsageError for an unknown colour map
MeshPictures draw_pair(const PairedMesh& left, const PairedMesh& right, const PictureRequest& request);

/// @param bare  the pictures alone, three in a row, without words and colour bar
render::Image composed(const render::ContactSheet& sheet, bool bare);
std::int64_t bare_sheet_pixels(std::size_t views, const render::DrawOptions& draw);

}   // namespace meshfolio::run
