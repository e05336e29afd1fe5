#include "geometry/stability.h"

#include <Spectra/MatOp/SparseSymMatProd.h>
#include <Spectra/SymEigsSolver.h>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "errors.h"
#include "number_text.h"

namespace meshfolio {

namespace {

constexpr int dense_up_to = 200;

struct TopPair {
    double mu = 0;
    Vector y;   // unit
};

TopPair dense_top(const SparseMatrix& B) {
    const Eigen::SelfAdjointEigenSolver<DenseMatrix> solver{DenseMatrix(B)};
    if (solver.info() != Eigen::Success) throw SolverError("largest eigenvalue: the dense eigensolver did not converge");
    return {solver.eigenvalues().tail(1)[0], solver.eigenvectors().rightCols(1)};
}

/// Grids have top eigenvalues that crowd together; a larger basis separates them. An empty start leaves the choice to Lanczos.
TopPair lanczos_top(const SparseMatrix& B, double tolerance, const Vector& start) {
    constexpr int most_restarts = 1000;
    for (const int basis : {30, 60, 120}) {
        Spectra::SparseSymMatProd<double> product(B);
        Spectra::SymEigsSolver<Spectra::SparseSymMatProd<double>> lanczos(product, 1, basis);
        try {
            start.size() > 0 ? lanczos.init(start.data()) : lanczos.init();
            lanczos.compute(Spectra::SortRule::LargestAlge, most_restarts, tolerance);
        } catch (const std::runtime_error&) {
            continue;   // the small eigenproblem inside did not converge
        }
        if (lanczos.info() == Spectra::CompInfo::Successful) return {lanczos.eigenvalues()[0], lanczos.eigenvectors(1)};
    }
    throw SolverError("largest eigenvalue: Lanczos did not converge on " + std::to_string(B.rows()) + " vertices");
}

}   // namespace

double gershgorin_bound(const SparseMatrix& A, const Vector& M) {
    Vector row_sum = Vector::Zero(A.rows());
    Eigen::VectorXi entries = Eigen::VectorXi::Zero(A.rows());
    for (int j = 0; j < A.cols(); ++j) {
        for (SparseMatrix::InnerIterator entry(A, j); entry; ++entry) {
            row_sum[entry.row()] += std::abs(entry.value());
            ++entries[entry.row()];
        }
    }
    const double rounding = (entries.maxCoeff() + 2) * std::numeric_limits<double>::epsilon();   // of a sum and a quotient
    return row_sum.cwiseQuotient(M).maxCoeff() * (1 + rounding);
}

Vector irregular_direction(int n) {
    Vector y(n);
    for (int i = 0; i < n; ++i) y[i] = static_cast<double>((i * 2654435761LL + 12345) % 1000003) / 1000003 - 0.5;
    return y.normalized();
}

LargestEigenvalue top_mode(const OperatorWithMass& whole, double mu, Vector phi) {
    const Vector share = whole.M.cwiseProduct(phi.cwiseAbs2());   // Mφ², up to a factor
    phi /= std::sqrt(share.sum());
    LargestEigenvalue top;
    top.value = mu;
    top.upper_bound = gershgorin_bound(whole.A, whole.M);
    const Eigen::Index largest = first_largest(phi);
    if (phi[largest] < 0) phi = -phi;
    top.vertex = whole.vertex[static_cast<std::size_t>(largest)];
    top.mode = to_all_vertices(whole, phi);
    top.support = share.sum() * share.sum() / share.squaredNorm();
    return top;
}

LargestEigenvalue largest_eigenvalue(const LaplaceBeltrami& laplacian) { return largest_eigenvalue_from(operator_with_mass(laplacian)); }

LargestEigenvalue largest_eigenvalue_from(const OperatorWithMass& whole, double tolerance, const Vector& start) {
    const double total = whole.M.sum();
    const Vector M = whole.M / total;   // in units where the area is 1, whatever the model's
    const SparseMatrix B = symmetric_form(whole.A, M);
    Vector y;
    if (start.size() == whole.all_vertices) y = start(whole.vertex).cwiseProduct(M.cwiseSqrt());
    const bool usable = y.allFinite() && y.squaredNorm() > 0;
    // Started from an eigenvector alone, Lanczos would have nowhere to go.
    y = usable ? Vector(y.normalized() + 0.1 * irregular_direction(whole.size())) : Vector();
    const TopPair pair = whole.size() <= dense_up_to ? dense_top(B) : lanczos_top(B, tolerance, y);
    LargestEigenvalue top = top_mode(whole, pair.mu / total, pair.y.cwiseQuotient(M.cwiseSqrt()));
    if (top.value <= top.upper_bound * (1 + 1e-9)) return top;
    throw SolverError("largest eigenvalue: Lanczos gave " + plain_text(top.value) + ", beyond the bound of Gershgorin, " +
                      plain_text(top.upper_bound));
}

double largest_stable_step(const LargestEigenvalue& top) { return top.value > 0 ? 2 / top.value : std::numeric_limits<double>::infinity(); }

StepUnit step_unit_named(const std::string& name) {
    if (name == "raw") return StepUnit::raw;
    if (name == "tau") return StepUnit::tau;
    if (name == "h2") return StepUnit::h2;
    throw UsageError("unknown unit of lambda '" + printable(name) + "'", "use raw, tau or h2");
}

double step_in_model_units(double lambda, StepUnit unit, double critical, double mean_edge) {
    switch (unit) {
        case StepUnit::tau:
            return lambda * critical;
        case StepUnit::h2:
            return lambda * mean_edge * mean_edge;
        case StepUnit::raw:
            break;
    }
    return lambda;
}

StepInUnits step_in_units(double raw, double critical, double mean_edge) { return {raw, raw / critical, raw / (mean_edge * mean_edge)}; }

double smoothing_strength(double diffusion_time, double diagonal) { return std::sqrt(4 * diffusion_time) / diagonal; }

}   // namespace meshfolio
