#include "geometry/spectrum/top_lanczos.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace meshfolio {

namespace {

/// Lanczos' symmetric tridiagonal matrix T.
struct Tridiagonal {
    std::vector<double> diagonal, beside;   // m and m − 1 entries

    std::size_t size() const { return diagonal.size(); }

    /// Sturm: are all eigenvalues below x?
    bool below(double x) const {
        double pivot = diagonal[0] - x;
        for (std::size_t i = 1; pivot < 0 && i < size(); ++i) pivot = diagonal[i] - x - beside[i - 1] * beside[i - 1] / pivot;
        return pivot < 0;
    }
    double largest_eigenvalue() const;
    std::vector<double> top_eigenvector(double theta) const;
    /// Its last entry, where it has the length 1.
    double last_of_top_eigenvector(double theta) const {
        const std::vector<double> s = top_eigenvector(theta);
        return std::abs(s.back()) / std::sqrt(std::inner_product(s.begin(), s.end(), s.begin(), 0.0));
    }
};

/// By bisection to the last bit, from the circles of Gershgorin.
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

/// Inverse iteration just above θ, where T − σI is negative definite and elimination needs no pivoting.
std::vector<double> Tridiagonal::top_eigenvector(double theta) const {
    const double sigma = theta + 4 * std::numeric_limits<double>::epsilon() * std::max(std::abs(theta), std::abs(diagonal[0]));
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

/// v₁, v₂, … of the three-term recurrence.
class Recurrence {
public:
    Recurrence(const SparseMatrix& B, const Vector& start) : B_(B), v_(start.normalized()), before_(Vector::Zero(start.size())) {}

    const Vector& v() const { return v_; }
    /// u = Bv − βv₋₁. @return vᵀu, the next entry of the diagonal of T
    double multiply() {
        u_.noalias() = B_.selfadjointView<Eigen::Lower>() * v_;
        u_ -= beta_ * before_;
        return u_.dot(v_);
    }
    /// @return ‖u − αv‖, the next entry beside the diagonal
    double take_off(double alpha) {
        u_ -= alpha * v_;
        return u_.norm();
    }
    void go_on(double beta) {
        beta_ = beta;
        before_.swap(v_);
        v_ = u_ / beta;
    }

private:
    const SparseMatrix& B_;
    Vector v_, before_, u_;
    double beta_ = 0;
};

/// The Ritz vector Σ sⱼvⱼ from the vectors kept or, where they are too many to keep, by going through the recurrence once more.
Vector ritz_vector(const SparseMatrix& B, const Vector& start, const Tridiagonal& T, const std::vector<double>& s,
                   const std::vector<Vector>& kept) {
    if (kept.size() == T.size()) {
        Vector y = s[0] * kept[0];
        for (std::size_t j = 1; j < T.size(); ++j) y += s[j] * kept[j];
        return y.normalized();
    }
    Recurrence recurrence(B, start);
    Vector y = s[0] * recurrence.v();
    for (std::size_t j = 1; j < T.size(); ++j) {
        recurrence.multiply();
        recurrence.take_off(T.diagonal[j - 1]);
        recurrence.go_on(T.beside[j - 1]);
        y += s[j] * recurrence.v();
    }
    return y.normalized();
}

}   // namespace

TopPair top_by_lanczos(const SparseMatrix& B, const Vector& start, const TopLanczos& options) {
    struct Seen {
        int steps;
        double value;
    };
    std::vector<Seen> seen;
    Tridiagonal T;
    Recurrence recurrence(B, start);
    TopPair top;
    double largest = 0;   // entry of T
    int look = 24;
    constexpr std::size_t most_kept = std::size_t(1) << 23;   // numbers, 64 MiB
    std::vector<Vector> kept;
    for (int steps = 1;; ++steps) {
        if ((kept.size() + 1) * static_cast<std::size_t>(start.size()) <= most_kept) kept.push_back(recurrence.v());
        T.diagonal.push_back(recurrence.multiply());
        const double beta = recurrence.take_off(T.diagonal.back());
        largest = std::max({largest, std::abs(T.diagonal.back()), beta});
        const bool filled = !(beta > 1e-14 * largest);   // nothing is left outside the space
        if (steps == look || steps == options.most_steps || filled) {
            top.value = T.largest_eigenvalue();
            double before = -std::numeric_limits<double>::infinity();
            for (const Seen& s : seen) before = 3 * s.steps <= 2 * steps ? s.value : before;
            top.change = filled ? 0 : std::max(0.0, (top.value - before) / std::abs(top.value));
            seen.push_back({steps, top.value});
            look = steps + 8 + steps / 10;
            top.residual = filled ? 0 : beta * T.last_of_top_eigenvector(top.value) / std::abs(top.value);
            if ((top.change <= options.tolerance && top.residual <= options.residual) || steps == options.most_steps) break;
        }
        T.beside.push_back(beta);
        recurrence.go_on(beta);
    }
    top.y = ritz_vector(B, start, T, T.top_eigenvector(top.value), kept);
    return top;
}

}   // namespace meshfolio
