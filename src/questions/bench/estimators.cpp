#include "questions/bench/estimators.h"

#include "geometry/curvature/corrected_curvature.h"
#include "geometry/curvature/curvature.h"
#include "geometry/curvature/jet_fit.h"
#include "geometry/operators/cotangent_laplacian.h"
#include "geometry/operators/uniform_laplacian.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {

namespace {

/// Computes −½Δx · n times 4/h² with the uniform Laplacian Δ, the given normals n and the mean squared edge h² of each ring.
Vector uniform_H_along(const Positions& normals, const BenchMesh& b) {
    const Positions laplacian_of_x = uniform_laplacian(b.topology) * b.mesh.X;
    const Vector along_normal = -0.5 * laplacian_of_x.cwiseProduct(normals).rowwise().sum();
    return 4 * along_normal.cwiseQuotient(mean_squared_ring_edge(b.mesh, b.topology));
}

const Vector& areas_of(const BenchMesh& b, AreaForm form) {
    if (form == AreaForm::barycentric) return b.areas;
    return b.shared(std::string(name_of(form)), [&] { return vertex_areas(b.mesh, form); });
}

template <AreaForm form> Vector cotangent_H(const BenchMesh& b) {
    return cotangent_mean_curvature(b.mesh, b.topology, {b.C(), areas_of(b, form)});
}

Vector clamped_H(const BenchMesh& b) {
    return cotangent_mean_curvature(b.mesh, b.topology, laplace_beltrami(b.mesh, AreaForm::barycentric, {.clamp_negative = true}));
}

/// Computes −½Δx · n, n the normal of the surface and Δ the cotangent operator; NaN where a vertex has no area.
template <AreaForm form> Vector cotangent_H_along_normal(const BenchMesh& b) {
    const Vector& pull = b.shared("−½Cx · n", [&]() -> Vector {
        const Positions Cx = b.C() * b.mesh.X;
        return -0.5 * Cx.cwiseProduct(b.normals).rowwise().sum();
    });
    const Vector& A = areas_of(b, form);
    return (A.array() > 0).select(pull.cwiseQuotient(A), std::nan(""));
}

template <AreaForm form> Vector deficit_K(const BenchMesh& b) {
    return gaussian_curvature(b.topology, b.angle_deficits(), areas_of(b, form));
}

const JetCurvature& jet(const BenchMesh& b) {
    return b.shared("jet", [&] { return jet_curvature(b.mesh, b.topology); });
}

/// Returns the corrected curvature with the normals of the mesh, weighted in one of three ways.
const CorrectedCurvature& corrected(const BenchMesh& b, NormalWeights weights) {
    return b.shared("corrected" + std::to_string(int(weights)),
                    [&] { return corrected_curvature(b.mesh, b.topology, weighted_vertex_normals(b.mesh, weights)); });
}

/// Returns the corrected curvature with the normals of the surface.
const CorrectedCurvature& corrected_exactly(const BenchMesh& b) {
    return b.shared("corrected, exact", [&] { return corrected_curvature(b.mesh, b.topology, b.normals); });
}

}   // namespace

std::span<const Estimator> estimators() {
    using enum AreaForm;
    using enum Quantity;
    using Mesh = BenchMesh;
    using Weights = NormalWeights;

    static constexpr Estimator all[] = {
        {"H.uniform", "uniform", H, [](const Mesh& b) { return uniform_mean_curvature_scaled(b.mesh, b.topology); }, true, "uniform"},
        {"H.uniform_n", "uniform.along_normal", H, [](const Mesh& b) { return uniform_H_along(b.normals, b); }},
        {"H.uniform_own_n", "uniform.along_own_normal", H, [](const Mesh& b) { return uniform_H_along(vertex_normals(b.mesh), b); }, false},
        {"H.barycentric", "cotangent.barycentric", H, cotangent_H<barycentric>, true, "barycentric"},
        {"H.barycentric_n", "cotangent.barycentric.along_normal", H, cotangent_H_along_normal<barycentric>},
        {"H.voronoi", "cotangent.voronoi", H, cotangent_H<voronoi>, true, "Voronoi"},
        {"H.voronoi_n", "cotangent.voronoi.along_normal", H, cotangent_H_along_normal<voronoi>},
        {"H.mixed", "cotangent.mixed", H, cotangent_H<mixed>, true, "mixed"},
        {"H.mixed_n", "cotangent.mixed.along_normal", H, cotangent_H_along_normal<mixed>},
        {"H.clamped", "cotangent.clamped", H, clamped_H, false, "clamped"},
        {"H.jet", "jet", H, [](const Mesh& b) { return jet(b).H; }},
        {"H.corrected_area", "corrected.area", H, [](const Mesh& b) { return corrected(b, Weights::area).H; }},
        {"H.corrected_angle", "corrected.angle", H, [](const Mesh& b) { return corrected(b, Weights::angle).H; }},
        {"H.corrected_max", "corrected.max", H, [](const Mesh& b) { return corrected(b, Weights::sphere).H; }},
        {"H.corrected_exact", "corrected.exact", H, [](const Mesh& b) { return corrected_exactly(b).H; }},
        {"K.barycentric", "deficit.barycentric", K, deficit_K<barycentric>},
        {"K.voronoi", "deficit.voronoi", K, deficit_K<voronoi>},
        {"K.mixed", "deficit.mixed", K, deficit_K<mixed>},
        {"K.jet", "jet", K, [](const Mesh& b) { return jet(b).K; }},
        {"K.corrected_area", "corrected.area", K, [](const Mesh& b) { return corrected(b, Weights::area).K; }},
        {"K.corrected_angle", "corrected.angle", K, [](const Mesh& b) { return corrected(b, Weights::angle).K; }},
        {"K.corrected_max", "corrected.max", K, [](const Mesh& b) { return corrected(b, Weights::sphere).K; }},
        {"K.corrected_exact", "corrected.exact", K, [](const Mesh& b) { return corrected_exactly(b).K; }}};
    return all;
}

std::vector<const Estimator*> panel_estimators(Quantity quantity) {
    std::vector<const Estimator*> chosen;
    for (const Estimator& e : estimators())
        if (e.in_panel && e.quantity == quantity) chosen.push_back(&e);
    return chosen;
}

const Estimator& estimator(std::string_view key) {
    const auto found = std::ranges::find(estimators(), key, &Estimator::key);
    if (found == estimators().end()) throw std::logic_error("no curvature estimator has the key '" + std::string(key) + "'");
    return *found;
}

std::string area_name(AreaForm form) { return form == AreaForm::voronoi ? "Voronoi" : std::string(name_of(form)); }

}   // namespace meshfolio
