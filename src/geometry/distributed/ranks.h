/// @file
/// Factorisations by several processes together, for factors beyond the memory of one (`--backend slepc`).
///
/// They pay by memory, never by time. At 43 k vertices 30 pairs and their certificate take 1.2 s of processor by the built-in engine, 12 s
/// by one rank; one implicit step at 692 k took 8 s, 17 s, and 24 s on two ranks. Peaks at 43 k, 173 k and 692 k vertices (armadillo at
/// edge midpoints): built-in 86, 326, 1372 MB; two ranks 95 + 62, 245 + 116, 893 + 349 MB. A factor had 23.5, 31.8 and 42.1 entries a
/// vertex, 5 more a doubling, each some 20 bytes beside a rank's 50 MB; the first rank's mesh and matrices, 0.8 kB a vertex, stay in one
/// place.
///
/// By these figures ranks pay from the limit of the built-in's 2 kB a vertex, 2·10⁷ triangles on machines of 24 GB and 2·10⁸ on 256 GB, to
/// that of the first rank, 6·10⁷ and 6·10⁸. 10⁹ triangles (5·10⁸ vertices, 90 entries each, 0.9 TB: 4 machines of 256 GB, or 40 of 24 GB)
/// would first need a mesh in parts, 400 GB now, and 64-bit indices: files end at 7·10⁸ triangles, matrices at 6·10⁸.
#pragma once

#include <memory>

#include "geometry/linear/sparse_types.h"

namespace meshfolio {

/// Eigenpairs Sy = y/θ, θ descending; orthonormal columns.
struct InversePairs {
    Vector theta;
    DenseMatrix Y;
};

/// Processes that hold a factor together. The first has the mesh, all matrices and the results; it alone calls the functions below serve(),
/// while the others only serve(). Matrices are symmetric; as in Eigen, both triangles are stored.
class Ranks {
public:
    virtual ~Ranks() = default;   // in the first process ends serve() of the others
    virtual bool is_first() const = 0;
    /// Takes part in the calls of the first process until it ends.
    /// @throws SolverError if this process alone failed
    virtual void serve() = 0;

    /// Factors S = LLᵀ or, with pivoting, LDLᵀ; replaces the last factor.
    /// @throws SolverError if S is not definite though it should be, or the memory of some process does not suffice
    virtual void factor(const SparseMatrix& S, bool definite) = 0;
    virtual int negative_pivots() = 0;   // of the factor of an indefinite S
    virtual long long nonzeros() = 0;    // of the factor, on all processes
    /// Returns S⁻¹B with the last factor of S; B has as many rows as S.
    virtual DenseMatrix solve(const DenseMatrix& B) = 0;
    /// Finds the `count` largest θ with S⁻¹y = θy, orthogonal to `known`, for a factor of a definite S.
    /// @throws SolverError if not all converge
    virtual InversePairs largest_of_inverse(int count, const DenseMatrix& known) = 0;
};

/// Starts MPI, at most once, and returns the ranks of `mpirun`, or this process alone; factors by MUMPS, eigenpairs by SLEPc.
/// @throws EngineError if the program was built without -DMESHFOLIO_SLEPC=ON
std::unique_ptr<Ranks> ranks_of_mpi();

}   // namespace meshfolio
