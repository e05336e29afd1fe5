#include "run/one_mesh/terminal_figure.h"

#include <algorithm>

#include "base/in_quotes.h"
#include "base/number_text.h"

namespace meshfolio::run {

namespace {

constexpr double resolution = 96;   // [dpi]
constexpr int oversampling = 6;     // pixels of the figure for one of a coarse picture
constexpr double text_points = 10;

/// Returns the words of a figure as lines: title, names of the meshes, ranges of the colours.
std::string words_of(const std::vector<FigureMesh>& meshes, const FigureStyle& style) {
    std::string names, lines = style.title.empty() ? "" : printable(style.title) + "\n";
    for (const FigureMesh& mesh : meshes) names += (names.empty() ? "" : ", ") + printable(mesh.label);
    lines += names + "\n";
    for (std::size_t field = 0; field < meshes[0].fields.size(); ++field) {
        const auto range = range_of(meshes, field, style);
        if (!range) continue;
        const std::string unit = range->unit.empty() ? "" : " " + range->unit;
        lines += printable(range->quantity) + " from " + plain_text(range->low, 3) + " to " + plain_text(range->high, 3) + unit + " (" +
                 range->colormap + ")\n";
    }
    return lines;
}

}   // namespace

std::string terminal_figure(std::vector<FigureMesh> meshes, FigureStyle style, const TerminalRoom& room) {
    const int pixels = picture_pixels(room).first * (room.is_coarse() ? oversampling : 1);
    style.resolution = resolution;
    style.width = std::clamp(pixels / resolution * 25.4, smallest_width, largest_width);
    style.text_size = text_points;
    if (!room.is_coarse()) return terminal_picture(render::painted(figure_of(meshes, style)), room);
    const std::string words = words_of(meshes, style);
    style.background.a = 0;
    style.bars = false;
    style.title.clear();
    for (FigureMesh& mesh : meshes) mesh.label.clear();
    return terminal_picture(render::painted(figure_of(meshes, style)), room) + words;
}

}   // namespace meshfolio::run
