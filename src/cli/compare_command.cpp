#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "base/number_text.h"
#include "cli/commands.h"
#include "mesh/io/mesh_files.h"
#include "mesh/triangle_measures.h"
#include "run/arguments.h"
#include "run/console.h"
#include "run/one_mesh/difference_lines.h"
#include "run/one_mesh/fields.h"
#include "run/one_mesh/terminal_figure.h"

namespace meshfolio::cli {

namespace {

constexpr int rows_of_numbers = 24, least_rows = 16;   // below a picture in the terminal; of the picture

struct CompareFlags {
    std::string a, b, measure, csv, ply, html, accuracy = plain_text(default_accuracy);
    bool json = false, surfaces = false, terminal = false;
    SightFlags sight;
};

std::string in_words(const std::vector<DifferenceLine>& lines) {
    std::string text;
    for (const DifferenceLine& line : lines) {
        const std::string value = std::isfinite(line.value) ? plain_text(line.value) : "undefined", key = line.key;
        text += key + std::string(34 - key.size(), ' ') + value;
        if (*line.meaning != '\0') text += std::string(value.size() < 14 ? 14 - value.size() : 1, ' ') + line.meaning;
        text += "\n";
    }
    return text;
}

/// Returns the value of a measure by its key, in which hyphens are underscores. @throws UsageError if there is no such measure
std::string value_of(std::string measure, const std::vector<DifferenceLine>& lines) {
    std::ranges::replace(measure, '-', '_');
    std::vector<std::string> keys;
    for (const DifferenceLine& line : lines) {
        if (line.key == measure) return plain_text(line.value);
        keys.emplace_back(line.key);
    }
    require_choice("MEASURE", measure, keys);
    return "";
}

/// Gives B the triangles of A if the files have equal triangles: repairs may have turned them in one mesh alone, such as a smoothed surface
/// that ends inside out.
void take_triangles_of_file(const CompareFlags& options, const PreparedMesh& a, PreparedMesh& b) {
    const bool once = options.a == "-" || options.b == "-";   // standard input cannot be read again
    if (once || a.mesh.vertex_count() != b.mesh.vertex_count() || have_same_triangles(a.mesh, b.mesh)) return;
    if (have_same_triangles(read_mesh(options.a).mesh, read_mesh(options.b).mesh)) b.mesh.F = a.mesh.F;
}

/// Adds the output files, which need the distances between the surfaces.
void add_files(output::FileGroup& files, const CompareFlags& options, const PreparedMesh& a, const PreparedMesh& b,
               const Difference& difference, const SurfaceDistances& distances) {
    const std::vector<VertexColumn> columns{{"distance", distances.a_to_b.of_vertices, ScalarType::float32}};
    if (!options.ply.empty()) add_mesh(files, options.ply, a.mesh, attributes_with(a, columns));
    if (!options.html.empty()) files.add(options.html, difference_page(a, b, difference, distances, sight_of(options.sight)));
    if (!options.csv.empty()) print_to(files, options.csv, vertex_table(a, columns));
}

/// Returns a picture of both meshes in one frame, coloured by their distances to each other.
std::string picture_of_both(const PreparedMesh& a, const PreparedMesh& b, const SurfaceDistances& distances, const render::Sight& sight,
                            TerminalRoom room) {
    const double diagonal = bounding_box(a.mesh).diagonal();
    std::vector<FigureMesh> meshes{{"A: " + a.file, a, {distance_field(distances.a_to_b.of_vertices, diagonal)}},
                                   {"B: " + b.file, b, {distance_field(distances.b_to_a.of_vertices, diagonal)}}};
    room.size.rows = std::max(least_rows, room.size.rows - rows_of_numbers);
    return terminal_figure(std::move(meshes), {.sight = sight, .common_fit = true}, room);
}

ExitCode run_compare(const CompareFlags& options) {
    if (options.json && options.csv == "-") throw UsageError("--json and --csv - both write to standard output", "name a file for --csv");
    if (options.terminal && (options.json || options.csv == "-"))
        throw UsageError("--terminal goes with neither --json nor --csv -", "take one of them");
    if (!options.measure.empty() && (options.json || options.terminal || options.csv == "-"))
        throw UsageError("one measure goes with neither --json, --terminal nor --csv -", "take one of them");
    sight_of(options.sight);   // throws
    const TerminalRoom room = options.terminal ? terminal_room() : TerminalRoom();
    check_read_once(options.a, options.b);
    check_output("--csv", options.csv, {".csv", "-"});
    check_output("--ply", options.ply, column_endings());
    check_output("--html", options.html, {".html", ".htm"});
    const double accuracy = number_between("--accuracy", options.accuracy, least_accuracy, most_accuracy);
    const PreparedMesh a = load_mesh(options.a, Checks::all, options.ply.empty() ? Keep::mesh : Keep::attributes);
    PreparedMesh b = load_mesh(options.b);
    take_triangles_of_file(options, a, b);
    const Difference difference = about_mesh(options.b, [&] { return difference_of(a.mesh, b.mesh, options.surfaces, accuracy); });
    for (const std::string& warning : difference.warnings) warn(warning);
    output::FileGroup files;
    for (const std::string& file : {options.a, options.b}) files.keep(file);
    std::string picture;
    if (options.terminal || !options.csv.empty() || !options.ply.empty() || !options.html.empty()) {
        const SurfaceDistances distances = difference.distances ? *difference.distances : surface_distances(a.mesh, b.mesh, most_accuracy);
        add_files(files, options, a, b, difference, distances);
        if (options.terminal) picture = picture_of_both(a, b, distances, sight_of(options.sight), room);
    }
    files.publish();
    if (!options.measure.empty()) {
        print(value_of(options.measure, difference.lines) + "\n");
    } else if (options.json) {
        print(difference_json(difference));
    } else if (options.csv != "-") {
        print(picture + for_terminal(in_words(difference.lines)));
    }
    return ExitCode::ok;
}

}   // namespace

Command compare_command(CLI::App& parent) {
    const auto options = std::make_shared<CompareFlags>();
    CommandOptions app(parent, "compare", "Distances, normals, areas, volumes of two meshes, in model units");
    app.required("A", options->a, "the reference");
    app.required("B", options->b, "the other mesh, with the same triangles or others");
    app.text("MEASURE", options->measure, "print this value of --json alone, such as rms");
    app.flag("--surfaces", options->surfaces, "compare surfaces, even if the triangles are the same and vertices correspond");
    app.text("--accuracy X", options->accuracy, "largest share by which hausdorff_bound exceeds hausdorff, from 1e-9 to 1");
    app.flag("--json", options->json, "for programs");
    app.text("--csv FILE", options->csv, "the distance of every vertex of A to the surface of B: file, or - for standard output");
    app.text("--ply FILE", options->ply, "A, with this distance as a property of its vertices");
    app.text("--html FILE", options->html, "a page of both: pictures by one camera, distances, numbers");
    app.flag("--terminal", options->terminal, "show both in the terminal, coloured by their distances to each other");
    add_sight_options(app, options->sight);
    app.footer("Example: meshfolio compare clean.ply denoised.ply --json");
    return {app, [options] { return run_compare(*options); }};
}

}   // namespace meshfolio::cli
