#include "questions/stability/figures.h"

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "base/number_text.h"
#include "mesh/triangle_measures.h"
#include "questions/core/six_view_figure.h"
#include "questions/core/study_list.h"

namespace meshfolio::stability {

namespace {

/// Where the renderer's three-quarter view looks from, near enough to see a patch from above.
const Vector3 towards_viewer = Vector3(0.53, 0.37, 0.76).normalized();

/// |φ| over its largest value.
Vector height_of(const LargestEigenvalue& top) { return top.mode.cwiseAbs() / top.mode.cwiseAbs().maxCoeff(); }

/// The positions turned about a vertex so that its normal faces the viewer.
Positions turned(const TriangleMesh& mesh, int vertex) {
    const Vector3 normal = vertex_normals(mesh).row(vertex);
    if (!(normal.squaredNorm() > 0)) return mesh.X;
    const Eigen::Matrix3d turn = Eigen::Quaterniond::FromTwoVectors(normal, towards_viewer).toRotationMatrix();
    return (mesh.X.rowwise() - mesh.X.row(vertex)) * turn.transpose();
}

output::Panel marked(output::Panel panel, int vertex) {
    panel.marked_vertices = {vertex};
    return panel;
}

/// One colour range for all, from `low` to 1.
void add_multiples(Answer& answer, output::FigureRequest request, const std::string& caption, const std::string& colormap,
                   const std::string& title, double low) {
    request.range = output::robust_range(request.panels, colormap, title, "", 1);
    request.range->low = low;
    request.range->high = 1;
    request.range->clipped_below = request.range->clipped_above = 0;
    request.three_quarter = true;
    answer.section.blocks.push_back(report::Figure{request.id, caption, caption});
    answer.figures.push_back(std::move(request));
}

std::string told(const LimitingVertex& v) {
    return "its area is " + readable(v.area_share, 2) + " of the mean, its weights add up to " + readable(v.stiffness_share, 2) +
           " times the median, and the smallest angle at its triangles is " + readable(v.smallest_angle * 180 / M_PI, 2) + "°";
}

}   // namespace

Neighbourhood neighbourhood(const TriangleMesh& mesh, const MeshTopology& topology, int vertex, int rings) {
    std::vector<int> distance(static_cast<std::size_t>(mesh.vertex_count()), -1), front{vertex};
    distance[static_cast<std::size_t>(vertex)] = 0;
    for (int ring = 1; ring <= rings; ++ring) {
        std::vector<int> next;
        for (const int v : front) {
            for (int k = 0; k < topology.neighbours.size(v); ++k) {
                const int w = topology.neighbours.begin(v)[k];
                if (distance[static_cast<std::size_t>(w)] >= 0) continue;
                distance[static_cast<std::size_t>(w)] = ring;
                next.push_back(w);
            }
        }
        front = std::move(next);
    }
    std::vector<int> faces;
    for (int t = 0; t < mesh.face_count(); ++t) {
        bool inside = true;
        for (const int v : mesh.F.row(t)) inside = inside && distance[static_cast<std::size_t>(v)] >= 0;
        if (inside) faces.push_back(t);
    }
    const TriangleMesh kept{turned(mesh, vertex), mesh.F(faces, Eigen::all)};
    CompactMesh compact = without_unreferenced_vertices(kept);
    Neighbourhood patch{std::move(compact.mesh), std::move(compact.original), 0};
    while (patch.original[patch.vertex] != vertex) ++patch.vertex;
    return patch;
}

void add_limiting_vertex_figures(Answer& answer, const std::vector<StabilityStudy>& studies, const std::string& colormap) {
    constexpr int rings = 4;
    output::FigureRequest whole, near;
    whole.id = "stability_top_modes";
    whole.title = "The top mode and the vertex that sets the limit";
    near.id = "stability_close_ups";
    near.title = "The triangles around the vertex that sets the limit";
    near.subtitle = "within " + std::to_string(rings) + " edges, seen along its normal";
    near.edges = true;
    std::string caption = "The triangles around each of these vertices.";
    for (const StabilityStudy& study : studies) {
        const int vertex = study.limiting.vertex;
        const Vector height = height_of(study.cotangent.certificate.top);
        const Vector signed_height = study.cotangent.certificate.top.mode / study.cotangent.certificate.top.mode.cwiseAbs().maxCoeff();
        const std::string label = study.name() + ", vertex " + std::to_string(vertex);
        const Neighbourhood patch = neighbourhood(study.mesh(), study.source->prepared->topology, vertex, rings);
        whole.panels.push_back(
            marked(panel_of(moved_to(study.mesh(), turned(study.mesh(), vertex)), id_of("stability", study.name(), "mode"), label, height),
                   vertex));
        near.panels.push_back(
            marked(panel_of(patch.mesh, id_of("stability", study.name(), "patch"), label, signed_height(patch.original)), patch.vertex));
        caption += " " + study.name() + ": " + told(study.limiting) + ".";
    }
    add_multiples(answer, std::move(whole),
                  "The mode that explicit smoothing amplifies first, on each mesh, seen along the normal of the ringed vertex, where it is "
                  "largest.",
                  colormap, "|φ| / max |φ|", 0);
    // With its sign the mode is drawn on white where it is 0: edges stay visible.
    add_multiples(answer, std::move(near), caption, "diverging", "φ / max |φ|", -1);
}

}   // namespace meshfolio::stability
