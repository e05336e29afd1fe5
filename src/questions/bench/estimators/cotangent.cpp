// H from the cotangent operator and K from the angle deficit, with three kinds of areas.
#include "geometry/operators/cotangent_laplacian.h"

#include <cmath>

#include "geometry/curvature/curvature.h"
#include "questions/bench/estimators.h"

namespace meshfolio::estimates {

namespace {

using enum AreaForm;

const Vector& areas(const BenchMesh& b, AreaForm form) {
    if (form == barycentric) return b.areas;
    return b.shared(std::string(name_of(form)), [&] { return vertex_areas(b.mesh, form); });
}

template <AreaForm form>
Vector H(const BenchMesh& b) {
    return cotangent_mean_curvature(b.mesh, b.topology, {b.C(), areas(b, form)});
}

/// −½Δx · n with the normal of the surface; NaN where the vertex has no area.
template <AreaForm form>
Vector H_along_normal(const BenchMesh& b) {
    const Vector& pull = b.shared("−½Cx · n", [&]() -> Vector {
        const Positions Cx = b.C() * b.mesh.X;
        return -0.5 * Cx.cwiseProduct(b.normals).rowwise().sum();
    });
    const Vector& A = areas(b, form);
    return (A.array() > 0).select(pull.cwiseQuotient(A), std::nan(""));
}

template <AreaForm form>
Vector K(const BenchMesh& b) {
    return gaussian_curvature(b.topology, b.angle_deficits(), areas(b, form));
}

Vector clamped(const BenchMesh& b) {
    return cotangent_mean_curvature(b.mesh, b.topology, laplace_beltrami(b.mesh, barycentric, {.clamp_negative = true}));
}

}   // namespace

extern const Estimator H_barycentric{"H.barycentric", "cotangent.barycentric", Quantity::H, H<barycentric>, true, "barycentric"};
extern const Estimator H_voronoi{"H.voronoi", "cotangent.voronoi", Quantity::H, H<voronoi>, true, "Voronoi"};
extern const Estimator H_mixed{"H.mixed", "cotangent.mixed", Quantity::H, H<mixed>, true, "mixed"};
extern const Estimator H_clamped{"H.clamped", "cotangent.clamped", Quantity::H, clamped, false, "clamped"};

extern const Estimator H_barycentric_along_normal{"H.barycentric_n", "cotangent.barycentric.along_normal", Quantity::H,
                                                  H_along_normal<barycentric>};
extern const Estimator H_voronoi_along_normal{"H.voronoi_n", "cotangent.voronoi.along_normal", Quantity::H, H_along_normal<voronoi>};
extern const Estimator H_mixed_along_normal{"H.mixed_n", "cotangent.mixed.along_normal", Quantity::H, H_along_normal<mixed>};

extern const Estimator K_barycentric{"K.barycentric", "deficit.barycentric", Quantity::K, K<barycentric>};
extern const Estimator K_voronoi{"K.voronoi", "deficit.voronoi", Quantity::K, K<voronoi>};
extern const Estimator K_mixed{"K.mixed", "deficit.mixed", Quantity::K, K<mixed>};

}   // namespace meshfolio::estimates
