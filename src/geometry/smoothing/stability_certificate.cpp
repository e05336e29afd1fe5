#include "geometry/smoothing/stability_certificate.h"

#include <cmath>

#include "base/errors.h"
#include "geometry/spectrum/eigenvalue_enclosure.h"

namespace meshfolio {

namespace {

StabilityCertificate certificate_from(const LaplaceBeltrami& laplacian, OperatorWithMass whole, const LargestEigenvalue& guess,
                                      double missing, const CertificateOptions& options) {
    const auto tell = [&](std::string_view what) {
        if (options.progress) options.progress(what);
    };
    const double unit = std::exp2(std::round(std::log2(whole.M.mean())));   // a power of two: scaling by it is exact
    whole.M /= unit;
    const double bound = gershgorin_bound(whole.A, whole.M);
    if (!(bound > 0)) throw MeshError("stability certificate: no two vertices are joined");
    tell("proof of the largest eigenvalue");
    const Enclosure enclosure =
        enclose_largest(whole.A, whole.M, guess.mode(whole.vertex), {.high = bound, .width = options.width, .missing = missing});

    StabilityCertificate certificate;
    certificate.mu_low = enclosure.low / unit;
    certificate.mu_high = enclosure.high / unit;
    certificate.rounding = enclosure.rounding / enclosure.high;
    certificate.factorisations = enclosure.factorisations;
    certificate.failed = enclosure.failed;
    certificate.factor_nonzeros = enclosure.factor_nonzeros;
    whole.M *= unit;
    certificate.top = top_mode(whole, enclosure.quotient / unit, enclosure.y);
    certificate.top.upper_bound = bound / unit;   // that of a guess is not trusted either
    tell("proof that no eigenvalue is below 0");
    certificate.bottom = definiteness(laplacian, options.assembly);
    return certificate;
}

}   // namespace

StabilityCertificate stability_certificate(const LaplaceBeltrami& laplacian, const LargestEigenvalue& guess,
                                           const CertificateOptions& options) {
    const OperatorWithMass whole = operator_with_mass(laplacian);
    if (guess.mode.size() != whole.all_vertices) {
        throw MeshError("stability certificate: a mode of " + std::to_string(guess.mode.size()) + " values for " +
                        std::to_string(whole.all_vertices) + " vertices");
    }
    return certificate_from(laplacian, whole, guess, 0, options);
}

StabilityCertificate stability_certificate(const LaplaceBeltrami& laplacian, const CertificateOptions& options) {
    const OperatorWithMass whole = operator_with_mass(laplacian);
    if (options.progress) options.progress("largest eigenvalue");
    const TopEstimate estimate = top_estimate(whole);
    return certificate_from(laplacian, whole, top_mode(whole, estimate.mu, estimate.phi), estimate.change, options);
}

bool is_positive_definite_at(const LaplaceBeltrami& laplacian, double sigma) {
    const OperatorWithMass whole = operator_with_mass(laplacian);
    return factor_at(whole.A, whole.M, sigma).has_value();
}

}   // namespace meshfolio
