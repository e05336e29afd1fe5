/// @file
/// Figures of one's own: a grid of meshes and fields as one drawing, for a paper.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "run/one_mesh/mesh_pictures.h"
#include "sheet/drawing.h"

namespace meshfolio::run {

inline constexpr double smallest_width = 10, largest_width = 2000;          // of a figure [mm]
inline constexpr double least_resolution = 36, largest_resolution = 2400;   // [dpi]
inline constexpr int most_columns = 100;

struct FigureStyle {
    std::vector<std::string> views = {};   // "+x" …, "hero"; empty: the camera of `sight`, else from three quarters
    render::Sight sight = {};
    bool common_fit = false;   // all meshes in one frame, so that sizes and places can be compared; false: each fills its picture
    int columns = 0;           // pictures in a line; 0: chosen
    double width = 0;          // [mm]; 0: 85 for one picture in a line, else 170
    double resolution = 300;   // [dpi]
    double text_size = 8;      // [points]
    std::string title = {};
    bool labels_single = false;   // also below a mesh that is alone
    bool bars = true;             // a colour bar for each field
    render::Rgba background{255, 255, 255, 255};
    ColorChoice colors = {};
    double isoline_spacing = 0;   // 0: none
    bool edges = false;
};

/// A mesh of a figure with its values of each field, which all meshes have in the same order; a field without values is a plain surface.
struct FigureMesh {
    std::string label;   // below its pictures
    const PreparedMesh& prepared;
    std::vector<Field> fields;
};

/// Returns the style that the options ask for. @throws UsageError, InputError
FigureStyle figure_style(const PictureWords& words);

/// @throws UsageError unless the names are fields of figures: those of field_names() but id, and distance; and for no name
void require_figure_fields(const std::vector<std::string>& names);

/// Returns the meshes, which must outlive the result, with their fields. "distance" is that to the surface of the first mesh; that of the
/// first is to the second. @throws UsageError for an unknown name, or the distance of a single mesh
std::vector<FigureMesh> figure_meshes(std::span<const PreparedMesh> meshes, const std::vector<std::string>& labels,
                                      const std::vector<std::string>& fields);

/// Returns the names of the files, with their folders where two files have one name.
std::vector<std::string> labels_of(std::span<const PreparedMesh> meshes);

/// Draws a figure: for each field the pictures of all meshes in all views, with one range of colours and one bar.
/// @throws UsageError for an unknown colour map or view, isolines that are too dense, or pictures that are too small or too large
render::Drawing figure_of(std::span<const FigureMesh> meshes, const FigureStyle& style);

/// Returns the range of the colours of a field in all meshes of a figure; nothing if it has no values.
std::optional<output::ColorRange> range_of(std::span<const FigureMesh> meshes, std::size_t field, const FigureStyle& style);

/// Draws a figure as the bytes of a file with this ending: .pdf, .svg or .png. Equal figures give equal bytes. @throws as figure_of()
std::string encode_figure(std::span<const FigureMesh> meshes, const FigureStyle& style, std::string_view ending);

}   // namespace meshfolio::run
