#include "geometry/spectrum/top_lanczos.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/errors.h"
#include "geometry/linear/dense_eigenpairs.h"
#include "geometry/linear/special_values.h"

namespace meshfolio {
namespace {

/// Lanczos' symmetric tridiagonal matrix T.
struct Tridiagonal {
    std::vector<double> diagonal, beside;   // m and m − 1 entries

    std::size_t size() const { return diagonal.size(); }

    /// True if all eigenvalues are below x (Sturm).
    bool below(double x) const {
        double pivot = diagonal[0] - x;
        for (std::size_t i = 1; pivot < 0 && i < size(); ++i) pivot = diagonal[i] - x - beside[i - 1] * beside[i - 1] / pivot;
        return pivot < 0;
    }
    double largest_eigenvalue() const;
    std::vector<double> top_eigenvector(double theta) const;
    /// Returns |last entry| of top_eigenvector(theta) at length 1.
    double last_of_top_eigenvector(double theta) const {
        const std::vector<double> s = top_eigenvector(theta);
        return std::abs(s.back()) / std::sqrt(std::inner_product(s.begin(), s.end(), s.begin(), 0.0));
    }
};

/// Returns the largest eigenvalue, by bisection to the last bit from Gershgorin's circles.
double Tridiagonal::largest_eigenvalue() const {
    double low = *std::max_element(diagonal.begin(), diagonal.end()), high = low;
    for (std::size_t i = 0; i < size(); ++i) {
        const double circle = (i > 0 ? beside[i - 1] : 0) + (i + 1 < size() ? beside[i] : 0);
        high = std::max(high, diagonal[i] + circle);
    }
    while (true) {
        const double middle = low + 0.5 * (high - low);
        if (!(low < middle && middle < high)) return low;
        (below(middle) ? high : low) = middle;
    }
}

/// Returns the eigenvector of the largest eigenvalue θ, largest entry ±1, by inverse iteration just above θ, where T − σI is negative
/// definite and elimination needs no pivoting.
std::vector<double> Tridiagonal::top_eigenvector(double theta) const {
    const double sigma = theta + 4 * epsilon * std::max(std::abs(theta), std::abs(diagonal[0]));
    std::vector<double> s(size(), 1), pivot(size());
    for (int repeat = 0; repeat < 3; ++repeat) {
        pivot[0] = diagonal[0] - sigma;
        for (std::size_t i = 1; i < size(); ++i) {
            const double factor = beside[i - 1] / pivot[i - 1];
            pivot[i] = diagonal[i] - sigma - factor * beside[i - 1];
            s[i] -= factor * s[i - 1];
        }
        s.back() /= pivot.back();
        for (std::size_t i = size() - 1; i-- > 0;) s[i] = (s[i] - beside[i] * s[i + 1]) / pivot[i];
        double largest = 0;
        for (const double x : s) largest = std::max(largest, std::abs(x));
        for (double& x : s) x /= largest;
    }
    return s;
}

/// The three-term recurrence for v₁, v₂, …
class Recurrence {
public:
    Recurrence(const SparseMatrix& B, const Vector& start) : B_(B), v_(start.normalized()), before_(Vector::Zero(start.size())) {}

    const Vector& v() const { return v_; }
    /// Computes u = Bv − βv₋₁. @return vᵀu, the next diagonal entry of T
    double multiply() {
        u_.noalias() = B_.selfadjointView<Eigen::Lower>() * v_;
        u_ -= beta_ * before_;
        return u_.dot(v_);
    }
    /// Computes u − αv. @return its length, the next entry beside the diagonal
    double subtract(double alpha) {
        u_ -= alpha * v_;
        return u_.norm();
    }
    void advance(double beta) {
        beta_ = beta;
        before_.swap(v_);
        v_ = u_ / beta;
    }

private:
    const SparseMatrix& B_;
    Vector v_, before_, u_;
    double beta_ = 0;
};

/// Returns the Ritz vector Σ sⱼvⱼ from the vectors kept or, if they were too many to keep, from a second pass of the recurrence.
Vector ritz_vector(const SparseMatrix& B, const Vector& start, const Tridiagonal& T, const std::vector<Vector>& kept, double theta) {
    const std::vector<double> s = T.top_eigenvector(theta);
    Recurrence recurrence(B, start);
    Vector y = s[0] * recurrence.v();
    for (std::size_t j = 1; j < T.size(); ++j) {
        if (kept.size() < T.size()) {
            recurrence.multiply();
            recurrence.subtract(T.diagonal[j - 1]);
            recurrence.advance(T.beside[j - 1]);
        }
        y += s[j] * (kept.size() < T.size() ? recurrence.v() : kept[j]);
    }
    return y.normalized();
}

/// Runs Lanczos on B from `start`, which must not be 0.
TopEstimate top_by_lanczos(const SparseMatrix& B, const Vector& start, const TopSearch& search) {
    constexpr Eigen::Index most_kept = Eigen::Index{1} << 23;   // numbers, 64 MiB
    std::vector<std::pair<int, double>> seen;                   // steps and value
    std::vector<Vector> kept;
    Tridiagonal T;
    Recurrence recurrence(B, start);
    TopEstimate top;
    double largest = 0;   // entry of T
    int next_look = 24;
    for (int steps = 1;; ++steps) {
        if ((std::ssize(kept) + 1) * start.size() <= most_kept) kept.push_back(recurrence.v());
        T.diagonal.push_back(recurrence.multiply());
        const double beta = recurrence.subtract(T.diagonal.back());
        largest = std::max({largest, std::abs(T.diagonal.back()), beta});
        const bool filled = !(beta > 1e-14 * largest);   // nothing is left outside the space
        if (steps == next_look || steps == search.most_steps || filled) {
            top.mu = T.largest_eigenvalue();
            double before = -infinity;
            for (const auto& [earlier, value] : seen) before = 3 * earlier <= 2 * steps ? value : before;
            top.change = filled ? 0 : std::max(0.0, (top.mu - before) / std::abs(top.mu));
            seen.emplace_back(steps, top.mu);
            next_look = steps + 8 + steps / 10;
            top.residual = filled ? 0 : beta * T.last_of_top_eigenvector(top.mu) / std::abs(top.mu);
            if ((top.change <= search.change && top.residual <= search.residual) || steps == search.most_steps) break;
        }
        T.beside.push_back(beta);
        recurrence.advance(beta);
    }
    top.phi = ritz_vector(B, start, T, kept, top.mu);
    return top;
}

}   // namespace

TopEstimate top_estimate(const OperatorWithMass& whole, const TopSearch& search, const Vector& start) {
    constexpr int dense_up_to = 200;
    const double total = whole.M.sum();
    const Vector M = whole.M / total;   // in units where the area is 1
    const SparseMatrix B = symmetric_form(whole.A, M);
    Vector y = irregular_direction(whole.size());
    if (start.size() == whole.all_vertices) {
        const Vector warm = start(whole.vertex).cwiseProduct(M.cwiseSqrt());
        // From an eigenvector alone Lanczos could not leave it.
        if (warm.allFinite() && warm.squaredNorm() > 0) y = warm.normalized() + 0.1 * y;
    }
    TopEstimate top;
    if (whole.size() <= dense_up_to) {
        const DenseEigenpairs pairs = dense_eigenpairs(B);
        top = {pairs.values.tail(1)[0], pairs.vectors.rightCols(1), 0, 0};
    } else {
        top = top_by_lanczos(B, y, search);
    }
    if (!std::isfinite(top.mu))
        throw SolverError("largest eigenvalue: the operator has weights that are not finite", "repair triangles of zero area");
    top.mu /= total;
    top.phi = top.phi.cwiseQuotient(M.cwiseSqrt()).eval();
    return top;
}

Vector irregular_direction(int n) {
    Vector y(n);
    for (int i = 0; i < n; ++i) y[i] = static_cast<double>((i * 2654435761LL + 12345) % 1000003) / 1000003 - 0.5;
    return y.normalized();
}

}   // namespace meshfolio
