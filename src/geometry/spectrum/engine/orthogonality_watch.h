/// @file
/// How far block Lanczos vectors have lost their orthogonality, followed without touching them (Simon 1984; Grimes, Lewis & Simon 1994).
/// Private to the layer.
#pragma once

#include <vector>

#include "geometry/linear/aligned_columns.h"

namespace meshfolio {

/// The recurrence Op V_j = V_{j+1} B_{j+1} + V_j A_j + V_{j−1} B_jᵀ, multiplied by V_kᵀ, makes Ω_{k,j+1} = V_kᵀV_{j+1} out of the Ω
/// before it; what rounding adds at each step is drawn at random. So the loss is foreseen at the price of a few 8 × 8 products a block.
class OrthogonalityWatch {
public:
    using Small = EightColumns::Small;

    /// @param diagonal  A_0 … A_j
    /// @param below     B_1 … B_{j+1}, the last one as the norm of W = V_{j+1} B_{j+1} gives it before W is normalised
    /// @return the largest entry of Ω_{k,j+1}, k < j, that is to be expected
    double expect(const std::vector<Small>& diagonal, const std::vector<Small>& below);
    /// V_{j+1} has become the last block. `clean`: it and V_j have been made orthogonal to all others.
    void advance(bool clean);
    /// To be told what V_j had really lost when it was cleaned: what rounding is taken to add follows.
    void compare(double measured);

private:
    std::vector<Small> before_, last_, next_;   // Ω_{k,j−1}, Ω_{k,j}, Ω_{k,j+1}, each with its own identity
    double rounding_ = 1e-16;                   // relative to ‖Op‖
    double norm_ = 0;                           // of Op as far as seen
    std::uint64_t random_ = 1;
};

}   // namespace meshfolio
