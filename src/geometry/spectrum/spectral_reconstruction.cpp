#include "geometry/spectrum/spectral_reconstruction.h"

#include <algorithm>
#include <utility>

#include "base/errors.h"

namespace meshfolio {
namespace {

/// Positions about their centroid. Far from the origin, rounding of ΦᵀM1 = 0 times the distance would hide all else.
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

/// @throws MeshError if the sizes do not fit, or k is not between 0 and the number of modes
void check_sizes(const Spectrum& spectrum, const Vector& M, const Positions& X, Eigen::Index k) {
    const DenseMatrix& Phi = spectrum.eigenvectors;
    if (Phi.rows() == M.size() && X.rows() == M.size() && M.size() > 0 && k >= 0 && k <= Phi.cols()) return;
    throw MeshError("a reconstruction from " + std::to_string(k) + " of " + std::to_string(Phi.cols()) + " modes with " +
                        std::to_string(Phi.rows()) + " rows, " + std::to_string(M.size()) + " areas and " + std::to_string(X.rows()) +
                        " positions does not fit together",
                    "take all of one mesh, and no more modes than there are");
}

Positions with_massless_kept(Positions rebuilt, const Vector& M, const Positions& X) {
    for (Eigen::Index v = 0; v < M.size(); ++v)
        if (!(M[v] > 0)) rebuilt.row(v) = X.row(v);
    return rebuilt;
}

}   // namespace

// Φᵀ M X = Φᵀ M (X − 1c) + (Φᵀ M 1) c, where only the zero modes see the constant.
DenseMatrix spectral_coefficients(const Spectrum& spectrum, const Vector& M, const Positions& X) {
    check_sizes(spectrum, M, X, 0);
    const Centred about = centred(M, X);
    const DenseMatrix& Phi = spectrum.eigenvectors;
    DenseMatrix coefficients = Phi.transpose() * (M.asDiagonal() * about.X);
    const Eigen::Index zeros = (spectrum.eigenvalues.array() == 0).count();
    coefficients.topRows(zeros) += Phi.leftCols(zeros).transpose() * M * about.centroid;
    return coefficients;
}

ReconstructionStream::ReconstructionStream(const Vector& M, const Positions& X) : M_(M), X_(X) {
    if (X.rows() != M.size())
        throw MeshError(std::to_string(M.size()) + " areas and " + std::to_string(X.rows()) + " positions do not belong together",
                        "take both of one mesh");
    Centred about = centred(M, X);
    centroid_ = about.centroid;
    centred_ = std::move(about.X);
    sum_ = DenseMatrix::Zero(M.size(), 3);
    constant_ = Vector::Zero(M.size());
}

void ReconstructionStream::add(const Eigen::Ref<const DenseMatrix>& modes, const Eigen::Ref<const Vector>& eigenvalues) {
    if (modes.rows() != M_.size() || modes.cols() != eigenvalues.size())
        throw MeshError(std::to_string(modes.cols()) + " modes of " + std::to_string(modes.rows()) + " rows with " +
                            std::to_string(eigenvalues.size()) + " eigenvalues for " + std::to_string(M_.size()) + " vertices",
                        "give one row a vertex and one eigenvalue a mode");
    DenseMatrix coefficients = modes.transpose() * (M_.asDiagonal() * centred_);
    sum_.noalias() += modes * coefficients;
    const Eigen::Index zeros = (eigenvalues.array() == 0).count();
    const Vector of_constant = modes.leftCols(zeros).transpose() * M_;
    constant_.noalias() += modes.leftCols(zeros) * of_constant;
    coefficients.topRows(zeros) += of_constant * centroid_;
    for (Eigen::Index j = 0; j < coefficients.rows(); ++j) energies_.push_back(coefficients.row(j).squaredNorm());
}

Positions ReconstructionStream::positions() const {
    // Z Zᵀ M 1 is 1 on components with an added zero mode, else 0; it is rounded to be exactly that.
    return with_massless_kept(sum_ + constant_.array().round().matrix() * centroid_, M_, X_);
}

// ‖X − X_k‖²_M = ‖X − X_K‖²_M + Σ_{k ≤ j < K} |ĉ_j|², K the number of modes. Summed from the far end: ‖X‖²_M − Σ_{j<k} |ĉ_j|²
// would leave the rounding of ‖X‖²_M where the error is small.
Vector ReconstructionStream::rms() const {
    const int K = modes();
    Vector squared(K + 1);
    squared[K] = M_.dot((X_ - positions()).rowwise().squaredNorm());
    for (int k = K - 1; k >= 0; --k) squared[k] = squared[k + 1] + energies_[static_cast<std::size_t>(k)];
    return (squared / M_.sum()).cwiseSqrt();
}

Positions reconstruct(const Spectrum& spectrum, const Vector& M, const Positions& X, int k) {
    check_sizes(spectrum, M, X, k);
    ReconstructionStream stream(M, X);
    stream.add(spectrum.eigenvectors.leftCols(k), spectrum.eigenvalues.head(k));
    return stream.positions();
}

Vector reconstruction_rms(const Spectrum& spectrum, const Vector& M, const Positions& X) {
    check_sizes(spectrum, M, X, 0);
    ReconstructionStream stream(M, X);
    stream.add(spectrum.eigenvectors, spectrum.eigenvalues);
    return stream.rms();
}

Positions reconstruct_unmapped(const Spectrum& spectrum, const Vector& M, const Positions& X, int k) {
    check_sizes(spectrum, M, X, k);
    const auto Phi = spectrum.eigenvectors.leftCols(k);
    const Vector root = M.cwiseSqrt();
    const DenseMatrix coefficients = Phi.transpose() * (root.asDiagonal() * X);   // Ψᵀ X
    return with_massless_kept(root.asDiagonal() * (Phi * coefficients), M, X);
}

Positions reconstruct_unweighted(const Spectrum& spectrum, const Vector& M, const Positions& X, int k) {
    check_sizes(spectrum, M, X, k);
    const auto Phi = spectrum.eigenvectors.leftCols(k);
    const DenseMatrix coefficients = Phi.transpose() * X;
    return with_massless_kept(Phi * coefficients, M, X);
}

}   // namespace meshfolio
