#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/number_text.h"
#include "cli/commands.h"
#include "mesh/io/mesh_files.h"
#include "run/console.h"
#include "run/one_mesh/difference_lines.h"

namespace meshfolio::cli {

namespace {

std::string as_json(const std::vector<DifferenceLine>& lines) {
    nlohmann::ordered_json json;
    for (const DifferenceLine& line : lines)
        json[line.key] = std::isfinite(line.value) ? nlohmann::ordered_json(line.value) : nlohmann::ordered_json();
    json["inverted_faces"] = static_cast<int>(lines.back().value);
    return json.dump(2) + "\n";
}

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

/// Repairs may turn the triangles of one mesh and not of the other (a smoothed surface can end inside out): when the files agree on the
/// triangles, those of A count for both.
std::vector<DifferenceLine> difference_of(const std::string& a, const std::string& b) {
    const TriangleMesh reference = load_mesh(a).mesh, other = load_mesh(b).mesh;
    const auto same_triangles = [](const TriangleMesh& p, const TriangleMesh& q) {
        return p.vertex_count() == q.vertex_count() && p.face_count() == q.face_count() && p.F == q.F;
    };
    if (!same_triangles(reference, other) && same_triangles(read_mesh(a).mesh, read_mesh(b).mesh))
        return difference_lines(reference, moved_to(reference, other.X));
    return difference_lines(reference, other);
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
                const std::vector<DifferenceLine> lines = about_mesh(options->b, [&] { return difference_of(options->a, options->b); });
                print(options->json ? as_json(lines) : in_words(lines));
                return ExitCode::ok;
            }};
}

}   // namespace meshfolio::cli
