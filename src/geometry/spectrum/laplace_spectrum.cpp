#include "geometry/spectrum/laplace_spectrum.h"

#include <tbb/parallel_for.h>

#include "base/errors.h"
#include "geometry/operators/vertices_with_mass.h"
#include "geometry/spectrum/engine/spectrum_modes.h"

namespace meshfolio {

Spectrum smallest_eigenpairs(const LaplaceBeltrami& laplacian, int k, const SpectrumOptions& options) {
    if (k < 1) throw MeshError("smallest_eigenpairs: k = " + std::to_string(k), "ask for at least one");
    const OperatorWithMass whole = operator_with_mass(laplacian);
    const double total = whole.M.sum();
    const Vector M = whole.M / total;   // in units where the area is 1
    k = std::min(k, whole.size());
    const Components components = components_of(whole.A);
    Modes modes = components.count > 1 ? modes_of_components(whole.A, M, components, k, options) : modes_of(whole.A, M, k, options);

    const Vector root = M.cwiseSqrt();
    Spectrum spectrum;
    spectrum.residuals = relative_residuals(symmetric_form(whole.A, M), root, modes.pairs);
    if (components.count > 1) {   // zero modes come in the order of their components
        Vector area = Vector::Zero(components.count);
        for (Eigen::Index i = 0; i < M.size(); ++i) area[components.label[std::size_t(i)]] += M[i];
        const int zeros = std::min(k, components.count);
        spectrum.residuals.head(zeros).array() *= area.cwiseSqrt().head(zeros).array();
    }
    spectrum.eigenvalues = modes.pairs.mu / total;
    DenseMatrix Phi = std::move(modes.pairs.Y);   // n × k may be most of the memory: scaled where it is
    const Vector scale = (root * std::sqrt(total)).cwiseInverse();
    tbb::parallel_for(0, k, [&](int j) {
        Phi.col(j).array() *= scale.array();
        if (Phi(first_largest(Phi.col(j)), j) < 0) Phi.col(j) *= -1;
    });
    spectrum.eigenvectors = whole.size() == whole.all_vertices ? std::move(Phi) : to_all_vertices(whole, Phi);
    spectrum.dense = modes.dense;
    spectrum.gap_middle = modes.gap_middle / total;
    spectrum.slices = modes.slices;
    spectrum.repairs = modes.repairs;
    if (options.progress) options.progress(1);
    return spectrum;
}

double orthonormality_error(const Spectrum& spectrum, const Vector& M) {
    const DenseMatrix& Phi = spectrum.eigenvectors;
    const DenseMatrix gram = Phi.transpose() * (M.asDiagonal() * Phi);
    return (gram - DenseMatrix::Identity(gram.rows(), gram.cols())).cwiseAbs().maxCoeff();
}

}   // namespace meshfolio
