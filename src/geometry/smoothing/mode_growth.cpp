#include "geometry/smoothing/mode_growth.h"

#include "base/errors.h"
#include "geometry/smoothing/diffusion_step.h"

namespace meshfolio {

ModeGrowth mode_growth(const LaplaceBeltrami& laplacian, const LargestEigenvalue& top, const Positions& X, double lambda, int steps) {
    if (X.rows() != laplacian.M.size() || top.mode.size() != X.rows()) {
        throw MeshError("growth of a mode: " + std::to_string(X.rows()) + " positions and a mode of " + std::to_string(top.mode.size()) +
                            " values for an operator on " + std::to_string(laplacian.M.size()) + " vertices",
                        "give one position and one value of the mode for each vertex");
    }
    const OperatorWithMass whole = operator_with_mass(laplacian);
    const ExplicitDiffusion diffusion(whole);
    const Vector weights = whole.M.cwiseProduct(top.mode(whole.vertex));
    const auto amplitude = [&](const FourColumns& Y) {
        Four sum = Four::Zero();
        for (Eigen::Index i = 0; i < Y.rows(); ++i) sum += weights[i] * row_of(Y, i);
        return sum.matrix().norm();
    };

    // Only the mode of μ = 0 holds the constant part; without it no digits are lost to it.
    const Positions centred = X.rowwise() - (X.transpose() * laplacian.M / laplacian.M.sum()).transpose();
    FourColumns Y = gathered(centred, diffusion.vertex()), next(Y.rows(), 4);
    const double start = amplitude(Y);
    if (!(start > 0)) throw MeshError("growth of a mode: the positions have none of it", "add it with seeded()");
    ModeGrowth growth{lambda, std::abs(1 - lambda * top.value), {1}};
    for (int t = 0; t < steps; ++t) {
        diffusion.step(lambda, Y, next);
        Y.swap(next);
        growth.factor.push_back(amplitude(Y) / start);
    }
    return growth;
}

Positions seeded(const Positions& X, const LargestEigenvalue& top, double height) {
    return X + height / top.mode.cwiseAbs().maxCoeff() * top.mode * Eigen::RowVector3d::Ones();
}

}   // namespace meshfolio
