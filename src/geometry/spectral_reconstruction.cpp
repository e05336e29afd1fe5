#include "geometry/spectral_reconstruction.h"

#include <algorithm>
#include <cmath>

#include "errors.h"

namespace meshfolio {

namespace {

/// Positions about their centroid. Far from the origin, rounding of ΦᵀM1 = 0 times the distance would be all one sees.
struct Centred {
    Eigen::RowVector3d centroid;
    DenseMatrix X;   // n × 3
};

Centred centred(const Vector& M, const Positions& X) {
    const auto with_mass = std::find_if(M.begin(), M.end(), [](double area) { return area > 0; });
    if (with_mass == M.end()) throw MeshError("no vertex has an area: the mesh has no extent");
    const Eigen::RowVector3d near = X.row(with_mass - M.begin());
    const DenseMatrix offset = X.rowwise() - near;
    const Eigen::RowVector3d mean = M.transpose() * offset / M.sum();
    return {near + mean, offset.rowwise() - mean};
}

int zero_modes(const Spectrum& spectrum, int k) { return static_cast<int>((spectrum.eigenvalues.head(k).array() == 0).count()); }

void check_sizes(const Spectrum& spectrum, const Vector& M, const Positions& X) {
    if (spectrum.eigenvectors.rows() == M.size() && X.rows() == M.size() && M.size() > 0) return;
    throw MeshError("eigenvectors with " + std::to_string(spectrum.eigenvectors.rows()) + " rows, " + std::to_string(M.size()) +
                    " areas and " + std::to_string(X.rows()) + " positions do not belong together");
}

}   // namespace

/// Φᵀ M X = Φᵀ M (X − 1c) + (Φᵀ M 1) c, where only the zero modes see the constant.
DenseMatrix spectral_coefficients(const Spectrum& spectrum, const Vector& M, const Positions& X) {
    check_sizes(spectrum, M, X);
    const Centred about = centred(M, X);
    const DenseMatrix& Phi = spectrum.eigenvectors;
    DenseMatrix coefficients = Phi.transpose() * (M.asDiagonal() * about.X);
    const int zeros = zero_modes(spectrum, static_cast<int>(Phi.cols()));
    coefficients.topRows(zeros) += Phi.leftCols(zeros).transpose() * M * about.centroid;
    return coefficients;
}

Positions reconstruct(const Spectrum& spectrum, const Vector& M, const Positions& X, int k) {
    check_sizes(spectrum, M, X);
    if (k < 0 || k > spectrum.eigenvalues.size()) {
        throw MeshError("reconstruct: k = " + std::to_string(k) + " of " + std::to_string(spectrum.eigenvalues.size()) + " modes");
    }
    const Centred about = centred(M, X);
    const auto Phi = spectrum.eigenvectors.leftCols(k);
    const auto Z = Phi.leftCols(zero_modes(spectrum, k));
    // Z Zᵀ M 1 is 1 on every component whose zero mode is among the k, else 0; rounded to be exactly that.
    const Vector constant = (Z * (Z.transpose() * M)).array().round();
    Positions result = Phi * (Phi.transpose() * (M.asDiagonal() * about.X)) + constant * about.centroid;
    for (Eigen::Index v = 0; v < M.size(); ++v) {
        if (!(M[v] > 0)) result.row(v) = X.row(v);
    }
    return result;
}

/// ‖X − X_k‖²_M = ‖X − X_K‖²_M + Σ_{k ≤ j < K} |ĉ_j|², K the number of modes. Summed from the far end: ‖X‖²_M − Σ_{j<k} |ĉ_j|²
/// would leave the rounding of ‖X‖²_M where the error is small.
Vector reconstruction_rms(const Spectrum& spectrum, const Vector& M, const Positions& X) {
    const int K = static_cast<int>(spectrum.eigenvalues.size());
    const DenseMatrix coefficients = spectral_coefficients(spectrum, M, X);
    const Positions left = X - reconstruct(spectrum, M, X, K);
    Vector squared(K + 1);
    squared[K] = M.dot(left.rowwise().squaredNorm());
    for (int k = K - 1; k >= 0; --k) squared[k] = squared[k + 1] + coefficients.row(k).squaredNorm();
    return (squared / M.sum()).cwiseSqrt();
}

}   // namespace meshfolio
