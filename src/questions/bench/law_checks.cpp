#include "questions/bench/law_checks.h"

#include "geometry/measures/mesh_laws.h"
#include "geometry/smoothing/dirichlet_energy.h"
#include "questions/core/section_tools.h"

namespace meshfolio {

namespace {

report::Check semidefinite_check(const SparseMatrix& C, const std::string& on) try {
    const Inertia negative = negative_eigenvalues(C);
    const report::Check check = check_near(law("semidefinite", on), 0, negative.below, 0);
    if (semidefinite(negative) != Proof::undecided) return check;
    return undecided(check, cannot_be_proved(negative.delta, -negative.sigma));
} catch (const SolverError&) {
    return undecided(check_near(law("semidefinite", on), 0, undefined, 0), spectral_words.line("pivot_lost"));
}

}   // namespace

std::string cannot_be_proved(double rounding, double gap) {
    return spectral_words.line("cannot_be_proved", "rounding"_a = readable(rounding, 2), "gap"_a = readable(gap, 2));
}

std::vector<report::Check> spectrum_checks(const SpectrumCertificate& c, const std::string& on, const std::string& note) {
    report::Check residual = check_at_most(law("residual", on), c.residual_limit, c.residual, 0, note);
    if (c.residual_undecided())
        residual = undecided(residual, spectral_words.line("residual_of_rounding", "rounding"_a = readable(c.residual_rounding, 2)));

    const double missed = c.counted_below < 0 ? undefined : c.counted_below - c.found_below;
    const std::string found = spectral_words.line("found_below", "found"_a = c.found_below, "shift"_a = plain_text(c.shift, 4));
    report::Check complete = check_near(law("complete", on), 0, missed, 0, note.empty() ? found : found + "; " + note);
    if (c.says_nothing()) complete = undecided(complete, spectral_words.line("says_nothing"));
    else if (c.complete == Proof::undecided) complete = undecided(complete, cannot_be_proved(c.delta, c.gap));

    report::Check zeros = check_near(law("zeros", on), c.expected_zeros, c.zero_eigenvalues, 0,
                                     c.components > c.pairs ? spectral_words.line("fewer_modes", "components"_a = c.components) : "");
    if (c.zeros_undecided) zeros = undecided(zeros, spectral_words.line("zeros_of_rounding"));

    return {residual,
            check_at_most(law("orthonormal", on), SpectrumCertificate::orthonormality_limit, c.orthonormality_error, 0, note),
            check_at_most(law("parseval", on), SpectrumCertificate::parseval_limit, c.parseval_gap, 0, note),
            complete,
            zeros,
            check_at_most(law("ascending", on), SpectrumCertificate::step_down_limit, std::max(0.0, -c.smallest_step_up))};
}

std::vector<report::Check> operator_checks(const TriangleMesh& mesh, const LaplaceBeltrami& laplacian, const std::string& on,
                                           int without_area) {
    std::vector<report::Check> checks{check_at_most(law("symmetric", on), 1e-14, asymmetry(laplacian.C)),
                                      check_at_most(law("row_sums", on), 1e-12, row_sum_error(laplacian.C)),
                                      check_near(law("mass", on), 1, mass_over_area(mesh, laplacian.M), 1e-10),
                                      semidefinite_check(laplacian.C, on)};
    if (without_area == 0) {
        checks.push_back(report::within_rounding(check_near(law("energy", on), 1, energy_over_area(mesh, laplacian.C), 1e-9),
                                                 energy_rounding(laplacian.C, mesh.X) / surface_area(mesh)));
        checks.push_back(check_at_most(law("first_variation", on), 1e-8, first_variation_error(mesh, laplacian.C)));
    }
    return checks;
}

std::vector<report::Check> surface_checks(const TriangleMesh& mesh, const Vector& angle_deficits, const SurfaceClaims& claims,
                                          const std::string& on) {
    std::vector<report::Check> checks;
    if (claims.manifold && claims.orientable) checks.push_back(check_near(law("half_edges", on), 0, repeated_half_edges(mesh.F), 0));
    if (claims.manifold && claims.orientable && claims.closed) {
        checks.push_back(check_at_most(law("flux", on), 1e-10, flux_over_area(mesh)));
        const Box box = bounding_box(mesh);
        const double volume = signed_volume(mesh, box.centre()) / box.extent().prod();   // NaN in a plane: neither side is the outer one
        if (!std::isnan(volume)) checks.push_back(check_at_least(law("outward", on), 1e-12, volume));
    }
    if (claims.manifold) {
        checks.push_back(check_at_most(law("gauss_bonnet", on), gauss_bonnet_tolerance(mesh.face_count()),
                                       gauss_bonnet_error(angle_deficits, claims.euler_characteristic)));
    }
    return checks;
}

}   // namespace meshfolio
