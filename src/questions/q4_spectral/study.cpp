#include "questions/q4_spectral/parts.h"

namespace meshfolio::q4_spectral {

Subject subject_of(SharedMesh mesh, const QuestionSettings& settings) {
    SpectralStudy study = spectral_study(std::move(mesh), settings);
    LimbStudy limbs = limb_study(study);
    const double entries = factor_entries(study);
    return {std::move(study), std::move(limbs), entries, settings.k.empty()};
}

std::vector<const Reconstruction*> told_reconstructions(const SpectralStudy& study) {
    const std::vector<Reconstruction>& all = study.reconstructions;
    std::vector<const Reconstruction*> told;   // of all modes there is nothing to be seen
    for (std::size_t i = 0; i < all.size(); ++i)
        if (i < 2 || &all[i] == last_erring(study) || i + 1 == all.size()) told.push_back(&all[i]);
    return told;
}

std::vector<int> drawn_modes(const SpectralStudy& study) {
    const int zeros = zero_modes(study);
    std::vector<int> drawn;
    for (int mode = zeros + 1; mode <= std::min(study.modes(), zeros + 4); ++mode) drawn.push_back(mode);
    for (const int mode : {10, 15})
        if (mode > zeros + 4 && mode <= study.modes()) drawn.push_back(mode);
    return drawn;
}

double remoteness_of_peak(const SpectralStudy& study, int mode) {
    const Positions& X = study.mesh().X;
    const Vector& M = study.laplacian.M;
    const Vector3 centroid = X.transpose() * M / M.sum();
    const Vector distance = (X.rowwise() - centroid.transpose()).rowwise().norm();
    Eigen::Index peak = 0;
    study.spectrum.eigenvectors.col(mode - 1).cwiseAbs().maxCoeff(&peak);
    return 100 * static_cast<double>((distance.array() < distance[peak] * (1 - 1e-9)).count()) / static_cast<double>(distance.size());
}

double share_seen(const SpectralStudy& study, const Reconstruction& r) {
    const Vector& M = study.laplacian.M;
    return (r.distance.array() > seen_error * study.diagonal).select(M, 0).sum() / M.sum();
}

const Reconstruction* last_erring(const SpectralStudy& study) {
    const Reconstruction* last = nullptr;
    for (const Reconstruction& r : study.reconstructions)
        if (!is_exact(study, r.k)) last = &r;
    return last;
}

bool is_exact(const SpectralStudy& study, int k) { return study.rms[k] < rounding * study.diagonal; }

}   // namespace meshfolio::q4_spectral
