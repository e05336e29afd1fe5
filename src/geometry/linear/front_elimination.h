/// @file
/// LDLᵀ by fronts: dense matrices, one for each group of columns, to which the children add what they have left (Duff & Reid 1983).
/// No pivoting. Eigen and CHOLMOD factor LDLᵀ column by column: the 36 M entries of 692 000 rows take CHOLMOD 12.2 s of processor, and
/// fronts 1.4 to 1.8 s. Private to the layer.
#pragma once

#include "geometry/linear/front_tree.h"
#include "geometry/linear/ldlt_panels.h"

namespace meshfolio {

/// Of A − σI. Pivots are not looked at: a vanishing one leaves numbers that are not finite. Each entry is what it would be column by
/// column, a_ij − Σ l_ik (d_k l_jk), summed over ascending k within a front and over the fronts in a fixed order, whatever the threads.
/// @param A         of the tree's pattern, both triangles stored, every diagonal entry too
/// @param parallel  subtrees side by side, then the columns of large fronts
LdltPanels factor_by_fronts(const SparseMatrix& A, double sigma, const FrontTree& tree, bool parallel);

}   // namespace meshfolio
