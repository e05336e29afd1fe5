// H from the uniform Laplacian, whose lengths 4/h² makes curvatures.
#include "geometry/operators/uniform_laplacian.h"

#include "geometry/curvature/curvature.h"
#include "mesh/triangle_measures.h"
#include "questions/bench/estimators.h"

namespace meshfolio::estimates {

namespace {

/// −½Δx · n times 4/h².
Vector along(const Positions& normals, const BenchMesh& b) {
    const Positions laplacian_of_x = uniform_laplacian(b.topology) * b.mesh.X;
    const Vector along_normal = -0.5 * laplacian_of_x.cwiseProduct(normals).rowwise().sum();
    return 4 * along_normal.cwiseQuotient(mean_squared_ring_edge(b.mesh, b.topology));
}

}   // namespace

extern const Estimator H_uniform{"H.uniform", "uniform",
                                 Quantity::H, [](const BenchMesh& b) { return uniform_mean_curvature_scaled(b.mesh, b.topology); },
                                 true,        "uniform, × 4/h²"};

extern const Estimator H_uniform_along_normal{"H.uniform_n", "uniform.along_normal", Quantity::H,
                                              [](const BenchMesh& b) { return along(b.normals, b); }};

// What a mesh alone gives: its own normals are no closed form.
extern const Estimator H_uniform_along_own_normal{"H.uniform_own_n", "uniform.along_own_normal", Quantity::H,
                                                  [](const BenchMesh& b) { return along(vertex_normals(b.mesh), b); }, false};

}   // namespace meshfolio::estimates
