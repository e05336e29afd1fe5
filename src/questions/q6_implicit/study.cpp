#include "questions/q6_implicit/study.h"

#include "geometry/linear/sparse_factor.h"
#include "geometry/measures/mesh_error.h"
#include "geometry/smoothing/dirichlet_energy.h"
#include "geometry/spectrum/laplace_spectrum.h"
#include "questions/bench/mesh_class.h"
#include "questions/q6_implicit/parts.h"

namespace meshfolio::q6_implicit {

namespace {

constexpr double nothing_left = 0.01;   // share of the size: results below are not compared

/// Returns a cell with the implicit result X after t steps of the l-th λ.
SmoothingCell implicit_cell(const ImplicitStudy& study, std::size_t l, int t, const Positions& X) {
    const SmoothingRun& run = study.implicit_runs[l];
    SmoothingCell cell;
    cell.lambda = study.lambdas[l];
    cell.iterations = t;
    cell.implicit_X = X;
    cell.implicit_energy = run.energy[t];
    cell.kept = *std::min_element(run.size.begin(), run.size.begin() + t + 1);
    if (!cell.collapsed()) cell.inverted_faces = compare_meshes(study.subject.mesh(), moved_to(study.subject.mesh(), X)).inverted_faces;
    return cell;
}

/// Returns the cell of lambdas[l] and iterations[t], both schemes.
SmoothingCell cell_at(const ImplicitStudy& study, std::size_t l, std::size_t t) {
    SmoothingCell cell = implicit_cell(study, l, study.iterations[t], study.implicit_runs[l].snapshots[t]);
    const SmoothingRun& explicit_run = study.explicit_runs[l];
    if (t < explicit_run.snapshots.size()) {   // else it ended before
        cell.explicit_X = explicit_run.snapshots[t];
        cell.explicit_energy = explicit_run.energy[cell.iterations];
    } else {
        cell.explicit_blow_up = explicit_run.result.blow_up_iteration;
    }
    return cell;
}

/// Compares the damping of the lowest modes with (1 + λμ)^−t, where they have not vanished, and enters the largest deviation.
void measure_damping(ImplicitStudy& study) {
    const SmoothingSubject& subject = study.subject;
    const int k = std::min(12, subject.preflight().vertices_in_use);
    const Spectrum low = smallest_eigenpairs(subject.laplacian, k, {.dense_below = 200});
    // Well above rounding, even of coordinates far from the origin.
    const double rounding = 1e7 * std::numeric_limits<double>::epsilon() * subject.mesh().X.cwiseAbs().maxCoeff();
    const double visible = std::max(1e-6 * subject.diagonal, rounding) * std::sqrt(subject.laplacian.M.sum());
    // About the barycentre, which does not move: far from the origin the offset would drown the modes in rounding.
    const Vector& M = subject.laplacian.M;
    const Eigen::RowVector3d near = subject.mesh().X.row(0);
    const Eigen::RowVector3d barycentre = near + M.transpose() * (subject.mesh().X.rowwise() - near) / M.sum();
    for (const SmoothingCell& cell : study.grid) {
        const Positions start = subject.mesh().X.rowwise() - barycentre, end = cell.implicit_X.rowwise() - barycentre;
        for (int i = 0; i < low.eigenvalues.size(); ++i) {
            const Vector weights = subject.laplacian.M.cwiseProduct(low.eigenvectors.col(i));
            const double before = (start.transpose() * weights).norm();
            const double after = (end.transpose() * weights).norm();
            if (before < visible || after < visible) continue;
            const double predicted = std::pow(1 + cell.lambda * low.eigenvalues[i], -cell.iterations);
            study.worst_damping = std::max(study.worst_damping, std::abs(after / before / predicted - 1));
            ++study.damped_modes;
        }
    }
}

/// Returns the cell of good(): takes for each λ the most steps that keep the size, then of results within 1 % of the least energy the
/// fewest steps.
std::optional<SmoothingCell> recommended_cell(const ImplicitStudy& study, ImplicitSolver& solver) {
    std::vector<int> steps;
    std::vector<double> energy;
    for (const SmoothingRun& run : study.implicit_runs) {
        const int keeping = iterations_keeping_size(run);
        steps.push_back(keeping < 0 ? run.iterations : keeping);
        energy.push_back(steps.back() > 0 ? run.energy[steps.back()] : INFINITY);
    }
    const double enough = 1.01 * std::ranges::min(energy);
    std::optional<std::size_t> best;
    for (std::size_t l = 0; l < steps.size(); ++l)
        if (steps[l] > 0 && energy[l] <= enough && (!best || steps[l] < steps[*best])) best = l;
    if (!best) return {};
    const int t = steps[*best];
    const SmoothingRun run = run_smoothing(study.subject, SmoothingScheme::implicit_euler, study.lambdas[*best], t, {}, solver);
    return implicit_cell(study, *best, t, run.result.X);
}

/// Returns the median angle between neighbouring faces at X; 0 where it is rounding [°].
double roughness_of(const SmoothingSubject& subject, const Positions& X) {
    const double angle = median_face_angle(moved_to(subject.mesh(), X), subject.topology());
    return angle < 1e-6 ? 0 : angle;
}

/// Counts the operations of both schemes.
StepPrices step_prices(const ImplicitStudy& study) {
    const Smoothed& run = study.implicit_runs.front().result;   // one pattern for all λ
    StepPrices prices{.explicit_step = 3.0 * double(study.subject.laplacian.C.nonZeros())};
    if (run.solver != LinearSolver::direct) return prices;
    prices.implicit_step = 3 * 2 * double(run.factor_nonzeros);   // forward and back, three columns
    prices.factorisation = implicit_operations_of(study.subject).factorisation;
    return prices;
}

/// Smooths the input by explicit steps of λ; after_step may end the run.
Smoothed explicit_run(const ImplicitStudy& study, double lambda, int steps,
                      const std::function<bool(int, const Positions&)>& after_step = {}) {
    SmoothingOptions options{.scheme = SmoothingScheme::explicit_euler, .lambda = lambda, .iterations = steps};
    options.after_step = after_step;
    return smooth(study.subject.mesh(), options);
}

/// Makes explicit steps of half of λ_crit down to the least energy of the grid, and enters their energies into the study.
/// @return the first positions with the energy of the recommended result; empty if that is not reached
Positions follow_explicit_steps(ImplicitStudy& study) {
    const double enough = study.good() ? study.good()->implicit_energy : 1;
    double least = enough;
    for (const SmoothingCell& cell : study.grid)
        if (cell.kept >= nothing_left) least = std::min(least, cell.implicit_energy);
    study.explicit_energy = {1};
    Positions reached;
    if (!(study.subject.critical > 0) || !(study.subject.initial_energy > 0)) return reached;
    explicit_run(study, 0.5 * study.subject.critical, most_priced_steps, [&](int, const Positions& X) {
        const double energy = dirichlet_energy(study.subject.laplacian.C, X) / study.subject.initial_energy;
        if (energy <= enough && reached.size() == 0) reached = X;
        study.explicit_energy.push_back(energy);
        return energy > least;
    });
    return reached;
}

/// Computes the cost of the recommended result. @param reached  explicit positions with its energy; empty if they were not reached
SmoothingCost cost_of(const ImplicitStudy& study, const SmoothingCell& good, const Positions& reached) {
    SmoothingCost cost;
    const auto run = std::ranges::find(study.lambdas, good.lambda);
    cost.roughness = roughness_of(study.subject, good.implicit_X);
    cost.explicit_steps = study.explicit_steps_to(good.implicit_energy);
    cost.ratio = study.price(run - study.lambdas.begin(), good.iterations);
    if (cost.reached()) cost.explicit_roughness = roughness_of(study.subject, reached);
    const double steps = std::ceil(good.time() / (0.5 * study.subject.critical) - 1e-9);
    if (!(steps <= most_priced_steps)) return cost;
    const Positions X = explicit_run(study, good.time() / steps, static_cast<int>(steps)).X;
    cost.gap = (X - good.implicit_X).rowwise().norm();
    cost.gap_share = vertex_rms(X, good.implicit_X) / vertex_rms(study.subject.mesh().X, good.implicit_X);
    return cost;
}

}   // namespace

std::optional<std::size_t> ImplicitStudy::within_limit() const {
    const auto beyond = std::ranges::upper_bound(lambdas, subject.critical);
    if (beyond == lambdas.begin()) return {};
    return beyond - lambdas.begin() - 1;
}

std::vector<SchemeGap> ImplicitStudy::gaps() const {
    std::vector<SchemeGap> found;
    const std::optional<std::size_t> l = within_limit();
    for (std::size_t t = 0; l && t < iterations.size(); ++t) {
        const SmoothingCell& at = cell(*l, t);
        const double moved = vertex_rms(subject.mesh().X, at.implicit_X);
        if (!at.has_explicit() || !(moved > 0) || at.implicit_energy < 1e-3) continue;
        found.push_back({at.iterations, vertex_rms(at.implicit_X, at.explicit_X) / moved});
    }
    return found;
}

std::optional<std::size_t> ImplicitStudy::first_blown() const {
    const auto blown = std::ranges::find(explicit_runs, true, [](const SmoothingRun& run) { return run.result.blew_up; });
    if (blown == explicit_runs.end()) return {};
    return blown - explicit_runs.begin();
}

int ImplicitStudy::explicit_steps_to(double energy) const {
    const auto reached = std::ranges::find_if(explicit_energy, [&](double found) { return found <= energy; });
    return reached != explicit_energy.end() ? static_cast<int>(reached - explicit_energy.begin()) : 0;
}

double ImplicitStudy::price(std::size_t l, int t) const {
    const int steps = explicit_steps_to(implicit_runs[l].energy[t]);
    if (steps == 0 || !prices.counted()) return NAN;
    return steps * prices.explicit_step / (t * prices.implicit_step + prices.factorisation);
}

std::optional<BreakEven> ImplicitStudy::break_even(std::size_t l) const {
    const SmoothingRun& run = implicit_runs[l];
    int from = 0;
    for (int t = static_cast<int>(run.energy.size()) - 1; t > 0; --t) {
        const double ratio = price(l, t);
        if (ratio < 1) break;
        if (ratio >= 1) from = t;
    }
    if (from == 0) return {};
    return BreakEven{lambdas[l], from, *std::min_element(run.size.begin(), run.size.begin() + from + 1)};
}

std::optional<BreakEven> ImplicitStudy::break_even() const {
    std::optional<BreakEven> best;
    for (std::size_t l = 0; l < lambdas.size(); ++l)
        if (const auto found = break_even(l); found && (!best || found->kept > best->kept)) best = found;
    return best;
}

int ImplicitStudy::too_far(std::size_t l) const {
    const std::vector<double>& size = implicit_runs[l].size;
    const auto gone = std::ranges::find_if(size, [](double left) { return left < too_little; });
    return gone != size.end() ? static_cast<int>(gone - size.begin()) : 0;
}

const SmoothingCell* ImplicitStudy::in_fewer_steps(const SmoothingCell& many) const {
    const SmoothingCell* fewest = nullptr;
    for (const SmoothingCell& few : grid)
        if (few.iterations < (fewest ? fewest : &many)->iterations && std::abs(few.time() / many.time() - 1) <= 1e-9) fewest = &few;
    return fewest;
}

std::vector<int> iterations_of(const QuestionSettings& settings) {
    if (!settings.iterations.empty()) return each_once(settings.iterations);
    return settings.quick ? std::vector{1, 10} : std::vector{1, 3, 10, 30, 100};
}

ImplicitStudy implicit_study(SharedMesh source, const QuestionSettings& settings) {
    ImplicitStudy study;
    study.subject = smoothing_subject(std::move(source));
    study.roughness = roughness_of(study.subject, study.subject.mesh().X);
    study.lambdas = steps_of(settings, study.subject.critical, own_steps);
    study.iterations = iterations_of(settings);
    const int last = study.iterations.back();
    ImplicitSolver solver;   // one symbolic analysis for all λ
    for (const double lambda : study.lambdas) {
        study.implicit_runs.push_back(
            run_smoothing(study.subject, SmoothingScheme::implicit_euler, lambda, last, study.iterations, solver));
        study.explicit_runs.push_back(run_smoothing(study.subject, SmoothingScheme::explicit_euler, lambda, last, study.iterations));
    }
    for (std::size_t l = 0; l < study.lambdas.size(); ++l)
        for (std::size_t t = 0; t < study.iterations.size(); ++t) study.grid.push_back(cell_at(study, l, t));
    for (SmoothingCell& many : study.grid) {
        const double moved = vertex_rms(study.subject.mesh().X, many.implicit_X);
        const SmoothingCell* few = study.in_fewer_steps(many);
        if (!few || many.kept < nothing_left || !(moved > 0)) continue;
        many.fewer_steps = few->iterations;
        many.apart = vertex_rms(few->implicit_X, many.implicit_X) / moved;
    }
    measure_damping(study);
    const Positions far = implicit_step(study.subject.laplacian, 1e6 * study.subject.critical, study.subject.mesh().X);
    study.huge_step_energy = dirichlet_energy(study.subject.laplacian.C, far) / study.subject.initial_energy;
    study.recommended = recommended_cell(study, solver);
    study.prices = step_prices(study);
    const Positions reached = follow_explicit_steps(study);
    if (study.recommended) study.cost = cost_of(study, *study.recommended, reached);
    return study;
}

std::shared_ptr<const Studies> implicit_studies(const LibraryMeshes& meshes, const QuestionSettings& settings, const Progress& progress,
                                                report::Section& section) {
    return std::make_shared<const Studies>(studies_of(meshes, "implicit smoothing", settings, progress, section, implicit_study));
}

}   // namespace meshfolio::q6_implicit
