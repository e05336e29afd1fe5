#include "questions/bench/spectral_uses.h"

#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "geometry/linear/sparse_factor.h"
#include "geometry/linear/special_values.h"
#include "geometry/operators/laplace_operator.h"
#include "geometry/operators/vertices_with_mass.h"
#include "geometry/spectrum/spectral_mistakes.h"
#include "geometry/spectrum/spectral_reconstruction.h"
#include "questions/core/value_lists.h"

namespace meshfolio {

namespace {

/// Fewer modes than these cannot be parted into three bands worth a picture.
constexpr int fewest_modes = 24;

int zero_modes(const SpectralStudy& study) { return static_cast<int>((study.spectrum.eigenvalues.array() == 0).count()); }

double weighted_rms(const SpectralStudy& study, const Vector& distance) {
    const Vector& M = study.laplacian.M;
    return std::sqrt(M.dot(distance.cwiseAbs2()) / M.sum());
}

EqualisedMesh moved_mesh(const SpectralStudy& study, std::string id, std::string label, Positions X) {
    EqualisedMesh result{std::move(id), std::move(label), moved_to(study.mesh(), std::move(X)), {}, 0, 0};
    result.distance = (result.mesh.X - study.mesh().X).rowwise().norm();
    result.measured_rms = weighted_rms(study, result.distance);
    return result;
}

/// Three bands of equal width in ln k.
std::vector<Band> bands_of(const SpectralStudy& study) {
    const int zeros = zero_modes(study), others = study.modes() - zeros;
    const int low_end = zeros + std::max(3, static_cast<int>(std::round(std::cbrt(others))));
    const int middle_end = zeros + std::max(9, static_cast<int>(std::round(std::pow(others, 2.0 / 3))));
    std::vector<Band> bands{
        {"low", zeros + 1, low_end, 0}, {"middle", low_end + 1, middle_end, 0}, {"high", middle_end + 1, study.modes(), 0}};
    const Vector energy = spectral_coefficients(study.spectrum, study.laplacian.M, study.mesh().X).rowwise().squaredNorm();
    for (Band& band : bands)
        band.energy_share = energy.segment(band.first - 1, band.last - band.first + 1).sum() / energy.tail(others).sum();
    return bands;
}

EqualisedMesh equalised(const SpectralStudy& study, std::string id, std::string label, const Vector& gains, double remainder_gain) {
    const Vector& M = study.laplacian.M;
    EqualisedMesh result =
        moved_mesh(study, std::move(id), std::move(label), filtered(study.spectrum, M, study.mesh().X, gains, remainder_gain));
    result.predicted_rms = filter_displacement(study.spectrum, M, study.mesh().X, gains, remainder_gain);
    return result;
}

/// The two operators' modes at one k, four ways.
MistakeErrors mistakes_at(const SpectralStudy& study, const Spectrum& edge_normalised, const LaplaceBeltrami& other, int k) {
    const Positions& X = study.mesh().X;
    const Vector& M = study.laplacian.M;
    MistakeErrors row;
    row.k = k;
    row.right = vertex_rms(X, reconstruct(study.spectrum, M, X, k));
    row.unmapped = vertex_rms(X, reconstruct_unmapped(study.spectrum, M, X, k));
    row.unweighted = vertex_rms(X, reconstruct_unweighted(study.spectrum, M, X, k));
    const bool known = edge_normalised.eigenvalues.size() >= k;
    row.edge_normalised = known ? vertex_rms(X, reconstruct(edge_normalised, other.M, X, k)) : undefined;
    return row;
}

/// None where negative or missing weights leave the operator without a spectrum.
Spectrum modes_if_any(const LaplaceBeltrami& laplacian, int k) try {
    return smallest_eigenpairs(laplacian, k);
} catch (const SolverError&) {
    return {};
}

}   // namespace

BandStudy band_study(const SpectralStudy& study) {
    if (study.modes() < zero_modes(study) + fewest_modes) return {};
    BandStudy result;
    result.bands = bands_of(study);
    const Vector& mu = study.spectrum.eigenvalues;
    const auto between = [&](int last) { return std::sqrt(mu[last - 1] * mu[last]); };
    const std::vector<double> limits{between(result.bands[0].last), between(result.bands[1].last)};
    const auto boosted = [&](const std::string& id, const std::string& label, std::vector<double> gains) {
        result.meshes.push_back(equalised(study, id, label, gains_of({limits, std::move(gains)}, mu), 1));
    };
    boosted("low_up", "low × 1.5", {1.5, 1, 1});
    boosted("middle_up", "middle × 2", {1, 2, 1});
    boosted("high_up", "high × 3", {1, 1, 3});
    boosted("middle_off", "middle removed", {1, 0, 1});
    const int kept = result.bands[1].last;
    result.meshes.push_back(equalised(study, "low_pass", "low-pass, k = " + std::to_string(kept), low_pass_gains(mu, kept), 0));
    return result;
}

MistakeStudy mistake_study(const SpectralStudy& study, bool quick) {
    const int most = std::min(study.modes(), study.spectrum.dense ? 150 : quick ? 30 : 60);
    std::vector<int> counts;
    for (const int k : {5, 10, 15, 30, 60, 150}) counts.push_back(std::min(k, most));
    const LaplaceBeltrami other = laplace_operator(study.mesh(), OperatorKind::edge_normalised);
    const Spectrum edge_normalised = modes_if_any(other, most);
    MistakeStudy result;
    for (const int k : each_once(counts)) result.errors.push_back(mistakes_at(study, edge_normalised, other, k));

    const int k = result.pictured = std::min(15, most);
    const Positions& X = study.mesh().X;
    const Vector& M = study.laplacian.M;
    const auto picture = [&](const std::string& id, const std::string& label, Positions rebuilt) {
        result.meshes.push_back(moved_mesh(study, id, label, std::move(rebuilt)));
    };
    picture("right", "Φ ΦᵀMX", reconstruct(study.spectrum, M, X, k));
    picture("unmapped", "Ψ ΨᵀX", reconstruct_unmapped(study.spectrum, M, X, k));
    picture("unweighted", "Φ ΦᵀX", reconstruct_unweighted(study.spectrum, M, X, k));
    if (edge_normalised.eigenvalues.size() >= k) picture("edge", "edge-normalised", reconstruct(edge_normalised, other.M, X, k));
    return result;
}

ModeCost mode_cost(int k, double n, double factor_entries) {
    return {k, 4 * factor_entries * k, 2 * n * k * k, 12 * n * k, 8 * n * k / 1048576};
}

/// How full a factor is depends on the pattern alone: that of −C with entries for which no needle can spoil the factorisation.
double factor_entries(const SpectralStudy& study) {
    SparseMatrix A = operator_with_mass(study.laplacian).A;
    A.makeCompressed();
    for (int j = 0; j < A.cols(); ++j) {
        const auto entries = static_cast<double>(A.outerIndexPtr()[j + 1] - A.outerIndexPtr()[j]);
        for (SparseMatrix::InnerIterator entry(A, j); entry; ++entry) entry.valueRef() = entry.row() == j ? entries : -1;
    }
    return static_cast<double>(SparseFactor::cholesky(A).nonzeros());
}

SpectralUses spectral_uses(const SpectralStudy& study, const QuestionSettings& settings) {
    return {band_study(study), low_pass_study(study, settings.quick), mistake_study(study, settings.quick), limb_study(study),
            factor_entries(study)};
}

}   // namespace meshfolio
