#include <Eigen/Geometry>
#include <set>
#include <span>

#include "questions/stability/study.h"

namespace meshfolio::stability {

namespace {

/// Returns the positions turned about a vertex so that its normal faces the viewer of the three-quarter view.
Positions turned(const TriangleMesh& mesh, int vertex) {
    const Vector3 normal = vertex_normals(mesh).row(vertex), towards_viewer = Vector3(0.53, 0.37, 0.76).normalized();
    if (!(normal.squaredNorm() > 0)) return mesh.X;
    const Eigen::Matrix3d turn = Eigen::Quaterniond::FromTwoVectors(normal, towards_viewer).toRotationMatrix();
    return (mesh.X.rowwise() - mesh.X.row(vertex)) * turn.transpose();
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

void add_top_mode_figure(Answer& answer, const Studies& studies) {
    constexpr int rings = 4;
    output::FigureRequest request{
        .id = "stability_top_modes", .title = words.line("top_modes.title"), .layout = output::Layout::multiples, .coarse_edges = true};
    std::vector<output::Panel> near;
    for (const StabilityStudy& study : studies) {
        const int vertex = study.limiting.vertex;
        const Vector& mode = study.cotangent().certificate.top.mode;
        const Vector height = mode / mode.cwiseAbs().maxCoeff();
        const std::string label = words.line("top_modes.panel", "mesh"_a = study.name(), "vertex"_a = vertex);
        const Neighbourhood patch = neighbourhood(study.mesh(), study.topology(), vertex, rings);
        request.panels.push_back(
            panel_of(moved_to(study.mesh(), turned(study.mesh(), vertex)), id_of("stability", study.name(), "mode"), label, height));
        request.panels.back().marked_vertices = {vertex};
        near.push_back(panel_of(patch.mesh, id_of("stability", study.name(), "patch"), label, height(patch.original)));
        near.back().marked_vertices = {patch.vertex};
        request.columns.push_back(label);
    }
    request.rows = {words.line("top_modes.whole"), words.line("top_modes.near", "rings"_a = rings)};
    std::ranges::move(near, std::back_inserter(request.panels));
    request.range = output::robust_range(request.panels, "diverging", "φ / max |φ|", "", 1);   // white at 0: edges stay visible
    request.range->low = -1;
    request.range->high = 1;
    request.range->clipped_below = request.range->clipped_above = 0;
    const std::string caption = words.line("top_modes.caption");
    add_figure(answer, std::move(request), caption, caption);
}

void add_place_figure(Answer& answer, const Planes& planes) {
    std::set<std::string> letters;
    for (const SmoothingMaps& maps : planes)
        for (const MapPlace& place : maps.places) letters.insert(place.letter);
    output::FigureRequest request{.id = "stability_places",
                                  .title = words.line("places.title"),
                                  .frame_panel = -1,
                                  .layout = output::Layout::multiples,
                                  .columns = {words.line("places.input")},
                                  .coarse_edges = true,
                                  .states = static_cast<int>(1 + letters.size())};
    request.columns.insert(request.columns.end(), letters.begin(), letters.end());
    std::vector<output::Panel> inputs;
    Names left;
    for (const SmoothingMaps& maps : planes) {
        request.rows.push_back(maps.name());
        request.panels.push_back(smoothing_panel(maps.subject, maps.subject.mesh().X, id_of("stability", maps.name(), "input"), "input"));
        inputs.push_back(request.panels.back());
        for (const std::string& letter : letters) {
            const std::string name = id_of("stability", maps.name(), letter);
            const auto place = std::ranges::find(maps.places, letter, &MapPlace::letter);
            if (place == maps.places.end()) {
                request.panels.push_back({name, "–", nullptr});
                continue;
            }
            request.panels.push_back(smoothing_panel(maps.subject, place->X, name, letter));
            if (letter != "d") continue;
            const double size = maps.implicit_map().size[maps.index(place->step, place->row)];
            left.push_back(words.line("places.left", "mesh"_a = maps.name(), "size"_a = share_left(size)));
        }
    }
    request.range = curvature_range(inputs);
    const std::string caption =
        words.line("places.caption", "left"_a = listed(left), "beyond"_a = letters.contains("b"), "clean"_a = letters.contains("e"));
    add_figure(answer, std::move(request), caption, caption);
}

}   // namespace meshfolio::stability
