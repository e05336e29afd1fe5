#include "geometry/spectrum/quantised_modes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/spectrum/laplace_spectrum.h"
#include "geometry/spectrum/spectral_reconstruction.h"
#include "mesh/samples/sample_shapes.h"
#include "mesh/triangle_measures.h"

using namespace meshfolio;

TEST(QuantisedModes, NoNumberMovesByMoreThanHalfAStepOfItsColumn) {
    DenseMatrix modes = DenseMatrix::Random(40, 7);
    modes.col(2) *= 1e-200;   // a scale each
    modes.col(3).setZero();
    modes.col(4) *= 1e200;
    const DenseMatrix restored = quantised(modes).restored();
    for (int j = 0; j < 7; ++j) {
        const double peak = modes.col(j).cwiseAbs().maxCoeff();
        EXPECT_LE((restored.col(j) - modes.col(j)).cwiseAbs().maxCoeff(), peak / 65534 * (1 + 1e-12)) << j;
        EXPECT_NEAR(restored.col(j).cwiseAbs().maxCoeff(), peak, 1e-15 * peak) << j;   // the largest is exact
    }
}

TEST(QuantisedModes, AColumnHasAsManyStepsAsItsPrecisionAsksFor) {
    const DenseMatrix modes = DenseMatrix::Random(40, 6);
    Vector precision(6);
    precision << 1, 0.5, 1e-2, 1e-9, 7, 0;
    const QuantisedModes rounded = quantised(modes, precision);
    for (int j = 0; j < 6; ++j) {
        const double peak = modes.col(j).cwiseAbs().maxCoeff(), steps = std::clamp(std::ceil(precision[j] * 32767), 127.0, 32767.0);
        EXPECT_DOUBLE_EQ(rounded.scale[j], peak / steps) << j;
        EXPECT_LE((rounded.restored().col(j) - modes.col(j)).cwiseAbs().maxCoeff(), peak / (2 * steps) * (1 + 1e-12)) << j;
    }
}

// |Σ c_j δφ_j| ≤ Σ |c_j| max|φ_j|/65534: what the page shows is that near to the reconstruction.
TEST(QuantisedModes, AReconstructionMovesByNoMoreThanTheBound) {
    const TriangleMesh mesh = cube_mesh(6);
    const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
    const Spectrum spectrum = smallest_eigenpairs(laplacian, mesh.vertex_count());
    const DenseMatrix c = spectral_coefficients(spectrum, laplacian.M, mesh.X);
    const DenseMatrix moved = quantised(spectrum.eigenvectors).restored() * c - mesh.X;
    const Vector peaks = spectrum.eigenvectors.cwiseAbs().colwise().maxCoeff() / 65534;
    EXPECT_LE(moved.rowwise().norm().maxCoeff(), c.rowwise().norm().dot(peaks) + 1e-12);
    EXPECT_LT(moved.rowwise().norm().maxCoeff(), 2e-5 * bounding_box(mesh).diagonal());
    EXPECT_GT(moved.rowwise().norm().maxCoeff(), 1e-8);   // it is quantised
}
