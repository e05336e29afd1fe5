#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "base/number_text.h"
#include "base/parallel_tasks.h"
#include "cli/commands.h"
#include "draw_mesh.h"
#include "mesh/io/mesh_files.h"
#include "mesh/triangle_measures.h"
#include "output/draw/finished_picture.h"
#include "output/draw/surface_of.h"
#include "output/draw/write_glb.h"
#include "output/publish/file_group.h"
#include "output/publish/folder_system.h"
#include "png/png.h"
#include "run/console.h"
#include "run/one_mesh/difference_lines.h"
#include "run/one_mesh/mesh_pictures.h"
#include "run/settings/setting_list.h"

namespace meshfolio::cli {

namespace {

struct RenderFlags {
    std::string mesh, out, names = "sign", size = "1024", views, field = "none", values, colormap, range;
    std::string isolines, glb, pair;
    bool edges = false, plain = false, transparent = false;
};

render::DrawOptions draw_options(const RenderFlags& options) {
    render::DrawOptions draw;
    const std::size_t x = options.size.find('x');   // "1024" or "800x600"
    const auto width = parse_integer(options.size.substr(0, x));
    const auto height = x == std::string::npos ? width : parse_integer(options.size.substr(x + 1));
    const auto fits = [](const std::optional<long long>& side) { return side && *side >= 1 && *side <= largest_side; };
    if (!fits(width) || !fits(height))
        throw UsageError("--size '" + options.size + "' is not N or WxH", "both between 1 and " + std::to_string(largest_side));
    draw.width = static_cast<int>(*width);
    draw.height = static_cast<int>(*height);
    draw.edges = options.edges;
    if (!options.isolines.empty()) draw.isoline_spacing = number_above_zero("--isolines", options.isolines);
    if (options.transparent) draw.background = {255, 255, 255, 0};
    draw.face_colors_from_id = options.field == "id";
    if (options.plain) {
        draw.fill = 0.95;
        draw.surface_color = {200, 200, 200, 255};
        draw.shading = draw.backface_tint = false;
        draw.samples = 1;
    }
    return draw;
}

/// Returns {low, high} for the text "low,high" of --range. @throws UsageError for another text
std::pair<double, double> value_limits_in(const std::string& text) {
    const std::size_t comma = text.find(',');
    const auto low = parse_number(std::string_view(text).substr(0, comma));
    const auto high = comma == std::string::npos ? std::nullopt : parse_number(std::string_view(text).substr(comma + 1));
    const double nothing = std::nan("");
    return value_limits(low.value_or(nothing), high.value_or(nothing), "--range '" + text + "'");
}

/// Returns "+x.png", or "x-pos.png" for programs that mistake a sign for an option.
std::string file_name(const std::string& view, bool in_words) {
    if (!in_words || (view[0] != '+' && view[0] != '-')) return view + ".png";
    return view.substr(1) + (view[0] == '+' ? "-pos.png" : "-neg.png");
}

/// The last bytes of the pictures that this program writes: an empty private chunk and IEND. Programs that change a picture drop the chunk,
/// because it is marked as unsafe to copy (PNG specification, 5.4). A picture with the chunk is therefore unchanged.
constexpr std::string_view end_of_ours("\0\0\0\0msFO\xfe\xff\x92\x49\0\0\0\0IEND\xae\x42\x60\x82", 24);
constexpr std::size_t end_of_any = 12;   // bytes: IEND alone

std::string marked(std::string png) { return png.erase(png.size() - end_of_any).append(end_of_ours); }

bool is_our_picture(const std::string& bytes) { return bytes.ends_with(end_of_ours); }

/// Encodes and adds the pictures and the sheet, the sheet first, because it takes longest. Labels the views once the sheet is composed.
void add_pictures(output::FileGroup& files, const std::vector<std::filesystem::path>& paths, render::ContactSheet& sheet, bool bare) {
    const render::Image whole = composed(sheet, bare);
    for_each_task(1 + sheet.pictures.size(), [&](std::size_t task) {
        const render::Image& picture = task == 0 ? whole : sheet.pictures[task - 1];
        if (task > 0 && !bare) output::label_view(sheet.pictures[task - 1], sheet.view_names[task - 1]);
        files.add(task == 0 ? paths.back() : paths[task - 1], marked(render::encode_png(picture)));
    });
}

/// Draws two meshes on one sheet: one field of both, or the distance of each to the other.
ExitCode run_pair(const RenderFlags& options, PictureRequest request) {
    if (options.plain || options.field == "id" || !options.values.empty() || !options.glb.empty())
        throw UsageError("--pair goes with none of --plain, --field id, --values and --glb", "render each mesh by itself");
    if (!options.isolines.empty() && options.field == "none") throw UsageError("--isolines needs values", "take --field with it");
    const bool distance = options.field == "distance";
    const Checks checks = distance ? Checks::for_pictures : checks_for(options.field);
    const PreparedMesh a = load_mesh(options.mesh, checks), b = load_mesh(options.pair, checks);
    Field of_a, of_b;
    if (distance) {
        if (request.colormap.empty()) request.colormap = "pale";   // from 0 on
        const double diagonal = bounding_box(a.mesh).diagonal();
        of_a = distance_field(vertex_distances(a.mesh, b.mesh), diagonal);
        of_b = distance_field(vertex_distances(b.mesh, a.mesh), diagonal);
    } else {
        of_a = field_of(a, options.field);
        of_b = field_of(b, options.field);
    }
    const auto name_of = [](const std::string& file) { return std::filesystem::path(file).filename().string(); };
    request.title = name_of(options.mesh) + ", " + name_of(options.pair);
    const std::filesystem::path folder = options.out.empty() ? mesh_name(options.mesh) : options.out;
    output::FileGroup files;
    for (const std::string& file : {options.mesh, options.pair}) files.keep(file);
    output::make_folder(folder);
    keep_others(folder / "sheet.png", is_our_picture);
    files.add(folder / "sheet.png", marked(render::encode_png(render::compose(draw_pair({a, of_a}, {b, of_b}, request).sheet))));
    files.publish();
    print_path(folder / "sheet.png");
    return ExitCode::ok;
}

ExitCode run_render(const RenderFlags& options) {
    const render::DrawOptions given = draw_options(options);
    const std::vector<render::View> views = views_named(options.views);
    const bool bare = options.plain || given.face_colors_from_id;
    if (const std::int64_t pixels = bare_sheet_pixels(views.size(), given); bare && pixels > render::largest_png)
        throw UsageError("a plain sheet of " + std::to_string(views.size()) + " views has " + std::to_string(pixels) +
                             " pixels, more than " + std::to_string(render::largest_png),
                         "take a smaller --size or fewer --views");
    std::optional<std::pair<double, double>> range;
    if (!options.range.empty()) range = value_limits_in(options.range);
    if (!options.colormap.empty()) output::value_range({.colormap = options.colormap, .quantity = "", .unit = ""});
    check_output("--glb", options.glb, {".glb"}, options.out);
    check_read_once(options.mesh, options.pair);
    if (options.mesh == "-" && options.out.empty())
        throw UsageError("render - needs --out DIR, as standard input has no name for a folder", "give one");
    output::require_folder(options.out.empty() ? mesh_name(options.mesh) : options.out);
    if (!options.pair.empty()) return run_pair(options, {.draw = given, .views = views, .colormap = options.colormap, .range = range});
    if (options.field == "distance") throw UsageError("--field distance needs another mesh", "name it with --pair");
    const PreparedMesh prepared = load_mesh(options.mesh, options.values.empty() ? checks_for(options.field) : Checks::for_pictures);
    if (!options.isolines.empty() && options.values.empty() && (options.field == "none" || options.field == "id"))
        throw UsageError("--isolines needs values", "take --field or --values with it");
    const Field field = options.values.empty() ? field_of(prepared, options.field) : field_from_file(prepared, options.values);

    PictureRequest request{.draw = given, .views = views, .colormap = options.colormap, .range = range};
    request.title = std::filesystem::path(prepared.file).filename().string();
    MeshPictures drawn = draw_pictures(prepared, field, request);
    const auto is_empty = [&](const render::Image& picture) {
        return std::ranges::all_of(picture.pixels, [&](render::Rgba pixel) { return pixel == given.background; });
    };
    if (std::ranges::all_of(drawn.sheet.pictures, is_empty))
        warn("nothing of the mesh is seen: it is thinner than the samples of a picture lie apart");

    output::FileGroup files;
    files.keep(options.mesh);
    files.keep(options.values.substr(0, options.values.rfind(':')));
    const std::filesystem::path folder = options.out.empty() ? mesh_name(options.mesh) : options.out;
    std::vector<std::filesystem::path> paths;
    for (const render::View& view : views) paths.push_back(folder / file_name(std::string(view.name), options.names == "word"));
    paths.push_back(folder / "sheet.png");
    output::make_folder(folder);
    if (!options.glb.empty())
        files.add(options.glb, output::write_glb(prepared.mesh, field.values, drawn.range, output::ball_around(prepared.mesh)));
    for (const std::filesystem::path& path : paths) keep_others(path, is_our_picture);
    add_pictures(files, paths, drawn.sheet, bare);
    files.publish();
    for (const std::filesystem::path& path : paths) print_path(path);
    return ExitCode::ok;
}

}   // namespace

Command render_command(CLI::App& parent) {
    const auto options = std::make_shared<RenderFlags>();
    CommandOptions app(parent, "render", "Pictures of a mesh from six directions, and a contact sheet");
    app.required("MESH", options->mesh, formats_read);
    app.text("--out DIR", options->out,
             "folder for +x.png … -z.png and sheet.png, whose paths are printed; default: a folder called as the mesh");
    app.choice("--names", options->names, {"sign", "word"}, "of the pictures: +x.png, or x-pos.png");
    app.text("--views VIEWS", options->views, "some of +x,-x,+y,-y,+z,-z and hero (from above, where most is seen); default: the six");
    app.text("--size PIXELS", options->size, "pixels of one view: N or WxH");
    std::vector<std::string> fields = field_names();
    fields.emplace_back("distance");
    app.choice("--field", options->field, fields,
               "what is drawn in colours; h-… is the mean curvature by that operator, distance that to the surface of --pair");
    app.text("--pair FILE", options->pair, "another mesh beside it on one sheet.png, by one camera, at one scale, in one range of colours");
    app.text("--values FILE:COLUMN", options->values, "values from FILE.csv:COLUMN, one row a vertex, or of a mesh, FILE.ply:PROPERTY");
    app.choice("--colormap", options->colormap, colormap_names(),
               "see meshfolio list; default: diverging for signed values, pale for distances, viridis otherwise");
    app.text("--range LOW,HIGH", options->range, "lo,hi of the colours; default: robust");
    app.text("--isolines", options->isolines, "lines where the value is a multiple of this");
    app.text("--glb FILE", options->glb, "also the mesh with its values and colours as binary glTF, to be turned in other programs");
    app.flag("--edges", options->edges, "draw triangle edges");
    app.flag("--transparent", options->transparent, "no ground behind the surface");
    app.flag("--plain", options->plain, "no labels, colour bar, shading or antialiasing: flat colours, for checks");
    app.footer(
        "Example: meshfolio render bunny.off --field h-cotan --range -20,20 --views +z,-z --out views\n"
        "         meshfolio render before.ply --pair after.ply --field distance --out pair");
    return {app, [options] { return run_render(*options); }};
}

}   // namespace meshfolio::cli
