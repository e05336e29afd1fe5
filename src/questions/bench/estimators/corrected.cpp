// H and K from corrected curvature measures: three ways to find the normals, and those of the surface.
#include "geometry/curvature/corrected_curvature.h"

#include "questions/bench/estimators.h"

namespace meshfolio::estimates {

namespace {

template <NormalWeights weights>
const CorrectedCurvature& corrected(const BenchMesh& b) {
    return b.shared("corrected" + std::to_string(int(weights)),
                    [&] { return corrected_curvature(b.mesh, b.topology, weighted_vertex_normals(b.mesh, weights)); });
}

const CorrectedCurvature& with_exact_normals(const BenchMesh& b) {
    return b.shared("corrected, exact", [&] { return corrected_curvature(b.mesh, b.topology, b.normals); });
}

template <const CorrectedCurvature& (*curvature)(const BenchMesh&)>
Vector H_of(const BenchMesh& b) {
    return curvature(b).H;
}

template <const CorrectedCurvature& (*curvature)(const BenchMesh&)>
Vector K_of(const BenchMesh& b) {
    return curvature(b).K;
}

using enum NormalWeights;

}   // namespace

extern const Estimator H_corrected_area{"H.corrected_area", "corrected.area", Quantity::H, H_of<corrected<area>>};
extern const Estimator H_corrected_angle{"H.corrected_angle", "corrected.angle", Quantity::H, H_of<corrected<angle>>};
extern const Estimator H_corrected_max{"H.corrected_max", "corrected.max", Quantity::H, H_of<corrected<sphere>>};
extern const Estimator H_corrected_exact{"H.corrected_exact", "corrected.exact", Quantity::H, H_of<with_exact_normals>};

extern const Estimator K_corrected_area{"K.corrected_area", "corrected.area", Quantity::K, K_of<corrected<area>>};
extern const Estimator K_corrected_angle{"K.corrected_angle", "corrected.angle", Quantity::K, K_of<corrected<angle>>};
extern const Estimator K_corrected_max{"K.corrected_max", "corrected.max", Quantity::K, K_of<corrected<sphere>>};
extern const Estimator K_corrected_exact{"K.corrected_exact", "corrected.exact", Quantity::K, K_of<with_exact_normals>};

}   // namespace meshfolio::estimates
