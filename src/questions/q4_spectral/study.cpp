#include "questions/q4_spectral/parts.h"

namespace meshfolio::q4_spectral {

Subject subject_of(SharedMesh mesh, const QuestionSettings& settings) {
    Subject subject{spectral_study(std::move(mesh), settings), {}, {}, settings.k.empty()};
    const SpectralStudy& study = subject.study;
    subject.limbs = limb_study(study);
    for (const Reconstruction& r : study.reconstructions) subject.hausdorff.push_back(hausdorff_distance(study.mesh(), r.mesh));
    return subject;
}

std::vector<const Reconstruction*> told_reconstructions(const SpectralStudy& study) {
    const std::vector<Reconstruction>& all = study.reconstructions;
    std::vector<const Reconstruction*> told;   // of all modes there is nothing to be seen
    for (std::size_t i = 0; i < all.size(); ++i)
        if (i < 2 || &all[i] == last_erring(study) || i + 1 == all.size()) told.push_back(&all[i]);
    return told;
}

std::vector<int> drawn_modes(const SpectralStudy& study) {
    std::vector<int> drawn;
    for (const int mode : {zero_modes(study) + 1, 5, 15, 60})
        if (mode <= study.modes() && (drawn.empty() || mode > drawn.back())) drawn.push_back(mode);
    return drawn;
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

double distance_from_weyl(const SpectralStudy& study) {
    int last = study.modes();
    while (last > 0 && wavelength(study, last) < 4 * study.preflight().mean_edge) --last;
    if (last < 20) return undefined;
    double farthest = 0;
    for (int k = last / 2; k <= last; ++k)
        farthest = std::max(farthest, std::abs(study.spectrum.eigenvalues[k - 1] / weyl_eigenvalue(study, k) - 1));
    return farthest;
}

}   // namespace meshfolio::q4_spectral
