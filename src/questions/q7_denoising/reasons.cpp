#include "questions/q7_denoising/study.h"

#include "geometry/operators/vertices_with_mass.h"
#include "geometry/smoothing/implicit_solver.h"
#include "geometry/spectrum/spectral_reconstruction.h"

namespace meshfolio::q7_denoising {

namespace {

/// True if the state after `step` iterations of λ continues a curve that has reached an amount.
bool continues(const DenoisingGrid& grid, double reached, double lambda, int step) {
    constexpr int first_step = 3;   // one or two steps of a large λ smooth differently from many small steps
    return lambda * step > reached && (lambda == grid.lambdas.front() || step >= first_step);
}

/// Returns the root mean square of the norms of the rows.
double rms(const DenseMatrix& rows) { return std::sqrt(rows.squaredNorm() / static_cast<double>(rows.rows())); }

/// Returns the ends of the bands of modes. Each spans an octave of μ and at least eight modes, as a symmetric shape has no part in most.
std::vector<Eigen::Index> band_ends(const Vector& mu) {
    constexpr Eigen::Index fewest = 8;
    std::vector<Eigen::Index> ends;
    Eigen::Index begin = 0;
    for (Eigen::Index i = 1; i < mu.size(); ++i)
        if (i - begin >= fewest && mu[i] > 2 * mu[begin] && mu.size() - i >= fewest) ends.push_back(begin = i);
    ends.push_back(mu.size());
    return ends;
}

/// Returns the μ where the line through the last two bands, on logarithmic scales, has as much shape as noise; the μ of a single band.
double last_crossing(const ModeBands& bands) {
    const std::size_t last = bands.mu.size() - 1;
    if (last == 0) return bands.mu[0];
    const double before = std::log(bands.shape[last - 1]), after = std::log(bands.shape[last]);
    return bands.mu[last - 1] * std::pow(bands.mu[last] / bands.mu[last - 1], before / (before - after));
}

}   // namespace

double ErrorParts::deviation_of_sum() const {
    const double last = 2 * total.amount[total.least()];
    double largest = 0;
    for (std::size_t i = 0; i < total.amount.size() && total.amount[i] <= last; ++i)
        largest = std::max(largest, std::abs(std::pow(std::hypot(noise.error[i], shape.error[i]) / total.error[i], 2) - 1));
    return largest;
}

bool approaches_clean_curve(const Reasons& reasons) {
    const auto apart = [&](const ErrorCurve& curve, std::size_t i) {   // |log| of the ratio to the clean mesh at the same amount
        const auto& amounts = reasons.parts.surface.amount;
        const auto nearest = std::ranges::lower_bound(amounts, 0.999 * curve.amount[i]) - amounts.begin();
        return std::abs(std::log(curve.error[i] / reasons.parts.surface.error[std::min(nearest, std::ssize(amounts) - 1)]));
    };
    int turning = 0;
    for (const ErrorCurve& curve : reasons.levels) {
        const std::size_t least = curve.least(), last = curve.error.size() - 1;
        if (least == 0 || least == last) continue;
        ++turning;
        if (!(apart(curve, last) < apart(curve, least))) return false;
    }
    return turning > 0;
}

ErrorCurve error_curve(const DenoisingGrid& grid, const NoisyTrial& trial) {
    ErrorCurve curve{{0}, {trial.found.noisy.shape / grid.mean_edge}};
    for (const SearchState& state : trial.states) {   // λ by λ
        if (!continues(grid, curve.amount.back(), state.value, state.step)) continue;
        curve.amount.push_back(state.value * state.step);
        curve.error.push_back(state.shape / grid.mean_edge);
    }
    return curve;
}

ErrorParts error_parts(const DenoisingGrid& grid, const TriangleMesh& noisy) {
    const TriangleMesh& clean = grid.clean->mesh();
    const OperatorWithMass whole = operator_with_mass(laplace_beltrami(clean));
    const Positions normals = vertex_normals(clean);
    const auto along_normals = [&](const Positions& D) { return rms(D.cwiseProduct(normals).rowwise().sum()) / grid.mean_edge; };
    ErrorParts parts;
    const auto add_state = [&](double amount, const Positions& Y, const Positions& X) {
        const auto add = [&](ErrorCurve& curve, double error) { curve.amount.push_back(amount), curve.error.push_back(error); };
        add(parts.total, along_normals(Y - clean.X));
        add(parts.noise, along_normals(Y - X));
        add(parts.shape, along_normals(X - clean.X));
        add(parts.surface, shape_rms(clean, X) / grid.mean_edge);
    };
    add_state(0, noisy.X, clean.X);
    ImplicitSolver solver;
    for (const double lambda : grid.lambdas) {
        solver.prepare(whole, lambda * grid.mean_edge * grid.mean_edge);
        Positions Y = noisy.X, X = clean.X;
        for (int t = 1; t <= grid.iterations; ++t) {
            Y = solver.step(Y), X = solver.step(X);
            if (!continues(grid, parts.total.amount.back(), lambda, t)) continue;
            add_state(lambda * t, Y, X);
            if (parts.total.least() + 1 == parts.total.error.size()) parts.best_lambda = lambda, parts.best_step = t;
        }
    }
    return parts;
}

ModeBands mode_bands(const DenoisingGrid& grid, const NoisyTrial& trial, const ErrorParts& parts) {
    constexpr int all_up_to = 700, fewer = 150;   // vertices, modes
    const TriangleMesh& clean = grid.clean->mesh();
    const LaplaceBeltrami laplacian = laplace_beltrami(clean);
    const int n = static_cast<int>((laplacian.M.array() > 0).count());
    const Spectrum spectrum = smallest_eigenpairs(laplacian, n <= all_up_to ? n : fewer);
    const auto constant = (spectrum.eigenvalues.array() == 0).count(), modes = spectrum.eigenvalues.size() - constant;
    const Vector mu = grid.mean_edge * grid.mean_edge * spectrum.eigenvalues.tail(modes);
    const double unit = trial.sigma * std::sqrt(3 * laplacian.M.sum() / n);   // noise of a mode
    const DenseMatrix shape = spectral_coefficients(spectrum, laplacian.M, clean.X).bottomRows(modes) / unit;
    const DenseMatrix noise = spectral_coefficients(spectrum, laplacian.M, trial.noisy.X - clean.X).bottomRows(modes) / unit;

    ModeBands bands;
    bands.modes = static_cast<int>(modes);
    bands.all = constant + modes == n;
    if (modes == 0) return bands;
    Eigen::Index begin = 0;
    for (const Eigen::Index end : band_ends(mu)) {
        bands.mu.push_back(std::exp(mu.segment(begin, end - begin).array().log().mean()));
        bands.shape.push_back(rms(shape.middleRows(begin, end - begin)));
        bands.noise.push_back(rms(noise.middleRows(begin, end - begin)));
        bands.kept.push_back(std::pow(1 + parts.best_lambda * bands.mu.back(), -parts.best_step));
        if (std::isnan(bands.crossing) && bands.shape.back() < 1) bands.crossing = last_crossing(bands);
        begin = end;
    }
    bands.above = static_cast<int>(std::isnan(bands.crossing) ? modes : (mu.array() < bands.crossing).count());
    return bands;
}

Reasons reasons_of(const Grids& grids) {
    Reasons reasons;
    for (const DenoisingGrid& grid : grids) {
        const auto size = [](const DenoisingGrid& g) { return g.clean->mesh().vertex_count(); };
        if (grid.pictured().improved() && (!reasons.grid || size(grid) < size(*reasons.grid))) reasons.grid = &grid;
    }
    if (!reasons.grid) return reasons;
    const DenoisingGrid& grid = *reasons.grid;
    reasons.parts = error_parts(grid, grid.pictured().noisy);
    for (const NoisyTrial& trial : grid.trials) reasons.levels.push_back(error_curve(grid, trial));
    try {
        reasons.bands = mode_bands(grid, grid.pictured(), reasons.parts);
    } catch (const SolverError&) {
    }
    return reasons;
}

std::shared_ptr<const Reasons> shared_reasons(const Grids& grids) { return std::make_shared<const Reasons>(reasons_of(grids)); }

}   // namespace meshfolio::q7_denoising
