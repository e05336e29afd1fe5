#include "geometry/spectrum/spectral_reconstruction.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/errors.h"

namespace meshfolio {

namespace {

/// Positions about their centroid. Far from the origin, rounding of ΦᵀM1 = 0 times the distance would be all one sees.
struct Centred {
    Eigen::RowVector3d centroid;
    DenseMatrix X;   // n × 3
};

Centred centred(const Vector& M, const Positions& X) {
    const auto with_mass = std::find_if(M.begin(), M.end(), [](double area) { return area > 0; });
    if (with_mass == M.end())
        throw MeshError("no triangle has an area that can be told from 0", "scale the mesh up, or repair its triangles");
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

ReconstructionStream::ReconstructionStream(const Vector& M, const Positions& X) : M_(M), X_(X) {
    if (X.rows() != M.size())
        throw MeshError(std::to_string(M.size()) + " areas and " + std::to_string(X.rows()) + " positions do not belong together");
    Centred about = centred(M, X);
    centroid_ = about.centroid;
    centred_ = std::move(about.X);
    sum_ = DenseMatrix::Zero(M.size(), 3);
    constant_ = Vector::Zero(M.size());
}

void ReconstructionStream::add(const Eigen::Ref<const DenseMatrix>& modes, const Eigen::Ref<const Vector>& eigenvalues) {
    if (modes.rows() != M_.size() || modes.cols() != eigenvalues.size())
        throw MeshError("modes of " + std::to_string(modes.rows()) + " rows for " + std::to_string(M_.size()) + " vertices");
    DenseMatrix coefficients = modes.transpose() * (M_.asDiagonal() * centred_);
    sum_.noalias() += modes * coefficients;
    const Eigen::Index zeros = (eigenvalues.array() == 0).count();
    const Vector of_constant = modes.leftCols(zeros).transpose() * M_;
    constant_.noalias() += modes.leftCols(zeros) * of_constant;
    coefficients.topRows(zeros) += of_constant * centroid_;
    for (Eigen::Index j = 0; j < coefficients.rows(); ++j) energies_.push_back(coefficients.row(j).squaredNorm());
}

Positions ReconstructionStream::positions() const {
    // Z Zᵀ M 1 is 1 on every component whose zero mode is among those added, else 0; rounded to be exactly that.
    Positions result = sum_ + constant_.array().round().matrix() * centroid_;
    for (Eigen::Index v = 0; v < M_.size(); ++v)
        if (!(M_[v] > 0)) result.row(v) = X_.row(v);
    return result;
}

/// ‖X − X_k‖²_M = ‖X − X_K‖²_M + Σ_{k ≤ j < K} |ĉ_j|², K the number of modes. Summed from the far end: ‖X‖²_M − Σ_{j<k} |ĉ_j|²
/// would leave the rounding of ‖X‖²_M where the error is small.
Vector ReconstructionStream::rms() const {
    const int K = modes();
    Vector squared(K + 1);
    squared[K] = M_.dot((X_ - positions()).rowwise().squaredNorm());
    for (int k = K - 1; k >= 0; --k) squared[k] = squared[k + 1] + energies_[static_cast<std::size_t>(k)];
    return (squared / M_.sum()).cwiseSqrt();
}

Positions reconstruct(const Spectrum& spectrum, const Vector& M, const Positions& X, int k) {
    check_sizes(spectrum, M, X);
    if (k < 0 || k > spectrum.eigenvalues.size())
        throw MeshError("reconstruct: k = " + std::to_string(k) + " of " + std::to_string(spectrum.eigenvalues.size()) + " modes");
    ReconstructionStream stream(M, X);
    stream.add(spectrum.eigenvectors.leftCols(k), spectrum.eigenvalues.head(k));
    return stream.positions();
}

Vector reconstruction_rms(const Spectrum& spectrum, const Vector& M, const Positions& X) {
    check_sizes(spectrum, M, X);
    ReconstructionStream stream(M, X);
    stream.add(spectrum.eigenvectors, spectrum.eigenvalues);
    return stream.rms();
}

}   // namespace meshfolio
