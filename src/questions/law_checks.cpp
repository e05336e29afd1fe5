#include "questions/law_checks.h"

#include <algorithm>
#include <cmath>

#include "errors.h"
#include "geometry/mesh_laws.h"
#include "mesh/triangle_measures.h"
#include "number_text.h"

namespace meshfolio {

using report::check_at_least;
using report::check_at_most;
using report::check_near;

namespace {

/// A count by inertia; NaN, which fails every check, where no factorisation can be trusted.
double counted_negative(const SparseMatrix& C) try { return negative_eigenvalues(C); } catch (const SolverError&) {
    return std::nan("");
}

double volume_in_box(const TriangleMesh& mesh) {
    const Box box = bounding_box(mesh);
    return signed_volume(mesh, box.centre()) / box.extent().prod();
}

}   // namespace

std::vector<report::Check> spectrum_checks(const SpectrumCertificate& c, const std::string& on, const std::string& note) {
    // NaN: no count can be trusted
    const double missed = std::min(c.counted_below, c.counted_above) < 0
                              ? std::nan("")
                              : c.counted_below - c.found_below + std::min(0, c.counted_above - c.pairs);
    const std::string sigma =
        std::to_string(c.found_below) + " found below σ = " + plain_text(c.shift, 4) + (note.empty() ? "" : "; " + note);
    return {check_at_most(law::residual + on, c.residual_limit, c.residual, 0, note),
            check_at_most(law::orthonormal + on, SpectrumCertificate::orthonormality_limit, c.orthonormality_error, 0, note),
            check_at_most(law::parseval + on, SpectrumCertificate::parseval_limit, c.parseval_gap, 0, note),
            check_near(law::complete + on, 0, missed, 0, sigma),
            check_near(law::zeros + on, c.expected_zeros, c.zero_eigenvalues, 0),
            check_at_most(law::ascending + on, SpectrumCertificate::step_down_limit, std::max(0.0, -c.smallest_step_up))};
}

std::vector<report::Check> operator_checks(const TriangleMesh& mesh, const LaplaceBeltrami& laplacian, const std::string& on, int floored) {
    std::vector<report::Check> checks{check_at_most(law::symmetric + on, 1e-14, asymmetry(laplacian.C)),
                                      check_at_most(law::row_sums + on, 1e-12, row_sum_error(laplacian.C)),
                                      check_near(law::mass + on, 1, mass_over_area(mesh, laplacian.M), 1e-10),
                                      check_near(law::semidefinite + on, 0, counted_negative(laplacian.C), 0)};
    if (floored == 0) {
        checks.push_back(check_near(law::energy + on, 1, energy_over_area(mesh, laplacian.C), 1e-9));
        checks.push_back(check_at_most(law::first_variation + on, 1e-8, first_variation_error(mesh, laplacian.C)));
    }
    return checks;
}

std::vector<report::Check> surface_checks(const TriangleMesh& mesh, const Vector& angle_deficits, const SurfaceClaims& claims,
                                          const std::string& on) {
    std::vector<report::Check> checks;
    if (claims.manifold && claims.orientable) checks.push_back(check_near(law::half_edges + on, 0, repeated_half_edges(mesh.F), 0));
    if (claims.manifold && claims.orientable && claims.closed) {
        checks.push_back(check_at_most(law::flux + on, 1e-10, flux_over_area(mesh)));
        checks.push_back(check_at_least(law::outward + on, 1e-12, volume_in_box(mesh)));
    }
    if (claims.manifold) {
        checks.push_back(check_at_most(law::gauss_bonnet + on, gauss_bonnet_tolerance(mesh.face_count()),
                                       gauss_bonnet_error(angle_deficits, claims.euler_characteristic)));
    }
    return checks;
}

}   // namespace meshfolio
