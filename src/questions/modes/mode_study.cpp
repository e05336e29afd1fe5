#include "questions/modes/mode_study.h"

#include <chrono>

#include "geometry/measures/mesh_error.h"
#include "geometry/smoothing/diffusion_step.h"
#include "geometry/smoothing/dirichlet_energy.h"
#include "geometry/spectrum/laplace_spectrum.h"

namespace meshfolio::modes {

namespace {

constexpr int run_at_most = 2000;   // explicit steps of a way that is tried

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

/// Computes the area-weighted rms distance over the box diagonal.
double distance(const SmoothingSubject& subject, const Positions& A, const Positions& B) {
    const Vector& M = subject.laplacian.M;
    return std::sqrt(M.dot((A - B).rowwise().squaredNorm()) / M.sum()) / subject.diagonal;
}

Smoothed smoothed(const SmoothingSubject& subject, SmoothingScheme scheme, double lambda, int steps, ImplicitSolver& solver) {
    return smooth(subject.mesh(), {.scheme = scheme, .lambda = lambda, .iterations = steps}, solver);
}

SchemeGap gap_of(const ModeStudy& study, double lambda, int steps, ImplicitSolver& solver) {
    const SmoothingSubject& subject = study.subject;
    SchemeGap gap{lambda, steps};
    const Positions X = smoothed(subject, SmoothingScheme::implicit_euler, lambda, steps, solver).X;
    gap.motion = distance(subject, X, subject.mesh().X);
    const Smoothed other = smoothed(subject, SmoothingScheme::explicit_euler, lambda, steps, solver);
    gap.measured = other.blew_up ? undefined : distance(subject, X, other.X);
    const auto explicit_minus_implicit = [&](double mu) {
        return damping_law(SmoothingScheme::explicit_euler, lambda, steps, mu) -
               damping_law(SmoothingScheme::implicit_euler, lambda, steps, mu);
    };
    gap.predicted = study.model.measure.rms(explicit_minus_implicit) / subject.diagonal;
    return gap;
}

/// Computes the Dirichlet energy about the first vertex, because coordinates far from 0 would cost digits.
double energy_of(const SmoothingSubject& subject, const Positions& X) {
    return dirichlet_energy(subject.laplacian.C, X.rowwise() - X.row(0));
}

TriedWay tried(const ModeStudy& study, std::size_t target, const SmoothingWay& way, double initial_energy) {
    const SmoothingSubject& subject = study.subject;
    TriedWay run{target, way};
    ImplicitSolver solver;
    const auto start = std::chrono::steady_clock::now();
    const Positions X = smoothed(subject, way.scheme, way.lambda, way.steps, solver).X;
    run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const double energy = energy_of(subject, X);
    run.energy = energy / initial_energy;

    const Vector &nodes = study.model.measure.nodes, &weights = study.model.measure.weights;
    const double spread = nodes.maxCoeff() / (weights.array() > 1e-20 * weights.sum()).select(nodes, infinity).minCoeff();
    const Vector stiffness = subject.laplacian.C.diagonal().cwiseAbs();
    const double of_sums = 8 * X.cwiseAbs().maxCoeff() * stiffness.dot((X.rowwise() - X.row(0)).rowwise().norm()) / energy;
    run.rounding = epsilon * (of_sums + spread);
    return run;
}

/// Fills the targets, the curve, the crossings and the tried ways.
void study_costs(ModeStudy& study, bool quick) {
    const CostModel& model = study.model;
    const double least = model.least_energy(0.005), most = std::max(0.95, least);
    for (const double energy : quick ? std::vector{0.5, 0.1} : std::vector{0.9, 0.7, 0.5, 0.3, 0.2, 0.1, 0.05, 0.02})
        if (energy >= least) study.targets.push_back(smoothing_target(model, energy));
    if (study.targets.empty()) study.targets.push_back(smoothing_target(model, least));
    const int points = quick ? 6 : 20;
    for (int i = 0; i <= points; ++i) study.curve.push_back(smoothing_target(model, most * std::pow(least / most, double(i) / points)));
    for (std::size_t which = 0; which < implicit_way_count; ++which) study.crossings.push_back(crossing_of(model, study.curve, which));
    const double initial_energy = energy_of(study.subject, study.subject.mesh().X);
    for (std::size_t i = 0; i < study.targets.size(); ++i) {
        const SmoothingTarget& target = study.targets[i];
        if (target.explicit_way.steps > 0 && target.explicit_way.steps <= run_at_most)
            study.tried.push_back(tried(study, i, target.explicit_way, initial_energy));
        for (std::size_t which = 0; which < std::size(implicit_steps); ++which)
            study.tried.push_back(tried(study, i, target.implicit_ways[which], initial_energy));
    }
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

int lanczos_steps(const QuestionSettings& settings) { return settings.laboratory ? 160 : settings.quick ? 60 : 100; }

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
    study.rounding = epsilon * study.subject.mesh().X.cwiseAbs().maxCoeff() / study.subject.diagonal;
    constexpr int steps = 10;
    for (const double relative : {0.5, 0.95, 1.05})
        study.dampings.push_back(damping_of(study.subject, modes, SmoothingScheme::explicit_euler, relative, steps));
    for (const double relative : {0.5, 0.95, 10.0})
        study.dampings.push_back(damping_of(study.subject, modes, SmoothingScheme::implicit_euler, relative, steps));

    study.model = {study.subject, spectral_measure(study.subject.laplacian, study.subject.mesh().X, lanczos_steps(settings))};
    const std::vector<int> counts = settings.iterations.empty() ? std::vector{1, 10, 100} : each_once(settings.iterations);
    ImplicitSolver solver;
    for (const double lambda : steps_of(settings, study.subject.critical, {0.1, 0.5, 0.9})) {
        for (const int count : counts)
            if (count > 0) study.gaps.push_back(gap_of(study, lambda, count, solver));
    }
    study_costs(study, settings.quick);
    return study;
}

std::shared_ptr<const ModeStudies> mode_studies(const LibraryMeshes& meshes, const QuestionSettings& settings, const Progress& progress,
                                                report::Section& section) {
    return std::make_shared<ModeStudies>(studies_of(meshes, "modes", settings, progress, section, mode_study));
}

}   // namespace meshfolio::modes
