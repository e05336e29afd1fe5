/// @file
/// Inner loops of the block Lanczos method for the vectors of this processor, chosen at run time (Highway). A column is a lane
/// whatever the width of the vectors, so that no sum depends on it; products are added with one rounding where the processor can.
/// Private to the layer. They stay because 30 or 150 eigenpairs of 43 000 vertices take 1.6 times as long without wide vectors.
#pragma once

#include <span>

#include "geometry/linear/aligned_columns.h"
#include "geometry/linear/ldlt_panels.h"

namespace meshfolio {

using Blocks = std::span<const double* const>;   // the first row of each n × 8 block

/// The rows that are worked on together: a panel of W stays in the fastest cache while all of V streams past it.
constexpr Eigen::Index panel_rows = 256;

/// G_j += V_jᵀ W over the rows [first, last) for each block V_j. G: one 8 × 8 matrix a block, row-major.
void add_products(Blocks V, const double* W, Eigen::Index first, Eigen::Index last, double* G);

/// W −= Σ V_j G_j in the rows [first, last).
void subtract_combination(Blocks V, const double* G, Eigen::Index first, Eigen::Index last, double* W);

/// W := W T in the rows [first, last), T 8 × 8 and row-major.
void multiply_rows(const double* T, Eigen::Index first, Eigen::Index last, double* W);

/// Eight columns of a symmetric matrix, of which the first eight rows are the diagonal block, become those of its LDLᵀ: W is L with zeros
/// for its unit diagonal, `pivots` the eight of D.
void eliminate_block(double* W, Eigen::Index rows, double* pivots);

/// X := (LDLᵀ)⁻¹ X in the order of elimination.
void solve_in_place(const LdltPanels& factor, double* X);   // n × 8
void solve_in_place(const LdltPanels& factor, FourColumns& X);

/// The rows outside a subtree. Several subtrees are solved at once and all subtract from such rows, so each sums its part up by itself.
struct OutsideRows {
    const std::vector<int>& rows;     // as in the factor, but rows outside are given by their place in `sums`
    const std::vector<int>& inside;   // of each panel, how many of its rows lie inside; those outside follow
    double* sums;                     // rows outside × 8, to be added to X
};

/// X := L⁻¹ X and X := L⁻ᵀD⁻¹ X as far as the panels [first, end) go, X n × 8.
void solve_forward(const LdltPanels& factor, int first, int end, const OutsideRows* outside, double* X);
void solve_backward(const LdltPanels& factor, int first, int end, double* X);

}   // namespace meshfolio
