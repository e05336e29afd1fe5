#include "geometry/spectrum/eigenvalue_enclosure.h"

#include <Spectra/SymEigsSolver.h>
#include <algorithm>
#include <cmath>
#include <new>

#include "base/errors.h"
#include "geometry/linear/special_values.h"
#include "geometry/spectrum/top_lanczos.h"

namespace meshfolio {
namespace {

/// The operator y ↦ M^½ (σM − S)⁻¹ M^½ y in the form of Spectra.
struct ShiftInverse {
    using Scalar = double;
    const SparseFactor& factor;
    const Vector& root_mass;

    Eigen::Index rows() const { return root_mass.size(); }
    Eigen::Index cols() const { return root_mass.size(); }
    void perform_op(const double* in, double* out) const {
        const Eigen::Map<const Vector> y(in, rows());
        Eigen::Map<Vector>(out, rows()) = root_mass.cwiseProduct(factor.solve(Vector(root_mass.cwiseProduct(y))));
    }
};

/// Returns the vector of largest Ritz value of (σM − S)⁻¹M after a few steps of Lanczos from y, with any residual.
Vector shift_invert_lanczos(const SparseFactor& factor, const Vector& M, const Vector& y) {
    constexpr Eigen::Index most_steps = 12;
    constexpr double any_residual = 1;
    if (M.size() < 2) return y;
    const Vector root_mass = M.cwiseSqrt(), start = root_mass.cwiseProduct(y);
    ShiftInverse inverse{factor, root_mass};
    Spectra::SymEigsSolver<ShiftInverse> lanczos(inverse, 1, std::min(most_steps, M.size()));
    lanczos.init(start.data());
    lanczos.compute(Spectra::SortRule::LargestAlge, 1, any_residual);
    if (lanczos.info() != Spectra::CompInfo::Successful) return y;
    return Vector(lanczos.eigenvectors(1)).cwiseQuotient(root_mass);
}

/// The search for bounds of μ from both sides.
class EnclosureSearch {
public:
    EnclosureSearch(const SparseMatrix& S, const Vector& M, const Vector& start, const EnclosureOptions& options)
        : S_(S), M_(M), least_scale_(options.least_scale) {
        result_.high = options.high;
        result_.low = -infinity;
        result_.quotient = result_.low;
        if (start.size() == M.size() && start.allFinite() && start.squaredNorm() > 0) take(start.normalized());
        Eigen::Index stiffest = 0;
        const double single = S.diagonal().cwiseQuotient(M).maxCoeff(&stiffest);   // with weights ≥ 0, half the bound of Gershgorin or more
        if (!(result_.quotient > single)) take(Vector::Unit(M.size(), stiffest));
    }

    /// Tries σ = quotient + δ·scale, following the quotient, until δ is half the gap.
    void close(double gap, double missing) {
        constexpr double far = 1e-3;
        constexpr int most_factorisations = 60, most_turns = 200;
        double last = 0.5 * gap, delta = missing <= 0.5 * last ? last : std::clamp(10 * missing, last, far);
        for (int turns = 0; turns < most_turns && result_.factorisations < most_factorisations; ++turns) {
            if (result_.high - result_.low <= gap * scale()) return;
            const bool near = factor_ && shift_ <= result_.quotient + delta * scale();   // the last factor is as good
            if (near && delta <= last) return;                                           // the rest is rounding
            if (!near) {
                if (!try_at(std::min(result_.quotient + delta * scale(), (1 + 1e-6) * result_.high))) {
                    if (delta <= last && result_.failed > 4) last *= 2;   // the rest may be rounding
                    delta = std::max(30 * delta, far * (result_.failed == 1 ? 1 : 0));
                    continue;
                }
                if (delta <= last) return;
            }
            delta = approach(last);
        }
    }

    /// Turns y towards its vector by solves with the factor just above μ: each by the gap to the next eigenvalue over the distance of σ.
    void polish() {
        constexpr int most_solves = 3;
        if (!factor_) return;
        for (int i = 0; i < most_solves; ++i) take(factor_->solve(Vector(M_.cwiseProduct(result_.y))).normalized(), 1e-12);
    }

    const Enclosure& result() const { return result_; }

private:
    double scale() const { return std::max(result_.quotient, least_scale_); }
    /// Raises the quotient with the last factor: solves are cheap beside a factorisation.
    /// @return the relative distance of the next σ from the quotient
    double approach(double last) {
        constexpr int most_rounds = 3;
        double expected = 0;
        for (int round = 0; round < most_rounds; ++round) {
            const double before = result_.quotient;
            Vector start = result_.y;   // at first with a part in every vector, in case y is not the largest
            if (round == 0) start += 0.02 * result_.y.norm() * irregular_direction(static_cast<int>(M_.size()));
            take(shift_invert_lanczos(*factor_, M_, start));
            const double step = (result_.quotient - before) / scale(), left = (shift_ - result_.quotient) / scale();
            expected = std::min(left / 100, 20 * step * step / left);
            if (expected <= last) return last;
        }
        return expected;
    }

    bool try_at(double sigma) {
        ++result_.factorisations;
        std::optional<SparseFactor> factor = factor_at(S_, M_, sigma);
        if (!factor) {
            ++result_.failed;
            return false;
        }
        factor_ = std::move(factor);
        shift_ = sigma;
        result_.factor_nonzeros = std::max(result_.factor_nonzeros, factor_->nonzeros());
        const double rounding = rounding_of(*factor_, M_, sigma);
        if (sigma + rounding > result_.high) return true;
        result_.high = sigma + rounding;
        result_.rounding = rounding;
        return true;
    }

    /// Keeps y if its quotient is larger, or smaller by a share of at most `slack`, which is rounding.
    void take(const Vector& y, double slack = 0) {
        const Quotient quotient = rayleigh_quotient(S_, M_, y);
        result_.low = std::max(result_.low, quotient.low);
        if (!(quotient.value > result_.quotient - slack * scale())) return;
        result_.quotient = quotient.value;
        result_.y = y;
    }

    const SparseMatrix& S_;
    const Vector& M_;
    double least_scale_;
    std::optional<SparseFactor> factor_;   // at shift_, the last σ where Cholesky ran to its end
    double shift_ = 0;
    Enclosure result_;
};

}   // namespace

std::optional<SparseFactor> factor_at(const SparseMatrix& S, const Vector& M, double sigma) {
    try {
        return SparseFactor::cholesky(SparseMatrix((sigma * M).asDiagonal()) - S);
    } catch (const SolverError&) {
        return {};
    }
}

double rounding_of(const SparseFactor& factor, const Vector& M, double sigma) {
    return factor.backward_error(M) + epsilon * std::abs(sigma);
}

Quotient rayleigh_quotient(const SparseMatrix& S, const Vector& M, const Vector& y) {
    const Vector size = y.cwiseAbs();
    const double mass = y.dot(M.cwiseProduct(y)), value = y.dot(S * y) / mass;
    double magnitude = 0;   // Σ |S_ij y_i y_j|
    int longest = 0;        // row
    for (Eigen::Index j = 0; j < S.cols(); ++j) {
        double column = 0;
        for (SparseMatrix::InnerIterator entry(S, j); entry; ++entry) column += std::abs(entry.value()) * size[entry.row()];
        magnitude += column * size[j];
        longest = std::max(longest, S.outerIndexPtr()[j + 1] - S.outerIndexPtr()[j]);
    }
    magnitude /= mass;
    const double rounding = epsilon * static_cast<double>(y.size() + longest + 4) * (magnitude + std::abs(value));
    return {value, value - rounding, value + rounding};
}

Enclosure enclose_largest(const SparseMatrix& S, const Vector& M, const Vector& start, const EnclosureOptions& options) {
    EnclosureSearch search(S, M, start, options);
    try {
        search.close(options.width, options.missing);
        search.polish();
    } catch (const std::bad_alloc&) {
        // A factor does not fit into memory: the bounds proved so far stand.
    }
    return search.result();
}

}   // namespace meshfolio
