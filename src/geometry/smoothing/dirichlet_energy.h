/// @file
/// The Dirichlet energy of positions, E(X) = ½ Σ_{i<j} C_ij |x_i − x_j|², along a smoothing run, and how far rounding alone can raise it.
#pragma once

#include <vector>

#include "geometry/smoothing/laplacian_smoothing.h"

namespace meshfolio {

/// [length²] with cotangent weights: the area where X are the positions that C was made from.
double dirichlet_energy(const SparseMatrix& C, const Positions& X);
/// How far rounding, of the weights and of the sum, may have moved it: much where needles make large terms of both signs. [length²]
double energy_rounding(const SparseMatrix& C, const Positions& X);

/// Neither an explicit step with λ ≤ λ_crit nor an implicit one can raise the energy of a semidefinite operator. What is computed is
/// X' + d, with d from rounding, so that E rises by at most 2√(E D) + D, where D = E(d):
///   explicit:  D ≤ ½ Σ R_i |d_i|²,  R_i = Σ_j |C_ij|   (Gershgorin)
///   implicit:  D ≤ ½ min(1/λ, max R_i/M_i) Σ |r_i|²/M_i,  r = MX − (M − λC)X'   (M − λC ⪰ M and ⪰ −λC)
/// d and r are measured at every step. They count only up to a thousand roundings of what they are made of: a step that is wrong by more
/// is no rounding, and does not widen the bound.
class EnergyWatch {
public:
    /// @param laplacian  kept by reference
    EnergyWatch(const LaplaceBeltrami& laplacian, SmoothingScheme scheme, double lambda, const Positions& start);
    /// To be shown the positions after every step.
    void look(const Positions& X);

    /// After t = 0, 1, … steps [length²].
    const std::vector<double>& energy() const { return energy_; }
    /// By how much the step to t may have raised the energy through rounding; 0 for t = 0. [length²]
    const std::vector<double>& rounding() const { return rounding_; }

private:
    /// Of the energy measured at X: its value, and the rounding of its evaluation.
    void enter(const Positions& X);
    /// D, at most.
    double energy_of_rounding(const Positions& X) const;

    const LaplaceBeltrami& laplacian_;
    SmoothingScheme scheme_;
    double lambda_;
    double stiffness_;   // min(1/λ, max R_i/M_i)
    Positions before_;
    double evaluation_ = 0;   // rounding of the last energy
    std::vector<double> energy_, rounding_;
};

}   // namespace meshfolio
