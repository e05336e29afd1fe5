#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/number_text.h"
#include "cli/commands.h"
#include "geometry/measures/mesh_error.h"
#include "mesh/io/mesh_files.h"
#include "run/console.h"

namespace meshfolio::cli {

namespace {

struct Line {
    const char* key;
    double value;
    const char* meaning;
};

std::vector<Line> lines_of(const TriangleMesh& a, const TriangleMesh& b) {
    const MeshDifference d = compare_meshes(a, b);
    const double degrees = 180 / std::numbers::pi;
    return {{"rms", d.rms, "sqrt(sum d^2 / n) over vertices"},
            {"max", d.max, "largest vertex distance"},
            {"hausdorff", hausdorff_distance(a, b), "two-sided, vertices to surface"},
            {"mean_normal_angle_deg", degrees * d.mean_normal_angle, "between corresponding faces"},
            {"volume_ratio", d.volume_ratio, "B over A"},
            {"area_ratio", d.area_ratio, "B over A"},
            {"area_weighted_rms", d.area_weighted_rms, "with the vertex areas of A"},
            {"mean_squared_normal_angle_deg2", degrees * degrees * d.mean_squared_normal_angle, ""},
            {"box_diagonal", d.box_diagonal, "of A"},
            {"inverted_faces", static_cast<double>(d.inverted_faces), "normal turned by more than 90 degrees"}};
}

std::string as_json(const std::vector<Line>& lines) {
    nlohmann::ordered_json json;
    for (const Line& line : lines)
        json[line.key] = std::isfinite(line.value) ? nlohmann::ordered_json(line.value) : nlohmann::ordered_json();
    json["inverted_faces"] = static_cast<int>(lines.back().value);
    return json.dump(2) + "\n";
}

std::string in_words(const std::vector<Line>& lines) {
    std::string text;
    for (const Line& line : lines) {
        const std::string value = std::isfinite(line.value) ? plain_text(line.value) : "undefined", key = line.key;
        text += key + std::string(34 - key.size(), ' ') + value;
        if (*line.meaning != '\0') text += std::string(value.size() < 14 ? 14 - value.size() : 1, ' ') + line.meaning;
        text += "\n";
    }
    return text;
}

/// Repairs may turn the triangles of one mesh and not of the other (a smoothed surface can end inside out): when the files agree on the
/// triangles, those of A count for both.
std::vector<Line> difference_of(const std::string& a, const std::string& b) {
    const TriangleMesh reference = load_mesh(a).mesh, other = load_mesh(b).mesh;
    const auto same_triangles = [](const TriangleMesh& p, const TriangleMesh& q) {
        return p.vertex_count() == q.vertex_count() && p.face_count() == q.face_count() && p.F == q.F;
    };
    if (!same_triangles(reference, other) && same_triangles(read_mesh(a).mesh, read_mesh(b).mesh))
        return lines_of(reference, moved_to(reference, other.X));
    return lines_of(reference, other);
}

}   // namespace

Command compare_command(CLI::App& parent) {
    struct Options {
        std::string a, b;
        bool json = false;
    };
    const auto options = std::make_shared<Options>();
    CommandOptions app(parent, "compare", "Errors between two meshes with the same triangles, in model units");
    app.required("A", options->a, "the reference");
    app.required("B", options->b, "the other");
    app.flag("--json", options->json, "for programs");
    app.footer("Example: meshfolio compare clean.ply denoised.ply --json");
    return {app, [options] {
                const std::vector<Line> lines = about_mesh(options->b, [&] { return difference_of(options->a, options->b); });
                print(options->json ? as_json(lines) : in_words(lines));
                return ExitCode::ok;
            }};
}

}   // namespace meshfolio::cli
