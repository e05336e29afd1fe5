#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "base/in_quotes.h"
#include "base/joined.h"
#include "base/lower_case.h"
#include "base/number_text.h"
#include "base/parallel_tasks.h"
#include "cli/commands.h"
#include "cli/render_flags.h"
#include "draw_mesh.h"
#include "mesh/io/mesh_files.h"
#include "output/draw/finished_picture.h"
#include "output/draw/write_glb.h"
#include "output/publish/file_group.h"
#include "output/publish/folder_system.h"
#include "png/png.h"
#include "run/console.h"
#include "run/one_mesh/mesh_pictures.h"

namespace meshfolio::cli {

namespace {

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
void add_pictures(output::FileGroup& files, const std::vector<std::filesystem::path>& paths, render::ContactSheet& sheet, bool bare,
                  const render::Sight& sight) {
    const render::Image whole = composed(sheet, bare);
    for_each_task(1 + sheet.pictures.size(), [&](std::size_t task) {
        const render::Image& picture = task == 0 ? whole : sheet.pictures[task - 1];
        if (task > 0 && !bare) output::label_view(sheet.pictures[task - 1], sheet.view_names[task - 1], sight);
        files.add(task == 0 ? paths.back() : paths[task - 1], marked(render::encode_png(picture)));
    });
}

/// Writes the views of one mesh and their sheet into a folder.
ExitCode run_views(const RenderFlags& options) {
    PictureRequest request = picture_request(options);
    if (!request.colors.warning.empty()) warn(request.colors.warning);
    render::DrawOptions& draw = request.draw;
    if (options.plain) {
        draw.fill = 0.95;
        draw.surface_color = {200, 200, 200, 255};
        draw.shading = draw.backface_tint = false;
        draw.samples = 1;
    }
    const std::vector<render::View>& views = request.views;
    const bool bare = options.plain || draw.face_colors_from_id;
    if (const std::int64_t pixels = bare_sheet_pixels(views.size(), draw); bare && pixels > render::largest_png)
        throw UsageError("a plain sheet of " + std::to_string(views.size()) + " views has " + std::to_string(pixels) +
                             " pixels, more than " + std::to_string(render::largest_png),
                         "take a smaller --size or fewer --views");
    const std::string& mesh = options.meshes.front();
    const std::filesystem::path folder = options.out.empty() ? mesh_name(mesh) : options.out;
    check_output("--glb", options.glb, {".glb"}, options.out);
    output::require_folder(folder);
    if (request.title.empty()) request.title = std::filesystem::path(mesh).filename().string();
    const PreparedMesh prepared = load_mesh(mesh, options.values.empty() ? checks_for(options.field) : Checks::for_pictures);
    const Field field = options.values.empty() ? field_of(prepared, options.field) : field_from_file(prepared, options.values);
    MeshPictures drawn = draw_pictures(prepared, field, request);
    const auto is_empty = [&](const render::Image& picture) {
        return std::ranges::all_of(picture.pixels, [&](render::Rgba pixel) { return pixel == draw.background; });
    };
    if (std::ranges::all_of(drawn.sheet.pictures, is_empty))
        warn("nothing of the mesh is seen: it is thinner than the samples of a picture lie apart");

    output::FileGroup files;
    keep_inputs(files, options);
    std::vector<std::filesystem::path> paths;
    for (const render::View& view : views) paths.push_back(folder / file_name(std::string(view.name), options.names == "word"));
    paths.push_back(folder / "sheet.png");
    output::make_folder(folder);
    if (!options.glb.empty())
        files.add(options.glb, output::write_glb(prepared.mesh, field.values, drawn.range, output::ball_around(prepared.mesh)));
    for (const std::filesystem::path& path : paths) keep_others(path, is_our_picture);
    add_pictures(files, paths, drawn.sheet, bare, request.sight);
    files.publish();
    for (const std::filesystem::path& path : paths) print_path(path);
    return ExitCode::ok;
}

/// Refuses options that do not go with the output that the others ask for.
void check_flags(const RenderFlags& options) {
    const bool figure = !options.output.empty(), views = !figure && !options.terminal;
    const auto refuse = [](const std::string& option, const std::string& with, const std::string& remedy) {
        throw UsageError(option + " does not go with " + with, remedy);
    };
    if (figure && options.terminal) refuse("--terminal", "-o", "give one of them");
    if (views && options.meshes.size() > 1)
        throw UsageError("several meshes make one figure", "name its file with -o, such as -o figure.pdf");
    if (views && contains(split(options.field, ','), "distance"))
        throw UsageError("--field distance needs another mesh and -o", "meshfolio render A B --field distance -o figure.pdf");
    if (views && options.meshes.front() == "-" && options.out.empty())
        throw UsageError("render - needs --out DIR, as standard input has no name for a folder", "give one, or -o FILE");
    for (const std::string& mesh : options.meshes)
        if (&mesh != &options.meshes.front()) check_read_once(options.meshes.front(), mesh);
    const std::filesystem::path out(options.out);
    if (contains({".png", ".pdf", ".svg", ".jpg", ".jpeg", ".gif", ".tif", ".tiff", ".eps", ".ps", ".webp"},
                 lower_case_ending(out.has_filename() ? out : out.parent_path())))
        throw UsageError("--out is a folder, but " + in_quotes(options.out) + " is called like a picture", "name one figure with -o");
    if (!options.values.empty() && options.meshes.size() > 1) refuse("--values", "several meshes", "render each by itself");
    const bool has_values = !options.values.empty() || (options.field != "none" && options.field != "id");
    if (!options.isolines.empty() && !has_values) throw UsageError("--isolines needs values", "take --field or --values with it");
    if (views) {
        for (const auto& [name, is_given] : {std::pair{"--width-mm", !options.width.empty()}, std::pair{"--dpi", !options.dpi.empty()},
                                             std::pair{"--columns", !options.columns.empty()}, std::pair{"--fit", !options.fit.empty()},
                                             std::pair{"--bar", options.bar != "on"}})
            if (is_given) throw UsageError(std::string(name) + " is for one figure", "name its file with -o");
        if (split(options.field, ',').size() > 1) throw UsageError("several fields make one figure", "name its file with -o");
        return;
    }
    for (const auto& [name, is_given] :
         {std::pair{"--out", !options.out.empty()}, std::pair{"--size", options.size != "1024"}, std::pair{"--plain", options.plain},
          std::pair{"--glb", !options.glb.empty()}, std::pair{"--width-mm", options.terminal && !options.width.empty()},
          std::pair{"--dpi", options.terminal && !options.dpi.empty()}})
        if (is_given)
            refuse(name, options.terminal ? "--terminal" : "-o",
                   options.terminal ? "leave it out" : "it is for the views of one mesh, in a folder");
}

ExitCode run_render(const RenderFlags& options) {
    check_flags(options);
    return options.terminal || !options.output.empty() ? run_figure(options) : run_views(options);
}

}   // namespace

Command render_command(CLI::App& parent) {
    const auto options = std::make_shared<RenderFlags>();
    CommandOptions app(parent, "render", "Six views of a mesh, or one figure of meshes and fields");
    app.required_texts("MESH", options->meshes, formats_read);
    app.text("--out DIR", options->out,
             "folder for +x.png … -z.png and sheet.png, whose paths are printed; default: a folder called as the mesh");
    app.text("-o,--output FILE", options->output,
             "one figure instead, .pdf, .svg or .png: pictures of all meshes in all fields, in print quality, with words and colour bars");
    app.flag("--terminal", options->terminal, "show the figure in the terminal instead");
    app.choice("--names", options->names, {"sign", "word"}, "of the pictures: +x.png, or x-pos.png");
    app.text("--views VIEWS", options->views,
             "some of +x,-x,+y,-y,+z,-z,hero (from above, where most is seen),camera; default: the six, in a figure camera or hero");
    add_sight_options(app, options->sight);
    app.text("--size PIXELS", options->size, "pixels of one view: N or WxH");
    app.text("--field NAMES", options->field,
             "what is drawn in colours: " + meshfolio::joined(field_names(), ", ") +
                 "; h-… is the mean curvature by that operator; distance, that to the first mesh. A figure takes several, with commas");
    app.text("--values FILE:COLUMN", options->values, "values from FILE.csv:COLUMN, one row a vertex, or of a mesh, FILE.ply:PROPERTY");
    app.text("--colormap NAME", options->colormap,
             "see meshfolio list, or a file (CSV, or JSON of ParaView); default: diverging for signed values, pale for distances, viridis "
             "otherwise");
    app.text("--range LOW,HIGH", options->range, "lo,hi of the colours; default: robust");
    app.text("--isolines", options->isolines, "lines where the value is a multiple of this");
    app.text("--glb FILE", options->glb, "also the mesh with its values and colours as binary glTF, to be turned in other programs");
    app.text("--title WORDS", options->title, "of the sheet or the figure");
    app.text("--background COLOUR", options->background, "white, none or #rrggbb");
    app.text("--width-mm MM", options->width, "width of a figure; default: 85 for one picture in a line, else 170");
    app.text("--dpi N", options->dpi, "pixels per inch of a figure; default: 300");
    app.text("--columns N", options->columns, "pictures in a line of a figure");
    app.choice("--fit", options->fit, {"each", "common"}, "each mesh of a figure fills its picture (default), or all are in one frame");
    app.choice("--bar", options->bar, {"on", "off"}, "the colour bars of a figure");
    app.flag("--edges", options->edges, "draw triangle edges");
    app.flag("--plain", options->plain, "no labels, colour bar, shading or antialiasing: flat colours, for checks");
    app.footer(
        "Example: meshfolio render bunny.off --field h-cotan --range -20,20 --views +z,-z --out views\n"
        "         meshfolio render a.obj b.obj c.obj --field h-cotan,gauss --camera 35,22 --width-mm 85 -o figure.pdf");
    return {app, [options] { return run_render(*options); }};
}

}   // namespace meshfolio::cli
