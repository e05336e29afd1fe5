#include "geometry/smoothing/dirichlet_energy.h"

#include "base/parallel.h"
#include "geometry/linear/special_values.h"

namespace meshfolio {
namespace {

struct Energy {
    double value = 0;
    double magnitude = 0;   // sum of the absolute values of its terms
};

/// Computes E = ½ Σ_{i<j} C_ij |x_i − x_j|², which is −½ Σ_c x_cᵀ C x_c because rows of C sum to 0. In the longest mantissa there is:
/// needles make large terms of both signs.
Energy evaluated_energy(const SparseMatrix& C, const Positions& X) {
    long double energy = 0, magnitude = 0;
    for (Eigen::Index j = 0; j < C.outerSize(); ++j)
        for (SparseMatrix::InnerIterator C_ij(C, j); C_ij && C_ij.row() < j; ++C_ij) {
            const auto edge = X.row(C_ij.row()).cast<long double>() - X.row(j).cast<long double>();
            const long double term = 0.5L * C_ij.value() * edge.squaredNorm();
            energy += term;
            magnitude += std::abs(term);
        }
    return {static_cast<double>(energy), static_cast<double>(magnitude)};
}

}   // namespace

double dirichlet_energy(const SparseMatrix& C, const Positions& X) { return evaluated_energy(C, X).value; }

// A cotangent is known to a few roundings of its size.
double energy_rounding(const SparseMatrix& C, const Positions& X) { return 16 * epsilon * evaluated_energy(C, X).magnitude; }

EnergyWatch::EnergyWatch(const LaplaceBeltrami& laplacian, SmoothingScheme scheme, double lambda, const Positions& start)
    : laplacian_(laplacian), scheme_(scheme), lambda_(lambda), before_(start) {
    double largest_row = 0;   // max R_i/M_i among the vertices with mass
    const Vector M = summed_at_first(laplacian.copies, laplacian.M);
    for (int i = 0; i < laplacian.C.outerSize(); ++i)
        if (M[i] > 0) largest_row = std::max(largest_row, laplacian.C.col(i).cwiseAbs().sum() / M[i]);
    stiffness_ = std::min(1 / lambda, largest_row);
    enter(start);
    rounding_.push_back(0);
}

void EnergyWatch::look(const Positions& X) {
    const double evaluation_before = evaluation_, energy_before = energy_.back();
    enter(X);
    const double D = energy_of_rounding(X);
    const double of_a_point = epsilon * epsilon * energy_.front();   // a collapsed mesh: positions are known to ε of its former size
    rounding_.push_back(evaluation_before + evaluation_ + 2 * std::sqrt(std::max(energy_before, 0.0) * D) + D + of_a_point);
    before_ = X;
}

void EnergyWatch::enter(const Positions& X) {
    const Energy energy = evaluated_energy(laplacian_.C, X);
    energy_.push_back(energy.value);
    // A term has five roundings, and one for each that is added before it.
    const double roundings = static_cast<double>(5 + laplacian_.C.nonZeros() / 2) * std::numeric_limits<long double>::epsilon();
    evaluation_ = roundings * energy.magnitude + epsilon * energy.value;
}

double EnergyWatch::energy_of_rounding(const Positions& X) const {
    constexpr double most_roundings = 1000;
    const bool implicit = scheme_ == SmoothingScheme::implicit_euler;
    const Positions& taken_at = implicit ? X : before_;   // of the Laplacian
    const auto energy_at = [&](int i) {
        const double mass = laplacian_.M[i];
        if (!(mass > 0)) return 0.0;
        Eigen::RowVector3d pull = Eigen::RowVector3d::Zero();   // (CX)_i
        double size = 0, row = 0;
        int entries = 0;
        for (SparseMatrix::InnerIterator entry(laplacian_.C, i); entry; ++entry, ++entries) {   // C is symmetric: column i is row i
            row += std::abs(entry.value());
            if (entry.row() == i) continue;
            const Eigen::RowVector3d edge = taken_at.row(entry.row()) - taken_at.row(i);
            pull += entry.value() * edge;
            size += std::abs(entry.value()) * edge.cwiseAbs().maxCoeff();
        }
        const Eigen::RowVector3d defect = mass * (X.row(i) - before_.row(i)) - lambda_ * pull;   // M d, or −r
        const double made_of = mass * X.row(i).cwiseAbs().maxCoeff() + lambda_ * size;
        const double largest = std::min(defect.cwiseAbs().maxCoeff(), most_roundings * epsilon * made_of);
        const double r = largest + (entries + 4) * epsilon * (lambda_ * size + mass * (X.row(i) - before_.row(i)).cwiseAbs().maxCoeff());
        return implicit ? 1.5 * stiffness_ * r * r / mass : 1.5 * row * (r / mass) * (r / mass);   // three coordinates
    };
    return ordered_sum(static_cast<int>(X.rows()), energy_at);
}

}   // namespace meshfolio
