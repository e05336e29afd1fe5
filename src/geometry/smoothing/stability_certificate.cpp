#include "geometry/smoothing/stability_certificate.h"

#include "base/errors.h"
#include "geometry/spectrum/eigenvalue_enclosure.h"
#include "geometry/spectrum/top_lanczos.h"

namespace meshfolio {

StabilityCertificate stability_certificate(const LaplaceBeltrami& laplacian, const CertificateOptions& options) {
    const auto report = [&](std::string_view stage) {
        if (options.progress) options.progress(stage);
    };
    OperatorWithMass whole = operator_with_mass(laplacian);
    report("largest eigenvalue");
    const TopEstimate estimate = top_estimate(whole);
    const Vector guess = top_mode(whole, estimate.mu, estimate.phi).mode(whole.vertex);
    const double unit = std::exp2(std::round(std::log2(whole.M.mean())));   // a power of two: scaling by it is exact
    whole.M /= unit;
    const double bound = gershgorin_bound(whole.A, whole.M);
    if (!(bound > 0))
        throw MeshError("stability certificate: no two vertices are joined by a weight", "take a mesh with triangles of some area");
    report("proof of the largest eigenvalue");
    const Enclosure enclosure =
        enclose_largest(whole.A, whole.M, guess, {.high = bound, .width = options.width, .missing = estimate.change});

    StabilityCertificate certificate;
    certificate.mu_low = enclosure.low / unit;
    certificate.mu_high = enclosure.high / unit;
    certificate.rounding = enclosure.rounding / enclosure.high;
    certificate.factorisations = enclosure.factorisations;
    certificate.failed = enclosure.failed;
    certificate.factor_nonzeros = enclosure.factor_nonzeros;
    whole.M *= unit;
    certificate.top = top_mode(whole, enclosure.quotient / unit, enclosure.y);
    certificate.top.upper_bound = bound / unit;
    report("proof that no eigenvalue is below 0");
    certificate.bottom = definiteness(laplacian, options.assembly);
    return certificate;
}

bool is_positive_definite_at(const LaplaceBeltrami& laplacian, double sigma) {
    const OperatorWithMass whole = operator_with_mass(laplacian);
    return factor_at(whole.A, whole.M, sigma).has_value();
}

}   // namespace meshfolio
