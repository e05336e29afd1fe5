#include "questions/modes/mode_study.h"

#include "geometry/smoothing/diffusion_step.h"
#include "geometry/spectrum/laplace_spectrum.h"

namespace meshfolio::modes {

namespace {

/// Smooths unit coefficients of the modes and measures the factor left of each. @param relative  step over λ_crit
ModeDamping damping_of(const SmoothingSubject& subject, const Spectrum& modes, SmoothingScheme scheme, double relative, int steps) {
    ModeDamping damping{scheme, relative * subject.critical, steps, {}};
    const OperatorWithMass whole = operator_with_mass(subject.laplacian);
    Positions W(modes.eigenvalues.size(), 3);   // ±1/√3 in each coordinate, with signs that repeat nowhere
    std::uint32_t state = 2463534242u;
    for (Eigen::Index i = 0; i < W.rows(); ++i) {
        for (int c = 0; c < 3; ++c) {
            state ^= state << 13;
            state ^= state >> 17;
            state ^= state << 5;
            W(i, c) = (state & 1 ? 1 : -1) / std::sqrt(3.0);
        }
    }
    Positions X = modes.eigenvectors * W;
    if (scheme == SmoothingScheme::explicit_euler) {
        const ExplicitDiffusion diffusion(whole);
        for (int t = 0; t < steps; ++t) X = diffusion.step(damping.lambda, X);
    } else {
        ImplicitSolver solver;
        solver.prepare(whole, damping.lambda);
        for (int t = 0; t < steps; ++t) X = solver.step(X);
    }
    const Positions coefficients = modes.eigenvectors.transpose() * (subject.laplacian.M.asDiagonal() * X);
    damping.measured = coefficients.cwiseProduct(W).rowwise().sum();
    return damping;
}

}   // namespace

double damping_law(SmoothingScheme scheme, double lambda, int steps, double mu) {
    return scheme == SmoothingScheme::explicit_euler ? std::pow(1 - lambda * mu, steps) : std::pow(1 + lambda * mu, -steps);
}

double ModeDamping::deviation(const Vector& eigenvalues) const {
    double largest = 0, scale = 1;
    for (Eigen::Index i = 0; i < eigenvalues.size(); ++i) {
        largest = std::max(largest, std::abs(measured[i] - law(eigenvalues[i])));
        scale = std::max(scale, std::abs(law(eigenvalues[i])));
    }
    return largest / scale;
}

ModeStudy mode_study(SharedMesh source, const QuestionSettings& settings) {
    ModeStudy study;
    study.subject = smoothing_subject(std::move(source));
    study.all = study.subject.preflight().vertices_in_use <= all_modes_at_most;
    const int lowest = settings.quick ? 20 : 60;
    Spectrum modes =
        study.all ? all_modes(study.subject) : smallest_eigenpairs(study.subject.laplacian, lowest, {.polish = true, .dense_below = 0});
    if (!study.all) {
        modes.eigenvalues.conservativeResize(modes.eigenvalues.size() + 1);
        modes.eigenvalues.tail(1)[0] = study.subject.top.value;
        modes.eigenvectors.conservativeResize(Eigen::NoChange, modes.eigenvectors.cols() + 1);
        modes.eigenvectors.rightCols(1) = study.subject.top.mode;
    }
    study.eigenvalues = modes.eigenvalues;
    constexpr int steps = 10;
    for (const double relative : {0.5, 0.95, 1.05})
        study.dampings.push_back(damping_of(study.subject, modes, SmoothingScheme::explicit_euler, relative, steps));
    for (const double relative : {0.5, 0.95, 10.0})
        study.dampings.push_back(damping_of(study.subject, modes, SmoothingScheme::implicit_euler, relative, steps));

    return study;
}

std::shared_ptr<const ModeStudies> mode_studies(const LibraryMeshes& meshes, const QuestionSettings& settings, const Progress& progress,
                                                report::Section& section) {
    return std::make_shared<ModeStudies>(studies_of(meshes, "modes", settings, progress, section, mode_study));
}

}   // namespace meshfolio::modes
