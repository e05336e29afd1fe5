#include "geometry/stability_certificate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "errors.h"
#include "geometry/sparse_factor.h"
#include "number_text.h"

namespace meshfolio {

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();   // twice the unit roundoff: room for terms of second order

/// Cholesky of σM − A, or nothing where it breaks down.
std::optional<SparseFactor> factor_at(const OperatorWithMass& whole, double sigma) {
    SparseMatrix mass(whole.size(), whole.size());
    mass = (sigma * whole.M).asDiagonal();
    try {
        return SparseFactor::cholesky(mass - whole.A);
    } catch (const SolverError&) {
        return {};
    }
}

struct Quotient {
    double value = 0;
    double proved = 0;   // the value less its rounding
};

/// yᵀAy/yᵀMy. Sums of n products with sums of k are off by at most ε(n + k + 4)/2 of the sum of magnitudes, in whatever order.
Quotient rayleigh_quotient(const OperatorWithMass& whole, const Vector& y) {
    const Vector size = y.cwiseAbs();
    const double value = y.dot(whole.A * y) / y.dot(whole.M.cwiseProduct(y));
    const double magnitude = size.dot(whole.A.cwiseAbs() * size) / y.dot(whole.M.cwiseProduct(y));
    Eigen::Index longest = 0;
    for (int j = 0; j < whole.size(); ++j)
        longest = std::max<Eigen::Index>(longest, whole.A.outerIndexPtr()[j + 1] - whole.A.outerIndexPtr()[j]);
    const double terms = static_cast<double>(y.size() + longest + 4);
    return {value, value - epsilon * terms * (magnitude + std::abs(value))};
}

/// Closes in on μ_max from both sides.
class Bracket {
public:
    Bracket(const OperatorWithMass& whole, const Vector& start) : whole_(whole), high_(gershgorin_bound(whole.A, whole.M)) {
        if (!(high_ > 0)) throw MeshError("stability certificate: no two vertices are joined");
        Eigen::Index stiffest = 0;
        whole.A.diagonal().cwiseQuotient(whole.M).maxCoeff(&stiffest);
        take(Vector::Unit(whole.size(),
                          stiffest));   // the best single vertex: never below half the bound of Gershgorin when weights are ≥ 0
        if (start.allFinite() && start.squaredNorm() > 0) take(start.normalized());
    }

    /// Just above the quotient first. Where that breaks down the quotient missed μ_max: the interval is halved, and every factor above
    /// μ_max turns y towards the top mode.
    void close(double width) {
        constexpr int most_factorisations = 200;
        bool at_quotient = true;
        while (high_ - low_ > width * low_) {
            const double above = quotient_ * (1 + 0.5 * width);
            at_quotient = at_quotient && below_ < above && above < high_;
            const double sigma = at_quotient ? above : std::sqrt(below_ * high_);
            if (factorisations_ == most_factorisations || !(below_ < sigma && sigma < high_)) too_wide(width);
            const bool holds = try_at(sigma);
            if (holds && at_quotient && high_ - low_ > width * low_) too_wide(width);   // all that is left between them is rounding
            at_quotient = holds && turn();
        }
    }

    double low() const { return low_; }
    double high() const { return high_; }
    double quotient() const { return quotient_; }
    const Vector& y() const { return y_; }
    int factorisations() const { return factorisations_; }
    int failed() const { return failed_; }
    long long factor_nonzeros() const { return nonzeros_; }
    double rounding() const { return epsilon * (static_cast<double>(nonzeros_) + 8.0 * whole_.size()); }

private:
    bool try_at(double sigma) {
        ++factorisations_;
        factor_ = factor_at(whole_, sigma);
        if (!factor_) {
            ++failed_;
            below_ = sigma;
            return false;
        }
        nonzeros_ = std::max(nonzeros_, factor_->nonzeros());
        high_ = std::min(high_, sigma * (1 + rounding()));
        return true;
    }

    /// y ← (σM − A)⁻¹My from y and a little of every mode. @return whether the quotient grew
    bool turn() {
        const double before = quotient_;
        Vector y = y_ + 0.1 * irregular_direction(whole_.size());
        for (int i = 0; i < 8; ++i) y = factor_->solve(Vector(whole_.M.cwiseProduct(y))).normalized();
        take(y);
        return quotient_ > before;
    }

    void take(const Vector& y) {
        const Quotient quotient = rayleigh_quotient(whole_, y);
        if (!(quotient.value > quotient_)) return;
        quotient_ = quotient.value;
        low_ = std::max(low_, quotient.proved);
        below_ = std::max(below_, low_);
        y_ = y;
    }

    [[noreturn]] void too_wide(double width) const {
        throw SolverError("stability certificate: the bounds of μ_max stay " + plain_text((high_ - low_) / low_, 3) +
                              " apart (relative), where " + plain_text(width, 3) + " was asked for",
                          "ask for a wider bracket");
    }

    const OperatorWithMass& whole_;
    std::optional<SparseFactor> factor_;   // at the last σ where Cholesky ran to its end
    Vector y_;
    double low_ = 0, quotient_ = 0;   // proved ≤ μ_max; what low_ is without its rounding
    double below_ = 0;                // the search goes on above: low_, or where Cholesky broke down
    double high_ = 0;                 // proved ≥ μ_max
    long long nonzeros_ = 0;
    int factorisations_ = 0, failed_ = 0;
};

}   // namespace

StabilityCertificate stability_certificate(const LaplaceBeltrami& laplacian, const LargestEigenvalue& guess, double width) {
    OperatorWithMass whole = operator_with_mass(laplacian);
    if (guess.mode.size() != whole.all_vertices) {
        throw MeshError("stability certificate: a mode of " + std::to_string(guess.mode.size()) + " values for " +
                        std::to_string(whole.all_vertices) + " vertices");
    }
    const double unit = std::exp2(std::round(std::log2(whole.M.mean())));   // a power of two: scaling by it is exact
    whole.M /= unit;
    Bracket bracket(whole, guess.mode(whole.vertex));
    bracket.close(width);

    StabilityCertificate certificate;
    certificate.mu_low = bracket.low() / unit;
    certificate.mu_high = bracket.high() / unit;
    certificate.rounding = bracket.rounding();
    certificate.factorisations = bracket.factorisations();
    certificate.failed = bracket.failed();
    certificate.factor_nonzeros = bracket.factor_nonzeros();
    whole.M *= unit;
    const bool held = !certificate.refuted() && certificate.mu_low <= guess.value && guess.value <= certificate.mu_high;
    certificate.top = held ? guess : top_mode(whole, bracket.quotient() / unit, bracket.y());
    return certificate;
}

StabilityCertificate stability_certificate(const LaplaceBeltrami& laplacian, double width) {
    return stability_certificate(laplacian, largest_eigenvalue(laplacian), width);
}

bool is_positive_definite_at(const LaplaceBeltrami& laplacian, double sigma) {
    return factor_at(operator_with_mass(laplacian), sigma).has_value();
}

}   // namespace meshfolio
