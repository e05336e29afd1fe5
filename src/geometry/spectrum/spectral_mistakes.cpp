#include "geometry/spectrum/spectral_mistakes.h"

#include "base/errors.h"

namespace meshfolio {

namespace {

void check_sizes(const Spectrum& spectrum, const Vector& M, const Positions& X, int k) {
    const Eigen::Index n = M.size();
    if (spectrum.eigenvectors.rows() == n && X.rows() == n && k >= 0 && k <= spectrum.eigenvectors.cols()) return;
    throw MeshError("a reconstruction from " + std::to_string(k) + " of " + std::to_string(spectrum.eigenvectors.cols()) + " modes with " +
                    std::to_string(spectrum.eigenvectors.rows()) + " rows, " + std::to_string(n) + " areas and " +
                    std::to_string(X.rows()) + " positions");
}

Positions with_unreferenced_kept(Positions rebuilt, const Vector& M, const Positions& X) {
    for (Eigen::Index v = 0; v < M.size(); ++v)
        if (!(M[v] > 0)) rebuilt.row(v) = X.row(v);
    return rebuilt;
}

}   // namespace

Positions reconstruct_unmapped(const Spectrum& spectrum, const Vector& M, const Positions& X, int k) {
    check_sizes(spectrum, M, X, k);
    const auto Phi = spectrum.eigenvectors.leftCols(k);
    const Vector root = M.cwiseSqrt();
    const DenseMatrix coefficients = Phi.transpose() * (root.asDiagonal() * X);   // Ψᵀ X
    return with_unreferenced_kept(root.asDiagonal() * (Phi * coefficients), M, X);
}

Positions reconstruct_unweighted(const Spectrum& spectrum, const Vector& M, const Positions& X, int k) {
    check_sizes(spectrum, M, X, k);
    const auto Phi = spectrum.eigenvectors.leftCols(k);
    const DenseMatrix coefficients = Phi.transpose() * X;
    return with_unreferenced_kept(Phi * coefficients, M, X);
}

}   // namespace meshfolio
