/// @file
/// The distribution of a mesh's coordinates over the spectrum of −L, without its modes: Gauss quadrature by Lanczos (Golub and Meurant
/// 1994). It predicts the effect of any filter of the spectrum on the coordinates.
#pragma once

#include <cmath>

#include "geometry/operators/cotangent_laplacian.h"

namespace meshfolio {

/// Nodes and weights with Σ w f(μ) = Σ_i |⟨X, φ_i⟩_M|² f(μ_i), summed over the three coordinates: exact for polynomials of a degree below
/// twice the number of steps, and for all f where the Krylov space is exhausted. The mean, which no filter moves, is left out.
struct SpectralMeasure {
    Vector nodes;                        // in [0, μ_max] [1/length²]
    Vector weights;                      // ≥ 0 [length² · mass]
    double mass = 0;                     // Σ M
    bool exact = false;                  // for all f: no coordinate has more modes in it than steps were made
    Vector fewer_nodes, fewer_weights;   // after four fifths of the steps

    /// Returns Σ w f(μ).
    template <class Function> double integral(Function f) const { return sum(f, nodes, weights); }
    /// Returns the relative change of integral(f) in the last fifth of the steps, for smooth f more than its error; 0 if `exact`.
    template <class Function> double uncertainty(Function f) const {
        return exact ? 0 : std::abs(sum(f, fewer_nodes, fewer_weights) / integral(f) - 1);
    }
    /// Returns √(Σ_i f(μ_i)² |⟨X, φ_i⟩_M|² / ΣM): the area-weighted rms length of f(−L)(X − its mean). [length]
    template <class Filter> double rms(Filter f) const {
        return std::sqrt(integral([&](double mu) { return f(mu) * f(mu); }) / mass);
    }
    /// Returns the Dirichlet energy −½ xᵀCx of f(−L)X over the three coordinates. [length²]
    template <class Filter> double energy(Filter f) const {
        return 0.5 * integral([&](double mu) { return mu * f(mu) * f(mu); });
    }

private:
    template <class Function> static double sum(Function f, const Vector& at, const Vector& with) {
        double sum = 0;
        for (Eigen::Index i = 0; i < at.size(); ++i) sum += with[i] * f(at[i]);
        return sum;
    }
};

/// Computes the measure of positions X.
/// @param steps  of Lanczos for each coordinate, fully orthogonalised; cut to the number of vertices with mass
/// @throws MeshError if X has another number of rows than the operator, or steps < 1
SpectralMeasure spectral_measure(const LaplaceBeltrami& laplacian, const Positions& X, int steps = 100);

}   // namespace meshfolio
