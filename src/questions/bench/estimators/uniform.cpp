// H from the uniform Laplacian, whose lengths 4/h² makes curvatures.
#include "geometry/operators/uniform_laplacian.h"

#include "geometry/curvature/curvature.h"
#include "questions/bench/estimators.h"

namespace meshfolio::estimates {

extern const Estimator H_uniform{"H.uniform", "uniform",
                                 Quantity::H, [](const BenchMesh& b) { return uniform_mean_curvature_scaled(b.mesh, b.topology); },
                                 true,        "uniform, × 4/h²"};

extern const Estimator H_uniform_along_normal{"H.uniform_n", "uniform.along_normal", Quantity::H, [](const BenchMesh& b) -> Vector {
                                                  const Positions laplacian_of_x = uniform_laplacian(b.topology) * b.mesh.X;
                                                  const Vector along_normal = -0.5 * laplacian_of_x.cwiseProduct(b.normals).rowwise().sum();
                                                  return 4 * along_normal.cwiseQuotient(mean_squared_ring_edge(b.mesh, b.topology));
                                              }};

}   // namespace meshfolio::estimates
