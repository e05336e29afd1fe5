#include "run/one_mesh/figure.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <utility>

#include "base/errors.h"
#include "base/number_text.h"
#include "geometry/measures/surface_distance.h"
#include "mesh/triangle_measures.h"
#include "output/draw/draw_panel.h"
#include "output/draw/write_drawing.h"
#include "png/png.h"
#include "run/one_mesh/difference_lines.h"
#include "sheet/figure_sheet.h"

namespace meshfolio::run {

namespace {

constexpr double mm_per_inch = 25.4, points_per_inch = 72;
constexpr double line_points = 0.5;                    // width of an isoline
constexpr double em_of_font = 1.164;                   // from ascender to descender, over the size of the font
constexpr double one_column = 85, two_columns = 170;   // of a journal [mm]
constexpr int most_in_a_line = 4, views_in_a_line = 3;
constexpr int most_parts = 20;                          // of a path in a label
constexpr double narrowest_block = 40;                  // that bars are readable in [mm]
constexpr std::int64_t largest_drawing = 200'000'000;   // pixels

/// The arrangement of a figure: a block for each field, with the pictures of all meshes and views.
struct Blocks {
    int columns = 1;          // pictures in a line of a block
    int in_a_line = 1;        // blocks
    int gap = 0, width = 0;   // between blocks, of a block [pixels]

    /// @param room  blocks that fit beside each other
    Blocks(int meshes, int views, int fields, int wanted, int room) {
        const int pictures = meshes * views;
        const int most = wanted > 0 ? wanted : meshes > 1 ? most_in_a_line : views > 1 ? views_in_a_line : most_in_a_line;
        const int lines = (pictures + most - 1) / most;
        columns = wanted > 0 ? std::min(wanted, pictures) : (pictures + lines - 1) / lines;   // fills the lines about equally
        if (meshes > 1 && views > 1 && (wanted == 0 || columns > meshes)) columns = std::max(meshes, columns / meshes * meshes);
        in_a_line = std::clamp(wanted > 0 ? wanted / columns : pictures == 1 ? room : 1, 1, fields);
    }
};

/// Returns the name of a view for people.
std::string label_of(const std::string& view) {
    return view.starts_with('-') ? "\u2212" + view.substr(1) : view == "hero" ? "three-quarter view" : view;
}

/// Returns the request for one field of all meshes.
output::FigureRequest request_of(std::span<const FigureMesh> meshes, std::size_t field, const FigureStyle& style, int columns) {
    output::FigureRequest request{.frame_panel = -1,
                                  .layout = style.common_fit ? output::Layout::one_frame : output::Layout::multiples,
                                  .isoline_spacing = style.isoline_spacing,
                                  .in_a_line = columns,
                                  .new_line_after = std::max(columns, static_cast<int>(meshes.size())),
                                  .sight = style.sight};
    Field whole;   // of all meshes
    for (const FigureMesh& mesh : meshes) {
        const Field& one = mesh.fields[field];
        if (whole.values.size() == 0) whole = one;
        if (one.colormap == "diverging") whole.colormap = one.colormap;
        whole.floor = std::max(whole.floor, one.floor);
        request.panels.push_back(
            {"", mesh.label, std::shared_ptr<const TriangleMesh>(std::shared_ptr<void>(), &mesh.prepared.mesh), one.values});
    }
    request.range = color_range(request.panels, whole, style.colors);
    const std::vector<output::Panel> once = std::exchange(request.panels, {});
    const bool has_labels = once.size() > 1 || style.labels_single;
    const std::vector<std::string> views = style.views.empty() ? std::vector<std::string>{""} : style.views;
    for (const std::string& view : views) {
        for (output::Panel panel : once) {
            panel.view = view;
            if (!has_labels) panel.label = views.size() > 1 ? view : "";
            else if (views.size() > 1) panel.label += ", " + label_of(view);
            request.panels.push_back(std::move(panel));
        }
    }
    return request;
}

/// Places drawings in lines, each in its own column, below a title.
render::Drawing stacked(const FigureStyle& style, const std::vector<render::Drawing>& drawings, const Blocks& blocks, int width,
                        double em) {
    render::Drawing whole{.width = width, .background = style.background};
    if (!style.title.empty()) {
        render::FigureSheet sheet{.title = style.title, .em = em, .least_width = width, .margin = 0, .background = style.background};
        const render::Drawing title = render::drawing_of(sheet).drawing;
        whole.add(title, 0, 0);
        whole.height = title.height;
    }
    for (std::size_t first = 0; first < drawings.size(); first += static_cast<std::size_t>(blocks.in_a_line)) {
        const int top = whole.height + (first > 0 ? blocks.gap : 0);
        for (std::size_t i = first; i < std::min(drawings.size(), first + static_cast<std::size_t>(blocks.in_a_line)); ++i) {
            whole.add(drawings[i], static_cast<int>(i - first) * (blocks.width + blocks.gap), top);
            whole.height = std::max(whole.height, top + drawings[i].height);
        }
    }
    return whole;
}

}   // namespace

FigureStyle figure_style(const PictureWords& words) {
    FigureStyle style{.sight = sight_of(words.sight),
                      .common_fit = words.fit == "common",
                      .title = words.title,
                      .bars = words.bar != "off",
                      .background = background_of(words),
                      .colors = color_choice(words),
                      .edges = words.edges};
    if (!words.fit.empty()) require_choice("--fit", words.fit, {"each", "common"});
    if (!words.views.empty()) views_named(words.views, style.sight);   // throws
    style.views = split(words.views, ',');
    if (!words.columns.empty()) style.columns = static_cast<int>(integer_between("--columns", words.columns, 1, most_columns));
    if (!words.width.empty()) style.width = number_between("--width-mm", words.width, smallest_width, largest_width);
    if (!words.dpi.empty()) style.resolution = number_between("--dpi", words.dpi, least_resolution, largest_resolution);
    if (!words.isolines.empty()) style.isoline_spacing = number_above_zero("--isolines", words.isolines);
    return style;
}

void require_figure_fields(const std::vector<std::string>& names) {
    if (names.empty()) throw UsageError("--field names nothing", "write none for plain surfaces");
    if (contains(names, "id")) throw UsageError("--field id does not go with a figure", "it is for the views of one mesh");
    std::vector<std::string> known = field_names();
    std::erase(known, "id");
    known.emplace_back("distance");
    for (const std::string& name : names) require_choice("--field", name, known);
}

std::vector<FigureMesh> figure_meshes(std::span<const PreparedMesh> meshes, const std::vector<std::string>& labels,
                                      const std::vector<std::string>& fields) {
    if (contains(fields, "distance") && meshes.size() < 2)
        throw UsageError("the field distance needs another mesh", "name the mesh to which the distance is, and others");
    std::vector<FigureMesh> figure;
    for (const PreparedMesh& mesh : meshes) {
        std::vector<Field> drawn;
        for (const std::string& name : fields) {
            const PreparedMesh& other = meshes[&mesh == meshes.data() && meshes.size() > 1 ? 1 : 0];
            drawn.push_back(name != "distance"
                                ? field_of(mesh, name)
                                : distance_field(vertex_distances(mesh.mesh, other.mesh), bounding_box(meshes[0].mesh).diagonal()));
        }
        figure.push_back({labels[figure.size()], mesh, std::move(drawn)});
    }
    return figure;
}

std::vector<std::string> labels_of(std::span<const PreparedMesh> meshes) {
    // Returns the last `parts` parts of a path.
    const auto end_of = [](std::filesystem::path path, int parts) {
        std::filesystem::path end = path.filename();
        for (; parts > 1 && path.has_parent_path() && path.parent_path() != path; --parts)
            if (path = path.parent_path(); path.has_filename()) end = path.filename() / end;
        return end.string();
    };
    std::vector<std::string> labels;
    for (const PreparedMesh& mesh : meshes) {
        const auto is_like_another = [&](int parts) {
            return std::ranges::any_of(meshes, [&](const PreparedMesh& other) {
                return other.file != mesh.file && end_of(other.file, parts) == end_of(mesh.file, parts);
            });
        };
        int parts = 1;
        while (parts < most_parts && is_like_another(parts)) ++parts;
        labels.push_back(end_of(mesh.file, parts));
    }
    return labels;
}

render::Drawing figure_of(std::span<const FigureMesh> meshes, const FigureStyle& style) {
    const auto views = static_cast<int>(std::max<std::size_t>(1, style.views.size())), fields = static_cast<int>(meshes[0].fields.size());
    const double room = (style.width > 0 ? style.width : two_columns) / narrowest_block;
    Blocks blocks(static_cast<int>(meshes.size()), views, fields, style.columns, static_cast<int>(room));
    const double em = style.text_size * em_of_font * style.resolution / points_per_inch;
    const double mm = style.width > 0 ? style.width : blocks.columns * blocks.in_a_line == 1 ? one_column : two_columns;
    const int width = static_cast<int>(std::lround(mm / mm_per_inch * style.resolution));
    blocks.gap = static_cast<int>(std::lround(em));
    blocks.width = (width - (blocks.in_a_line - 1) * blocks.gap) / blocks.in_a_line;
    const std::int64_t cell = blocks.width / blocks.columns, pictures = std::int64_t{views} * fields * std::ssize(meshes);
    if (cell * cell * pictures > largest_drawing)
        throw UsageError("the figure would have " + readable_count(cell * cell * pictures) + " pixels",
                         "take a smaller --width-mm or --dpi");
    output::DrawingLook look{.width = blocks.width,
                             .em = em,
                             .line = std::max(1.0, line_points * style.resolution / points_per_inch),
                             .bar = style.bars,
                             .edges = style.edges,
                             .background = style.background};
    std::vector<render::Drawing> drawings;
    for (std::size_t field = 0; field < meshes[0].fields.size(); ++field) {
        for (const FigureMesh& mesh : meshes) {
            render::DrawOptions draw{.width = blocks.width / blocks.columns, .height = blocks.width / blocks.columns};
            draw.isoline_spacing = style.isoline_spacing;
            refuse_dense_isolines(mesh.prepared, mesh.fields[field], draw);
        }
        drawings.push_back(output::drawing_of(request_of(meshes, field, style, blocks.columns), look));
    }
    return stacked(style, drawings, blocks, width, em);
}

std::optional<output::ColorRange> range_of(std::span<const FigureMesh> meshes, std::size_t field, const FigureStyle& style) {
    return request_of(meshes, field, style, 1).range;
}

std::string encode_figure(std::span<const FigureMesh> meshes, const FigureStyle& style, std::string_view ending) {
    const render::Drawing drawing = figure_of(meshes, style);
    if (ending == ".png") return render::encode_png(render::painted(drawing), style.resolution);
    std::string title = style.title;
    if (title.empty())
        for (const FigureMesh& mesh : meshes) title += (title.empty() ? "" : ", ") + mesh.label;
    return (ending == ".pdf" ? output::write_pdf : output::write_svg)(drawing, style.resolution, title);
}

}   // namespace meshfolio::run
