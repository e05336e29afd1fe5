#include "geometry/spectrum/spectral_measure.h"

#include <algorithm>
#include <array>
#include <string>

#include "base/errors.h"
#include "base/parallel.h"
#include "base/parallel_tasks.h"
#include "geometry/linear/dense_eigenpairs.h"
#include "geometry/operators/vertices_with_mass.h"

namespace meshfolio {
namespace {

struct Quadrature {
    Vector nodes, weights, fewer_nodes, fewer_weights;
    bool exact = true;
};

/// Computes nodes, eigenvalues of the leading n × n block of a tridiagonal matrix, and weights, squared first entries of its vectors.
void nodes_and_weights(const Vector& diagonal, const Vector& beside, int n, double total, Vector& nodes, Vector& weights) {
    const double unit = diagonal.maxCoeff();   // the solver takes numbers far below 1 for zeros
    const DenseEigenpairs pairs = tridiagonal_eigenpairs(diagonal.head(n) / unit, beside.head(n - 1) / unit);
    nodes = unit * pairs.values.cwiseMax(0);
    weights = total * pairs.vectors.row(0).transpose().cwiseAbs2();
}

/// T = VᵀBV of Lanczos for B and y: tridiagonal, the columns of V orthonormal.
struct LanczosCoefficients {
    Vector diagonal, beside;
    bool exact = false;   // the subspace is invariant: y has no other mode in it
};

LanczosCoefficients lanczos(const SparseMatrix& B, const Vector& y, int steps) {
    DenseMatrix V(y.size(), steps);
    LanczosCoefficients T{Vector(steps), Vector(steps)};
    V.col(0) = y.normalized();
    double largest = 0;   // entry of T
    int done = 0;
    while (done < steps && !T.exact) {
        Vector w = B * V.col(done);
        T.diagonal[done] = V.col(done).dot(w);
        const auto found = V.leftCols(done + 1);
        for (int pass = 0; pass < 2; ++pass) w -= found * (found.transpose() * w);
        T.beside[done] = w.norm();
        largest = std::max({largest, std::abs(T.diagonal[done]), T.beside[done]});
        T.exact = !(T.beside[done] > 1e-13 * largest);
        ++done;
        if (!T.exact && done < steps) V.col(done) = w / T.beside[done - 1];
    }
    T.diagonal.conservativeResize(done);
    return T;
}

/// Computes the Gauss quadrature for the measure of y.
Quadrature gauss_quadrature(const SparseMatrix& B, const Vector& y, int steps) {
    const double square = y.squaredNorm();
    if (!(square > 0)) return {};
    const LanczosCoefficients T = lanczos(B, y, steps);
    const auto size = static_cast<int>(T.diagonal.size());
    Quadrature quadrature;
    quadrature.exact = T.exact;
    nodes_and_weights(T.diagonal, T.beside, size, square, quadrature.nodes, quadrature.weights);
    nodes_and_weights(T.diagonal, T.beside, std::max(4 * size / 5, 1), square, quadrature.fewer_nodes, quadrature.fewer_weights);
    return quadrature;
}

}   // namespace

SpectralMeasure spectral_measure(const LaplaceBeltrami& laplacian, const Positions& X, int steps) {
    if (X.rows() != laplacian.M.size() || steps < 1) {
        throw MeshError("spectral measure: " + std::to_string(X.rows()) + " positions and " + std::to_string(steps) +
                            " steps for an operator on " + std::to_string(laplacian.M.size()) + " vertices",
                        "give one position a vertex and at least one step");
    }
    const OperatorWithMass whole = operator_with_mass(laplacian);
    const SparseMatrix B = symmetric_form(whole.A, whole.M);
    const Vector root = whole.M.cwiseSqrt();
    SpectralMeasure measure;
    measure.mass = whole.M.sum();
    // Coordinates far from the origin would lose their digits to the mean.
    const Positions near = X(whole.vertex, Eigen::all).rowwise() - X.row(whole.vertex.front());
    const Positions centred = near.rowwise() - (near.transpose() * whole.M / measure.mass).transpose();
    std::array<Quadrature, 3> coordinates;
    for_each_task(coordinates.size(), [&](std::size_t c) {
        coordinates[c] = gauss_quadrature(B, root.cwiseProduct(centred.col(static_cast<Eigen::Index>(c))),
                                          std::min(steps, static_cast<int>(root.size())));
    });
    measure.exact = true;
    const auto append = [](Vector& all, const Vector& more) {
        all.conservativeResize(all.size() + more.size());
        all.tail(more.size()) = more;
    };
    for (const Quadrature& quadrature : coordinates) {
        append(measure.nodes, quadrature.nodes);
        append(measure.weights, quadrature.weights);
        append(measure.fewer_nodes, quadrature.fewer_nodes);
        append(measure.fewer_weights, quadrature.fewer_weights);
        measure.exact = measure.exact && quadrature.exact;
    }
    return measure;
}

}   // namespace meshfolio
