/// @file
/// Factorisations by several processes together, for matrices whose factor is beyond the memory of one. `--backend slepc`.
#pragma once

#include <memory>

#include "geometry/linear/sparse_types.h"

namespace meshfolio {

/// Eigenpairs Sy = y/θ, θ descending; orthonormal columns.
struct InversePairs {
    Vector theta;
    DenseMatrix Y;
};

/// Processes that hold a factor together. The first has the mesh and every matrix as a whole, and the results: it calls what stands below
/// serve(). The others only serve(). Symmetric matrices; as in Eigen, both triangles are stored.
class Ranks {
public:
    virtual ~Ranks() = default;   // the first lets the others go
    virtual bool is_first() const = 0;
    /// For the others: does with the first what that calls, until it is done.
    /// @throws SolverError if this process alone could not go on
    virtual void serve() = 0;

    /// S = LLᵀ or, with pivoting, LDLᵀ; it replaces the factor before.
    /// @throws SolverError if S is not definite though it should be, or the memory of some process does not suffice
    virtual void factor(const SparseMatrix& S, bool definite) = 0;
    virtual int negative_pivots() = 0;   // of the factor, in one that need not be definite
    virtual long long nonzeros() = 0;    // of the factor, on all processes
    virtual DenseMatrix solve(const DenseMatrix& B) = 0;
    /// The largest θ with S⁻¹y = θy, orthogonal to `known`, for a factor of a definite S.
    /// @throws SolverError if that many do not converge
    virtual InversePairs largest_of_inverse(int count, const DenseMatrix& known) = 0;
};

/// The ranks of MPI that `mpirun` began, or this process alone; factors by MUMPS, eigenpairs by SLEPc. MPI begins here, once at most.
/// @throws EngineError if the program was built without -DMESHFOLIO_SLEPC=ON
std::unique_ptr<Ranks> ranks_of_mpi();

}   // namespace meshfolio
