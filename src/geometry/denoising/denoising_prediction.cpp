#include "geometry/denoising/denoising_prediction.h"

#include "base/errors.h"
#include "base/number_text.h"
#include "geometry/smoothing/implicit_solver.h"
#include "mesh/vertex_noise.h"

namespace meshfolio {
namespace {

void check_prediction(const LaplaceBeltrami& laplacian, const Positions& X, const PredictionOptions& options) {
    if (!(std::isfinite(options.lambda) && options.lambda > 0))
        throw MeshError("denoising_prediction: lambda = " + plain_text(options.lambda), "it must be positive and finite");
    if (options.iterations < 0)
        throw MeshError("denoising_prediction: " + std::to_string(options.iterations) + " iterations", "give 0 or more");
    if (options.probe_triples < 1)
        throw MeshError("denoising_prediction: " + std::to_string(options.probe_triples) + " triples of probes", "give at least one");
    if (X.rows() != laplacian.M.size()) {
        throw MeshError("denoising_prediction: " + std::to_string(X.rows()) + " positions for an operator on " +
                            std::to_string(laplacian.M.size()) + " vertices",
                        "give one position a vertex");
    }
}

/// Returns positions about their centroid: every step keeps constants, so they only cost digits.
Positions centred(const Positions& X, const Vector& M) {
    const Eigen::RowVector3d centroid = (M.transpose() * X) / M.sum();
    return X.rowwise() - centroid;
}

ExpectedError empty_error(int iterations, double weight_sum) {
    const Vector zeros = Vector::Zero(iterations + 1);
    return {zeros, zeros, zeros, weight_sum};
}

DenoisingPrediction by_modes(const LaplaceBeltrami& laplacian, const Positions& X, const Spectrum& spectrum,
                             const PredictionOptions& options) {
    const auto modes = static_cast<int>(spectrum.eigenvalues.size());
    const DenseMatrix& Phi = spectrum.eigenvectors;
    const Vector& M = laplacian.M;
    const DenseMatrix c = Phi.transpose() * (M.asDiagonal() * centred(X, M));
    const DenseMatrix MPhi = M.asDiagonal() * Phi;
    const DenseMatrix B = MPhi.transpose() * MPhi;
    const Vector B_diagonal = B.diagonal();
    const DenseMatrix GB = (Phi.transpose() * Phi).cwiseProduct(B);
    const auto unmoved = static_cast<double>((M.array() == 0).count());   // vertices without mass
    const Vector h = (1 + options.lambda * spectrum.eigenvalues.array()).inverse();

    DenoisingPrediction prediction{empty_error(options.iterations, M.sum()), empty_error(options.iterations, static_cast<double>(X.rows())),
                                   modes, 0};
    Vector power = Vector::Ones(modes);   // hᵗ
    for (int t = 0; t <= options.iterations; ++t) {
        const DenseMatrix lost = (1 - power.array()).matrix().asDiagonal() * c;
        prediction.mass.bias[t] = lost.squaredNorm();
        prediction.mass.noise[t] = 3 * power.cwiseAbs2().dot(B_diagonal);
        prediction.vertices.bias[t] = (Phi * lost).squaredNorm();
        prediction.vertices.noise[t] = 3 * (power.dot(GB * power) + unmoved);
        power = power.cwiseProduct(h);
    }
    return prediction;
}

/// Estimates the traces from probes z, which run three at a time, as coordinates.
DenoisingPrediction by_probes(const LaplaceBeltrami& laplacian, const OperatorWithMass& whole, const Positions& X,
                              const PredictionOptions& options) {
    const Vector& M = laplacian.M;
    const Vector ones = Vector::Ones(X.rows());
    const int probes = 3 * options.probe_triples;
    DenoisingPrediction prediction{empty_error(options.iterations, M.sum()), empty_error(options.iterations, ones.sum()), 0, probes};
    ImplicitSolver solver;
    solver.prepare(whole, options.lambda);
    const Positions start = centred(X, M);
    Positions run = start;
    for (int t = 0; t <= options.iterations; ++t) {
        if (t > 0) run = solver.step(run);
        const Vector squares = (run - start).rowwise().squaredNorm();
        prediction.mass.bias[t] = M.dot(squares);
        prediction.vertices.bias[t] = squares.sum();
    }
    const auto add = [&run](ExpectedError& error, int t, const Vector& W) {   // zᵀSᵗᵀWSᵗz and its square
        for (int c = 0; c < 3; ++c) {
            const double value = W.dot(run.col(c).cwiseAbs2());
            error.noise[t] += value;
            error.noise_error[t] += value * value;
        }
    };
    for (int triple = 0; triple < options.probe_triples; ++triple) {
        run = random_signs(X.rows(), options.seed + static_cast<std::uint64_t>(triple));
        for (int t = 0; t <= options.iterations; ++t) {
            if (t > 0) run = solver.step(run);
            add(prediction.mass, t, M);
            add(prediction.vertices, t, ones);
        }
    }
    for (ExpectedError* error : {&prediction.mass, &prediction.vertices}) {   // 3 tr and its standard error
        const Vector variance = (error->noise_error - error->noise.cwiseAbs2() / probes) / (probes - 1);
        error->noise = 3 * error->noise / probes;
        error->noise_error = 3 * (variance.cwiseMax(0) / probes).cwiseSqrt();
    }
    return prediction;
}

}   // namespace

int ExpectedError::best(double sigma) const {
    Eigen::Index first = 0;
    squared(sigma).minCoeff(&first);
    return static_cast<int>(first);
}

DenoisingPrediction denoising_prediction(const LaplaceBeltrami& laplacian, const Positions& X, const PredictionOptions& options) {
    check_prediction(laplacian, X, options);
    const OperatorWithMass whole = operator_with_mass(laplacian);
    if (const int n = whole.size(); n <= options.modes_up_to)
        return by_modes(laplacian, X, smallest_eigenpairs(laplacian, n, {.dense_below = n}), options);
    return by_probes(laplacian, whole, X, options);
}

DenoisingPrediction denoising_prediction(const LaplaceBeltrami& laplacian, const Positions& X, const PredictionOptions& options,
                                         const Spectrum& all) {
    check_prediction(laplacian, X, options);
    return by_modes(laplacian, X, all, options);
}

Positions random_signs(Eigen::Index rows, std::uint64_t seed) {
    NormalNumbers numbers(seed);
    Positions signs(rows, 3);
    for (Eigen::Index i = 0; i < signs.size(); ++i) signs.data()[i] = numbers.uniform() < 0.5 ? -1 : 1;
    return signs;
}

}   // namespace meshfolio
