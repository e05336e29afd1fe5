// What the watch expects of block Lanczos vectors, against the vectors themselves.
#include "geometry/spectrum/engine/orthogonality_watch.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>

#include "geometry/linear/random_numbers.h"

using namespace meshfolio;

namespace {

using Small = OrthogonalityWatch::Small;
constexpr int width = EightColumns::width;

DenseMatrix orthonormal_columns(const DenseMatrix& W, Small& R) {
    const Eigen::HouseholderQR<DenseMatrix> qr(W);
    R = qr.matrixQR().topRows(width).triangularView<Eigen::Upper>();
    return qr.householderQ() * DenseMatrix::Identity(W.rows(), width);
}

/// Largest |V_kᵀV_j|, k < j − 1.
double loss(const std::vector<DenseMatrix>& V) {
    double largest = 0;
    for (std::size_t k = 0; k + 2 < V.size(); ++k) largest = std::max(largest, (V[k].transpose() * V.back()).cwiseAbs().maxCoeff());
    return largest;
}

struct Step {
    double expected = 0, measured = 0;
    bool cleaned = false;
};

/// Block Lanczos with the diagonal matrix of the inverses 1, 1/2, 1/3 … , as of a shift below a spectrum that grows evenly;
/// orthogonalised again whenever more than `allowed` is expected, or never.
std::vector<Step> run(int n, int steps, double allowed) {
    const Vector op = Vector::LinSpaced(n, 1, n).cwiseInverse();
    std::uint64_t seed = 7;
    DenseMatrix start(n, width);
    for (double& entry : start.reshaped()) entry = uniform_number(seed);
    Small R;
    std::vector<DenseMatrix> V{orthonormal_columns(start, R)};
    std::vector<Small> diagonal, below;
    OrthogonalityWatch watch;
    std::vector<Step> result;
    for (int j = 0; j < steps; ++j) {
        DenseMatrix W = op.asDiagonal() * V.back();
        if (j > 0) W -= V[V.size() - 2] * below.back().transpose();
        Small A = V.back().transpose() * W;
        W -= V.back() * A;
        W -= V.back() * (V.back().transpose() * W);
        diagonal.push_back(0.5 * (A + A.transpose()));
        DenseMatrix next = orthonormal_columns(W, R);
        below.push_back(R);
        Step step;
        step.expected = watch.expect(diagonal, below);
        step.cleaned = step.expected > allowed;
        if (step.cleaned) {
            for (std::size_t k = 0; k + 1 < V.size(); ++k) {
                V.back() -= V[k] * (V[k].transpose() * V.back());
                next -= V[k] * (V[k].transpose() * next);
            }
            next -= V.back() * (V.back().transpose() * next);
        }
        V.push_back(next);
        step.measured = loss(V);
        watch.advance(step.cleaned);
        result.push_back(step);
    }
    return result;
}

}   // namespace

TEST(OrthogonalityWatch, FollowsALossThatNothingStops) {
    const std::vector<Step> steps = run(600, 9, INFINITY);
    EXPECT_GT(steps.back().measured, 1e-8) << "the loss must be seen to grow for this test to say anything";
    for (std::size_t j = 2; j < steps.size(); ++j) {
        EXPECT_LT(steps[j].measured, 6 * steps[j].expected) << "step " << j;
        EXPECT_GT(steps[j].measured, 0.1 * steps[j].expected) << "step " << j;
    }
}

TEST(OrthogonalityWatch, KeepsTheLossWithinWhatIsAllowed) {
    const std::vector<Step> steps = run(600, 40, 1e-11);
    int cleaned = 0;
    for (const Step& step : steps) {
        cleaned += step.cleaned;
        EXPECT_LT(step.measured, 1e-9);
    }
    EXPECT_GT(cleaned, 2);
    EXPECT_LT(cleaned, 30) << "not at every step";
}

TEST(OrthogonalityWatch, LearnsFromWhatWasMeasured) {
    const auto expected_after = [](double measured) {
        OrthogonalityWatch watch;
        std::vector<Small> diagonal, below;
        for (int j = 0; j < 3; ++j) {
            diagonal.push_back(Small::Identity());
            below.push_back(0.5 * Small::Identity());
            watch.expect(diagonal, below);
            if (j == 2) watch.compare(measured);
            watch.advance(j == 2);
        }
        diagonal.push_back(Small::Identity());
        below.push_back(0.5 * Small::Identity());
        return watch.expect(diagonal, below);
    };
    EXPECT_GT(expected_after(1e-12), 10 * expected_after(1e-18));
    EXPECT_EQ(expected_after(1e-16), expected_after(1e-18)) << "what rounding alone can show says nothing";
}

TEST(OrthogonalityWatch, ExpectsTheWorstOfABlockThatIsSingular) {
    OrthogonalityWatch watch;
    std::vector<Small> diagonal{Small::Identity()}, below{Small::Identity()};
    watch.expect(diagonal, below);
    watch.advance(false);
    diagonal.push_back(Small::Identity());
    below.push_back(Small::Zero());
    EXPECT_GE(watch.expect(diagonal, below), 1);
}
