/// @file
/// Block Lanczos for (B − σI)⁻¹ with eight vectors a step, all of them kept, and orthogonalised again where rounding has brought them too
/// near each other (Grimes, Lewis & Simon 1994). Private to the layer.
/// Spectra takes 2.5 times the processor time for the 30 smallest pairs of 43 k vertices, and 4.2 times for 150 (tests/bench/spectrum.py).
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/linear/aligned_columns.h"
#include "geometry/linear/ldlt_panels.h"
#include "geometry/linear/subtree_solves.h"
#include "geometry/spectrum/engine/orthogonality_watch.h"
#include "geometry/spectrum/engine/zero_modes.h"
#include "geometry/spectrum/laplace_spectrum.h"

namespace meshfolio {

/// Since some moment: differences are what work took.
inline double seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// Eigenpairs of the projected problem, μ ascending.
struct RitzPairs {
    Vector mu;   // σ + 1/θ
    Vector theta;
    Vector residual;   // relative: ‖By − μy‖ / |μ| of the vector purified by one inverse iteration, which needs no solve
    DenseMatrix S;     // coordinates in the basis, a column a pair
    int count() const { return static_cast<int>(mu.size()); }
};

class BlockLanczos {
public:
    struct Setting {
        double sigma = 0;
        std::uint64_t seed = 0;
        const SparseMatrix* refine_with = nullptr;   // B in the order of elimination: every solve is refined once with its residual
        bool parallel = false;                       // the rows of one block shared out among threads; the numbers are the same
    };

    /// @param factor  of B − σI
    /// @param zeros   in the order of elimination
    /// @param locked  eigenvectors known already, in that order: the basis is kept orthogonal to them
    BlockLanczos(const LdltPanels& factor, const ZeroModes& zeros, const std::vector<const EightColumns*>& locked, const Setting& setting);

    void advance();   // by one block
    int basis_size() const { return EightColumns::width * (static_cast<int>(V_.size()) - 1); }
    RitzPairs ritz_pairs();
    /// The chosen ones in groups of eight, the last filled up with zeros, purified. They are written over the basis, most of the memory
    /// that there is: nothing else can be asked for afterwards.
    std::vector<EightColumns> take_vectors(const RitzPairs& pairs, std::span<const int> chosen);

    SpectrumTimes times;

private:
    using Small = EightColumns::Small;
    void invert(EightColumns& W) const;   // W := (B − σI)⁻¹ W, away from the zero modes
    /// W := (W − Σ S_j G_j) T for each W, then the products PᵀW of what is left, all in one sweep over the rows.
    /// @param G  an 8 × 8 matrix for each block of S, those of the first W first; the products are returned alike
    std::vector<double> sweep(std::span<double* const> W, Blocks S, const double* G, Blocks P, const Small* T = nullptr) const;
    std::vector<double> sweep(double* W, Blocks S, const double* G, Blocks P) const { return sweep({&W, 1}, S, G, P); }
    /// W − Σ S_j G_j = V R; gram is its square. W becomes V, and R is returned.
    Small normalise(EightColumns& W, Small gram, Blocks S, const double* G);
    Small orthogonalise(EightColumns& W) const;   // against all; returns WᵀW
    /// W against all, and the last block against all before it; returns WᵀW.
    Small orthogonalise_with_last(EightColumns& W);
    /// W, WᵀW = gram, against the blocks before it where rounding has brought it too near to them: then `gram` follows.
    bool keep_orthogonal(EightColumns& W, Small& gram);
    void fill_up(EightColumns& W, const Eigen::Array<bool, 8, 1>& lost);

    const LdltPanels& factor_;
    std::optional<SubtreeSolves> subtrees_;   // where one block is shared out
    const ZeroModes& zeros_;
    Setting setting_;
    Eigen::Index n_;
    std::vector<EightColumns> V_;
    std::vector<const double*> all_;   // first rows: of the locked ones, then of V_
    std::size_t locked_count_;
    std::vector<Small> diagonal_, below_;   // of the block tridiagonal matrix VᵀWV
    OrthogonalityWatch watch_;
    double scale_ = 0;   // ‖(B − σI)⁻¹‖ as far as seen
};

}   // namespace meshfolio
