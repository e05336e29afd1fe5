/// @file
/// The pictures that `render` draws: views of a mesh with values, and their sheet.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "draw_mesh.h"
#include "output/draw/figure_request.h"
#include "run/arguments.h"
#include "run/one_mesh/colormap_choice.h"
#include "run/one_mesh/fields.h"
#include "sheet/figure_sheet.h"

namespace meshfolio::run {

inline constexpr int largest_side = 8192;   // of a picture [pixels]

/// The options of `render` about pictures as they are given; empty: not given.
struct PictureWords {
    std::string views = {}, size = {}, field = {}, colormap = {}, range = {}, isolines = {}, title = {}, background = {}, width = {},
                dpi = {}, columns = {}, fit = {}, bar = {};
    SightFlags sight = {};
    bool edges = false;
};

struct PictureRequest {
    render::DrawOptions draw = {};   // without a range, which comes from the field
    std::vector<render::View> views;
    ColorChoice colors = {};
    render::Sight sight = {};   // of the view "hero", and the zoom of all
    std::string title = {};     // of the sheet
};

struct MeshPictures {
    std::optional<output::ColorRange> range;   // nothing if there are no values
    render::ContactSheet sheet;                // with a picture for each view
};

/// Parses a list with commas of +x, -x, +y, -y, +z, -z, hero and, if `sight` has one, camera; empty: the camera, else the first six.
/// @throws UsageError for another name
std::vector<render::View> views_named(const std::string& names, const render::Sight& sight = {});

/// Returns {low, high} for the text "low,high", a range of colours that a colour bar can print: low < high, within ±1e100, at least 1e-100
/// wide. @throws UsageError for another text
std::pair<double, double> value_limits(const std::string& text);

/// Returns the choices of the options colormap and range. @throws UsageError, InputError
ColorChoice color_choice(const PictureWords& words);

/// Returns the colour of the option background, white by default. @throws UsageError
render::Rgba background_of(const PictureWords& words);

/// Returns the request for views of a mesh. @throws UsageError, InputError
PictureRequest picture_request(const PictureWords& words);

/// Draws the views of a mesh in the colours of a field, and makes their sheet with title, counts and colour bar.
/// @throws UsageError for an unknown colour map, or isolines that are too dense
MeshPictures draw_pictures(const PreparedMesh& prepared, const Field& field, const PictureRequest& request);

/// Returns the range of the colours of a field, over all meshes of the panels; nothing if it has no values.
std::optional<output::ColorRange> color_range(const std::vector<output::Panel>& panels, const Field& field, const ColorChoice& colors);

/// @throws UsageError if isolines would hide the colours between them in pictures of this size
void refuse_dense_isolines(const PreparedMesh& prepared, const Field& field, const render::DrawOptions& draw);

/// Returns a sheet as one picture. @param bare  the pictures alone, three in a row, without words and colour bar
render::Image composed(const render::ContactSheet& sheet, bool bare);
/// Returns the number of pixels of a bare sheet with this number of views, three in a row.
std::int64_t bare_sheet_pixels(std::size_t views, const render::DrawOptions& draw);

}   // namespace meshfolio::run
