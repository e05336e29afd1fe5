#include <Eigen/Geometry>

#include "questions/stability/parts.h"

namespace meshfolio::stability {

namespace {

/// Where the renderer's three-quarter view looks from, near enough to see a patch from above.
const Vector3 towards_viewer = Vector3(0.53, 0.37, 0.76).normalized();

/// The positions turned about a vertex so that its normal faces the viewer.
Positions turned(const TriangleMesh& mesh, int vertex) {
    const Vector3 normal = vertex_normals(mesh).row(vertex);
    if (!(normal.squaredNorm() > 0)) return mesh.X;
    const Eigen::Matrix3d turn = Eigen::Quaterniond::FromTwoVectors(normal, towards_viewer).toRotationMatrix();
    return (mesh.X.rowwise() - mesh.X.row(vertex)) * turn.transpose();
}

/// One colour range for all, from `low` to 1.
void add_multiples(Answer& answer, output::FigureRequest request, const std::string& caption, const std::string& colormap,
                   const std::string& quantity, double low) {
    request.range = output::robust_range(request.panels, colormap, quantity, "", 1);
    request.range->low = low;
    request.range->high = 1;
    request.range->clipped_below = request.range->clipped_above = 0;
    request.layout = output::Layout::multiples;
    add_figure(answer, std::move(request), caption, caption);
}

}   // namespace

Neighbourhood neighbourhood(const TriangleMesh& mesh, const MeshTopology& topology, int vertex, int rings) {
    std::vector<bool> within(mesh.vertex_count());
    const auto is_within = [&](int v) { return within[v]; };
    std::vector<int> front{vertex}, faces;
    is_within(vertex) = true;
    for (int ring = 1; ring <= rings; ++ring) {
        std::vector<int> next;
        for (const int v : front) {
            for (const int w : std::span(topology.neighbours.begin(v), topology.neighbours.end(v))) {
                if (is_within(w)) continue;
                is_within(w) = true;
                next.push_back(w);
            }
        }
        front = std::move(next);
    }
    for (int t = 0; t < mesh.face_count(); ++t)
        if (std::ranges::all_of(mesh.F.row(t), is_within)) faces.push_back(t);
    const TriangleMesh kept{turned(mesh, vertex), mesh.F(faces, Eigen::all)};
    CompactMesh compact = without_unreferenced_vertices(kept);
    Neighbourhood patch{std::move(compact.mesh), std::move(compact.original), 0};
    while (patch.original[patch.vertex] != vertex) ++patch.vertex;
    return patch;
}

void add_limiting_vertex_figures(Answer& answer, const Studies& studies, const std::string& colormap) {
    constexpr int rings = 4;
    output::FigureRequest whole{.id = "stability_top_modes", .title = words.line("top_modes.title")};
    output::FigureRequest near{.id = "stability_close_ups",
                               .title = words.line("close_ups.title"),
                               .subtitle = words.line("close_ups.subtitle", "rings"_a = rings),
                               .edges = true};
    std::string caption = words.line("close_ups.caption");
    for (const StabilityStudy& study : studies) {
        const LimitingVertex& v = study.limiting;
        const Vector& mode = study.cotangent.certificate.top.mode;
        const Vector height = mode / mode.cwiseAbs().maxCoeff();
        const std::string label = study.name() + ", vertex " + std::to_string(v.vertex);
        const Neighbourhood patch = neighbourhood(study.mesh(), study.topology(), v.vertex, rings);
        whole.panels.push_back(panel_of(moved_to(study.mesh(), turned(study.mesh(), v.vertex)), id_of("stability", study.name(), "mode"),
                                        label, height.cwiseAbs()));
        whole.panels.back().marked_vertices = {v.vertex};
        near.panels.push_back(panel_of(patch.mesh, id_of("stability", study.name(), "patch"), label, height(patch.original)));
        near.panels.back().marked_vertices = {patch.vertex};
        caption +=
            " " + words.line("close_ups.caption.mesh", "mesh"_a = study.name(), "angle"_a = readable(v.smallest_angle * 180 / pi, 2));
    }
    add_multiples(answer, std::move(whole), words.line("top_modes.caption"), colormap, "|φ| / max |φ|", 0);
    // With its sign the mode is drawn on white where it is 0: edges stay visible.
    add_multiples(answer, std::move(near), caption, "diverging", "φ / max |φ|", -1);
}

}   // namespace meshfolio::stability
