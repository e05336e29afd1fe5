/// @file
/// Smallest eigenpairs of B = M^−½ A M^−½ by Lanczos on (B − σI)⁻¹, σ slightly below 0 (Ericsson & Ruhe 1980), with restarts by
/// Spectra. Private to the layer.
#pragma once

#include <functional>

#include "geometry/sparse_factor.h"
#include "geometry/vertices_with_mass.h"

namespace meshfolio {

/// y = M^½ φ: orthonormal columns, eigenvalues ascending.
struct SymmetricPairs {
    Vector mu;
    DenseMatrix Y;
    int count() const { return static_cast<int>(mu.size()); }
};

/// The constants of each component are the null space of A, known beforehand.
class ZeroModes {
public:
    ZeroModes(const SparseMatrix& A, const Vector& M);
    int count() const { return components_.count; }
    /// n × count: M^½ on a component, normalised.
    DenseMatrix first(int count) const;
    void project_out(Eigen::Ref<Vector> y) const;

private:
    Components components_;
    Vector y_;   // all of them added up; their supports are disjoint
};

/// ‖By − μy‖ / μ for each pair, in the norm of the equations −Cφ = μMφ: ‖M^½(By − μy)‖ / (μ‖M^½y‖).
Vector relative_residuals(const SparseMatrix& B, const Vector& root_mass, const SymmetricPairs& pairs);

class ShiftInvertLanczos {
public:
    /// @param M   n masses with Σ M = 1
    /// @throws SolverError if A is not positive semidefinite
    ShiftInvertLanczos(const SparseMatrix& A, const Vector& M, double tolerance, std::function<void(double)> progress);

    /// Looks for `wanted` more pairs, orthogonal to all known ones, and refines what is known to the tolerance. Lanczos from one
    /// start vector sees one vector of each eigenspace; what a pass leaves out is the smallest part of what the next one sees.
    void find_more(int wanted);
    /// The first `count` known pairs have the tolerance, or the rounding of the residual itself, ε‖B‖/μ.
    bool converged(int count) const;

    const SymmetricPairs& known() const { return known_; }   // without the zero modes
    const ZeroModes& zero_modes() const { return zero_modes_; }
    /// Eigenvalues below σ, zero modes included, by the inertia of A − σM.
    int count_below(double sigma) const;

private:
    DenseMatrix apply(const DenseMatrix& Y) const;   // (B − σI)⁻¹ away from the zero modes
    void refine();
    void rayleigh_ritz(DenseMatrix W);

    const SparseMatrix& A_;
    const Vector& M_;
    double tolerance_;
    std::function<void(double)> progress_;
    Vector root_;   // M^½
    SparseMatrix B_;
    ZeroModes zero_modes_;
    double sigma_ = 0;
    SparseFactor factor_;
    SymmetricPairs known_;
    int passes_ = 0;
    long operations_ = 0;
};

/// Negative pivots of A − σM.
int inertia_below(const SparseMatrix& A, const Vector& M, double sigma);

}   // namespace meshfolio
