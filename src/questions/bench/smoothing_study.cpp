#include "questions/bench/smoothing_study.h"

#include "geometry/curvature/curvature.h"
#include "geometry/denoising/component_size.h"
#include "geometry/linear/sparse_factor.h"
#include "geometry/operators/vertices_with_mass.h"
#include "geometry/smoothing/dirichlet_energy.h"
#include "geometry/smoothing/implicit_solver.h"
#include "geometry/spectrum/laplace_spectrum.h"
#include "output/draw/surface_of.h"

namespace meshfolio {

namespace {

/// Returns the diagonal of the box of X over that of the input's box.
double boxes_wide(const SmoothingSubject& subject, const Positions& X) {
    return bounding_box(moved_to(subject.mesh(), X)).diagonal() / subject.diagonal;
}

/// Measures the size left of each component: its volume, or its mean squared distance from the centroid if it has a boundary. A bounding
/// box would follow the boundary alone, which shrinks long before the sheet.
class SizeWatch {
public:
    explicit SizeWatch(const SmoothingSubject& subject)
        : subject_(subject),
          component_(component_of_vertices(subject.topology())),
          volume_(component_sizes(subject.mesh(), subject.topology()).volume),
          all_closed_((volume_.array().abs() > 0).all()),
          spread_(spreads(subject.mesh().X)) {}

    struct Left {
        double size;     // of the component that lost most, over that of the input; NaN if a position is not finite
        double volume;   // of all components [length³]
    };
    Left left(const Positions& X) const {
        const Vector volume = component_volumes(subject_.mesh().F, X, subject_.topology()), spread = all_closed_ ? spread_ : spreads(X);
        double least = infinity;
        for (Eigen::Index c = 0; c < volume_.size(); ++c)
            if (const bool closed = std::abs(volume_[c]) > 0; closed || spread_[c] > 0)
                least = std::min(least, closed ? volume[c] / volume_[c] : spread[c] / spread_[c]);
        return {X.allFinite() ? least : std::nan(""), volume.sum()};
    }

private:
    const SmoothingSubject& subject_;
    std::vector<int> component_;   // of each vertex; −1: in no triangle
    Vector volume_;                // of the input's components [length³]
    bool all_closed_;
    Vector spread_;   // of the input's components

    /// Computes Σ M_v |x_v − c|² / Σ M_v of each component, M of the input, in squared diagonals of the input's box, so that no mesh
    /// overflows.
    Vector spreads(const Positions& X) const {
        const Vector& M = subject_.laplacian.M;
        Vector weight = Vector::Zero(volume_.size()), sum = weight;
        Positions centroid = Positions::Zero(volume_.size(), 3);
        const auto over_vertices = [&](auto visit) {
            for (Eigen::Index v = 0; v < X.rows(); ++v)
                if (const int c = component_[v]; c >= 0 && M[v] > 0) visit(c, M[v], X.row(v));
        };
        over_vertices([&](int c, double m, const auto& x) {
            weight[c] += m;
            centroid.row(c) += m / weight[c] * (x - centroid.row(c));
        });
        over_vertices(
            [&](int c, double m, const auto& x) { sum[c] += m / weight[c] * ((x - centroid.row(c)) / subject_.diagonal).squaredNorm(); });
        return sum;
    }
};

}   // namespace

SmoothingSubject smoothing_subject(SharedMesh source, OperatorKind kind, AreaForm area) {
    SmoothingSubject subject;
    subject.source = std::move(source);
    subject.kind = kind;
    subject.area = area;
    subject.laplacian = laplace_operator(subject.mesh(), kind, area);
    subject.top = largest_eigenvalue(subject.laplacian);
    subject.bottom = definiteness(subject.laplacian, assembly_of(kind));
    subject.critical = largest_stable_step(subject.top);
    if (kind == OperatorKind::cotan && subject.preflight().zero_area_faces > 0)
        subject.critical_floored = largest_stable_step(largest_eigenvalue(floored_laplace_beltrami(subject.mesh(), area)));
    subject.mean_edge = mean_edge_length(subject.mesh());
    subject.diagonal = bounding_box(subject.mesh()).diagonal();
    subject.initial_energy = dirichlet_energy(subject.laplacian.C, subject.mesh().X);
    return subject;
}

const Spectrum& all_modes(const OnMesh& subject) {
    return subject.source->derived->value("all modes", [&] {
        const int all = subject.preflight().vertices_in_use;
        return smallest_eigenpairs(laplace_beltrami(subject.mesh()), all, {.dense_below = all_modes_at_most});
    });
}

FactorOperations implicit_operations_of(const SmoothingSubject& subject) {
    return EliminationOrder(operator_with_mass(subject.laplacian).A).operations;
}

std::vector<double> steps_of(const QuestionSettings& settings, double critical, const std::vector<double>& multiples) {
    std::vector<double> steps = settings.lambda;
    if (steps.empty())
        for (const double multiple : multiples) steps.push_back(multiple * critical);
    return each_once(steps);
}

Smoothed smooth_until_collapse(const TriangleMesh& mesh, SmoothingOptions options, ImplicitSolver& solver) {
    Smoothed reached;
    reached.X = mesh.X;
    options.after_step = [&reached, lambda = options.lambda, look = std::move(options.after_step)](int iteration, const Positions& X) {
        reached.X = X;
        reached.iterations = iteration;
        reached.time = iteration * lambda;
        return !look || look(iteration, X);
    };
    try {
        return smooth(mesh, options, solver);
    } catch (const SolverError&) {   // triangles are so thin that rounding makes −C indefinite
        if (!options.rebuild || reached.iterations == 0) throw;
    }
    reached.collapse_iteration = reached.iterations + 1;
    return reached;
}

SmoothingRun run_smoothing(const SmoothingSubject& subject, SmoothingScheme scheme, double lambda, int iterations,
                           const std::vector<int>& keep) {
    ImplicitSolver solver;
    return run_smoothing(subject, scheme, lambda, iterations, keep, solver);
}

SmoothingRun run_smoothing(const SmoothingSubject& subject, SmoothingScheme scheme, double lambda, int iterations,
                           const std::vector<int>& keep, ImplicitSolver& solver, bool rebuild) {
    SmoothingRun run;
    run.scheme = scheme;
    run.lambda = lambda;
    run.iterations = iterations;
    run.in_view = subject.mesh().X;
    const bool closed = subject.preflight().encloses_volume();
    const SizeWatch sizes(subject);
    const render::Bounds bounds = output::bounds_of(subject.mesh());
    const double first_volume = sizes.left(subject.mesh().X).volume;
    if (closed) run.volume = {1};
    run.size = {1};

    SmoothingOptions options{
        .scheme = scheme, .laplacian = subject.kind, .lambda = lambda, .iterations = iterations, .rebuild = rebuild, .area = subject.area};
    EnergyWatch watch(subject.laplacian, scheme, lambda, subject.mesh().X);
    options.after_step = [&](int iteration, const Positions& X) {
        watch.look(X);
        const SizeWatch::Left left = sizes.left(X);
        if (closed) run.volume.push_back(left.volume / first_volume);
        run.size.push_back(left.size);
        if (iteration == run.in_view_iteration + 1 && output::fits_frame(bounds, X)) {
            run.in_view = X;
            run.in_view_iteration = iteration;
        } else if (iteration == run.in_view_iteration + 1) {
            run.out_of_view = X;
        }
        if (std::ranges::find(keep, iteration) != keep.end()) run.snapshots.push_back(X);
        return true;
    };
    run.result = smooth_until_collapse(subject.mesh(), options, solver);
    for (const double energy : watch.energy()) run.energy.push_back(energy / watch.energy().front());
    for (const double rounding : watch.rounding()) run.energy_rounding.push_back(rounding / watch.energy().front());

    run.moved = compare_meshes(subject.mesh(), moved_to(subject.mesh(), run.result.X));
    return run;
}

int iterations_keeping_size(const SmoothingRun& run, double share) {
    const auto lost = std::ranges::find_if(run.size, [&](double size) { return !(size >= share); });
    return lost != run.size.end() ? static_cast<int>(lost - run.size.begin()) - 1 : -1;
}

report::Check energy_check(std::string name, const SmoothingRun& run) {
    constexpr double smallest_rise = 1e-9;   // that must not be hidden
    double rise = 0, rounding = std::ranges::max(run.energy_rounding);
    double beyond = 0;   // of the step that rose farthest beyond its rounding
    for (std::size_t t = 1; t < run.energy.size(); ++t) {
        const double step = run.energy[t] - run.energy[t - 1];
        if (step - run.energy_rounding[t] <= beyond) continue;
        rise = step;
        rounding = run.energy_rounding[t];
        beyond = step - rounding;
    }
    if (run.result.blew_up) rise = INFINITY;
    report::Check check = check_at_most(std::move(name), 0, rise, rounding);
    if (!check.passed() || rounding <= smallest_rise) return check;
    return undecided(std::move(check), smoothing_words.line("check.energy.undecided"));
}

std::vector<int> peaks_of(const Vector& mode) {
    std::vector<int> peaks;
    const double least = 0.999 * mode.cwiseAbs().maxCoeff();
    for (int i = 0; i < mode.size(); ++i)
        if (std::abs(mode[i]) >= least) peaks.push_back(i);
    return peaks;
}

Amplification top_mode_amplification(const SmoothingSubject& subject, double lambda, int steps) {
    const double height = 1e-3 * subject.mean_edge / subject.top.mode.cwiseAbs().maxCoeff();
    // About the box centre: far from the origin the mode would be lost in the rounding of coordinates.
    Positions X = subject.mesh().X.rowwise() - bounding_box(subject.mesh()).centre().transpose();
    X += height * subject.top.mode * Eigen::RowVector3d::Ones();
    const Vector weights = subject.laplacian.M.cwiseProduct(subject.top.mode);   // sums to 0, so the origin may be chosen near
    const auto amplitude = [&] { return ((X.rowwise() - X.row(0)).transpose() * weights).norm(); };   // |⟨X, φ⟩_M|
    const double start = amplitude();
    for (int t = 0; t < steps; ++t) X = explicit_step(subject.laplacian, lambda, X);
    return {std::pow(std::abs(1 - lambda * subject.top.value), steps), amplitude() / start};
}

double share_of_top_mode(const SmoothingSubject& subject, const Positions& X) {
    const Positions moved = (X - subject.mesh().X) / subject.diagonal;
    const Vector& M = subject.laplacian.M;
    const double all = M.dot(moved.rowwise().squaredNorm());
    return (moved.transpose() * M.cwiseProduct(subject.top.mode)).squaredNorm() / all;   // φ is M-normalised
}

Vector curvature_colours(const SmoothingSubject& subject, const Positions& X) {
    const TriangleMesh mesh = moved_to(subject.mesh(), X);
    return subject.mean_edge * cotangent_mean_curvature(mesh, subject.topology(), laplace_beltrami(mesh));
}

double largest_product(const Smoothed& run) {
    return largest_of(run.steps, [&](const StepStability& step) { return step.top; });
}

std::string share_left(double share) { return share < 1e-12 ? smoothing_words.line("left.nothing") : readable_percent(share, 2); }

std::string in_limits(const SmoothingSubject& subject, double lambda) { return plain_text(lambda / subject.critical, 3); }

bool fits_a_frame(const SmoothingSubject& subject, const Positions& X) { return boxes_wide(subject, X) <= 2; }

output::Panel framed_panel(const SmoothingSubject& subject, const Positions& X, std::string name, std::string label) {
    if (fits_a_frame(subject, X)) return panel_of(moved_to(subject.mesh(), X), std::move(name), std::move(label));
    return {std::move(name), smoothing_words.line("panel.too_large", "boxes"_a = readable(boxes_wide(subject, X), 2)), nullptr};
}

std::string step_name(double lambda) { return "lambda" + plain_text(lambda, 3); }

output::Panel smoothing_panel(const SmoothingSubject& subject, const Positions& X, std::string name, std::string label) {
    return panel_of(moved_to(subject.mesh(), X), std::move(name), std::move(label), curvature_colours(subject, X));
}

output::ColorRange curvature_range(const std::vector<output::Panel>& inputs) {
    return output::robust_range(inputs, "diverging", smoothing_words.line("figure.colours"), "", 0.02);
}

}   // namespace meshfolio
