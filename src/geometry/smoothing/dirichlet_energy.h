/// @file
/// The Dirichlet energy of positions, E(X) = ½ Σ_{i<j} C_ij |x_i − x_j|², over a smoothing run, and how far rounding alone can raise it.
#pragma once

#include <vector>

#include "geometry/smoothing/laplacian_smoothing.h"

namespace meshfolio {

/// Returns E(X); with cotangent weights made from X it is the surface area. [length²]
double dirichlet_energy(const SparseMatrix& C, const Positions& X);
/// Returns 16 ε Σ_{i<j} ½|C_ij||x_i − x_j|², how far rounding of the weights and of the sum may have moved E(X): much where needles make
/// large terms of both signs. [length²]
double energy_rounding(const SparseMatrix& C, const Positions& X);

/// Records the energy of a run and bounds its rounding. Neither an explicit step with λ ≤ λ_crit nor an implicit one can raise the energy
/// of a semidefinite operator. The computed step is X' + d with d from rounding, so that E rises by at most 2√(E D) + D, where D = E(d):
///   explicit:  D ≤ ½ Σ R_i |d_i|²,  R_i = Σ_j |C_ij|   (Gershgorin)
///   implicit:  D ≤ ½ min(1/λ, max R_i/M_i) Σ |r_i|²/M_i,  r = MX − (M − λC)X'   (M − λC ⪰ M and ⪰ −λC)
/// d and r are measured at every step. They count up to a thousand roundings of their terms: a step that is wrong by more is no rounding,
/// and does not widen the bound.
class EnergyWatch {
public:
    /// @param laplacian  kept by reference
    EnergyWatch(const LaplaceBeltrami& laplacian, SmoothingScheme scheme, double lambda, const Positions& start);
    /// Stores the energy at the positions X after the next step, and the rounding of that step.
    void look(const Positions& X);

    /// Returns the energy after t = 0, 1, … steps. [length²]
    const std::vector<double>& energy() const { return energy_; }
    /// Returns by how much rounding may have raised the energy in the step to t; 0 for t = 0. [length²]
    const std::vector<double>& rounding() const { return rounding_; }

private:
    /// Appends the energy at X, and sets the rounding of its evaluation.
    void enter(const Positions& X);
    /// Returns the bound of D, the energy of the rounding in the step from the positions before to X.
    double energy_of_rounding(const Positions& X) const;

    const LaplaceBeltrami& laplacian_;
    SmoothingScheme scheme_;
    double lambda_;
    double stiffness_ = 0;   // min(1/λ, max R_i/M_i)
    Positions before_;
    double evaluation_ = 0;   // rounding of the last evaluated energy
    std::vector<double> energy_, rounding_;
};

}   // namespace meshfolio
