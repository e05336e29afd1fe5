// Spectrum, certificate and implicit steps with a factor that others hold: here this process alone, by other means than the program's own,
// and, where the build has them, the ranks of MPI. tests/end_to_end/slow_ranks.py runs several.
#include <Eigen/Eigenvalues>

#include "geometry/distributed/backend.h"
#include "geometry/distributed/ranks.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "base/errors.h"
#include "geometry/dense_pairs.h"
#include "geometry/linear/inertia.h"
#include "geometry/linear/sparse_factor.h"
#include "geometry/operators/vertices_with_mass.h"
#include "geometry/smoothing/laplacian_smoothing.h"
#include "geometry/solver_test_meshes.h"
#include "geometry/spectrum/spectrum_certificate.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

class DenseRanks : public Ranks {
public:
    bool is_first() const override { return true; }
    void serve() override {}
    void factor(const SparseMatrix& S, bool definite) override {
        DenseMatrix dense = S;
        if (error.size() > 0) dense += error;
        eigen_ = dense_pairs(dense);
        if (definite && !(eigen_.eigenvalues[0] > 0)) throw SolverError("not positive definite");
    }
    int negative_pivots() override { return static_cast<int>((eigen_.eigenvalues.array() < 0).count()); }
    long long nonzeros() override { return eigen_.eigenvectors.size(); }
    DenseMatrix solve(const DenseMatrix& B) override {
        const DenseMatrix& Q = eigen_.eigenvectors;
        return Q * eigen_.eigenvalues.cwiseInverse().asDiagonal() * (Q.transpose() * B);
    }
    /// Ranks that lose the first `lost` pairs of the next calls.
    InversePairs largest_of_inverse(int count, const DenseMatrix& known) override {
        InversePairs pairs{Vector(count), DenseMatrix(known.rows(), count)};
        int kept = 0, passed = lost > 0 ? 1 : 0;
        lost = std::max(lost - 1, 0);
        for (Eigen::Index j = 0; kept < count; ++j) {
            Vector y = eigen_.eigenvectors.col(j);
            y -= known * (known.transpose() * y);
            y -= pairs.Y.leftCols(kept) * (pairs.Y.leftCols(kept).transpose() * y);
            if (y.norm() < 1e-6 || passed-- > 0) continue;
            pairs.theta[kept] = 1 / eigen_.eigenvalues[j];
            pairs.Y.col(kept++) = y.normalized();
        }
        return pairs;
    }

    DenseMatrix error;   // of every factor
    int lost = 0;

private:
    DensePairs eigen_;
};

/// This process's own, or those of MPI, which can begin once.
Ranks& ranks_called(const std::string& name) {
    static DenseRanks dense;
    static std::unique_ptr<Ranks> of_mpi;
    if (name == "dense") return dense;
    if (!of_mpi) of_mpi = ranks_of_mpi();
    if (!of_mpi->is_first()) {   // mpirun -n 2 geometry_tests --gtest_filter='*WithRanks*mpi'
        of_mpi->serve();
        of_mpi.reset();
        std::_Exit(0);
    }
    return *of_mpi;
}

struct Named {
    std::string name;
    TriangleMesh mesh;
};

std::vector<Named> meshes() {
    return {{"sphere, of multiple eigenvalues", icosphere(2)},
            {"open", irregular_plane(14)},
            {"two components", side_by_side(lopsided_ellipsoid(2), cube_mesh(6))}};
}

SpectrumOptions options_of(const Backend& backend) { return {.dense_below = 0, .engine = backend.engine}; }

class WithRanks : public ::testing::TestWithParam<std::string> {
protected:
    void SetUp() override {
        try {
            ranks_ = &ranks_called(GetParam());
        } catch (const EngineError& error) {
            EXPECT_EQ(error.exit_code(), ExitCode::engine);
            GTEST_SKIP() << error.what();
        }
    }
    Backend backend() const { return backend_of(*ranks_); }
    SpectrumOptions options() const { return options_of(backend()); }
    Ranks* ranks_ = nullptr;
};

}   // namespace

TEST_P(WithRanks, SpectrumAndCertificateAreThoseOfThisProcess) {
    for (const auto& [name, mesh] : meshes()) {
        const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
        for (const int k : {1, 2, 30}) {
            const Spectrum own = smallest_eigenpairs(laplacian, k), theirs = smallest_eigenpairs(laplacian, k, options());
            const double unit = std::max(own.eigenvalues[k - 1], 1e-300);
            EXPECT_LT((own.eigenvalues - theirs.eigenvalues).cwiseAbs().maxCoeff() / unit, 1e-10) << name << ", k = " << k;
            EXPECT_LT(theirs.residuals.maxCoeff(), 1e-9) << name;
            const SpectrumCertificate a = certify_spectrum(mesh, laplacian, own),
                                      b = certify_spectrum(mesh, laplacian, theirs, backend().inertia_at);
            EXPECT_TRUE(b.holds()) << name << ", k = " << k;
            EXPECT_EQ(a.counted_below, b.counted_below) << name << ", k = " << k;
        }
    }
}

TEST_P(WithRanks, APairThatIsMissingIsCounted) {
    for (const auto& [name, mesh] : meshes()) {
        const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
        for (const int missing : {2, 5, 8}) {
            Spectrum spectrum = smallest_eigenpairs(laplacian, 12, options());
            std::vector<int> kept;
            for (int j = 0; j < 12; ++j)
                if (j != missing) kept.push_back(j);
            spectrum.eigenvalues = spectrum.eigenvalues(kept).eval();
            spectrum.eigenvectors = spectrum.eigenvectors(Eigen::all, kept).eval();
            const SpectrumCertificate certificate = certify_spectrum(mesh, laplacian, spectrum, backend().inertia_at);
            EXPECT_EQ(certificate.complete, Proof::refuted) << name << " without " << missing;
            EXPECT_EQ(certificate.counted_below, certificate.found_below + 1) << name << " without " << missing;
        }
    }
}

TEST_P(WithRanks, ImplicitStepsAreThoseOfThisProcess) {
    for (const auto& [name, mesh] : meshes()) {
        for (const bool rebuild : {false, true}) {
            SmoothingOptions smoothing{
                .scheme = SmoothingScheme::implicit_euler, .lambda = 20 * critical_step(mesh), .iterations = 3, .rebuild = rebuild};
            const Smoothed own = smooth(mesh, smoothing);
            smoothing.factor_remotely = backend().factor;
            const Smoothed theirs = smooth(mesh, smoothing);
            EXPECT_EQ(theirs.solver, LinearSolver::distributed);
            EXPECT_EQ(theirs.factorisations, rebuild ? 3 : 1);
            EXPECT_EQ(theirs.analyses, 0) << "none of this process's own";
            EXPECT_GE(theirs.factor_nonzeros, mesh.vertex_count());
            EXPECT_LT(largest_difference(own.X, theirs.X), 1e-12) << name;
        }
    }
}

TEST_P(WithRanks, IndefiniteMatricesAreRefused) {
    SparseMatrix S(3, 3);
    S.setIdentity();
    S.coeffRef(1, 1) = -1;
    EXPECT_THROW(ranks_->factor(S, true), SolverError);
    ranks_->factor(S, false);
    EXPECT_EQ(ranks_->negative_pivots(), 1);
}

INSTANTIATE_TEST_SUITE_P(Ranks, WithRanks, ::testing::Values("dense", "mpi"), [](const auto& test) { return test.param; });

TEST(Ranks, PairsLostAreLookedForAgain) {
    const LaplaceBeltrami laplacian = laplace_beltrami(lopsided_ellipsoid(2));
    const Spectrum own = smallest_eigenpairs(laplacian, 10);
    DenseRanks ranks;
    ranks.lost = 1;
    const Spectrum theirs = smallest_eigenpairs(laplacian, 10, options_of(backend_of(ranks)));
    EXPECT_EQ(theirs.repairs, 1);
    EXPECT_LT((own.eigenvalues - theirs.eigenvalues).cwiseAbs().maxCoeff(), 1e-10 * own.eigenvalues[9]);
    ranks.lost = 1000;
    EXPECT_THROW(smallest_eigenpairs(laplacian, 10, options_of(backend_of(ranks))), SolverError);
}

// δ is measured: it must reach ‖M^−½EM^−½‖ of a factor with a known error E, and a count may be wrong within it only.
TEST(Ranks, TheMeasuredRoundingBoundsTheErrorOfTheFactor) {
    const LaplaceBeltrami laplacian = laplace_beltrami(lopsided_ellipsoid(1));
    const OperatorWithMass whole = operator_with_mass(laplacian);
    const Spectrum all = smallest_eigenpairs(laplacian, whole.size());
    const Vector scale = whole.M.cwiseSqrt().cwiseInverse();
    std::srand(5);
    for (const double size : {1e-6, 1e-3, 1e-1}) {
        for (const int rank : {1, 40}) {
            DenseRanks ranks;
            const DenseMatrix G = DenseMatrix::Random(whole.size(), rank);
            ranks.error = G * G.transpose();
            const auto norm = [&] { return (scale.asDiagonal() * ranks.error * scale.asDiagonal()).eval().operatorNorm(); };
            ranks.error *= size / norm();
            for (int j = 1; j < 20; ++j) {
                const double sigma = 0.5 * (all.eigenvalues[j] + all.eigenvalues[j - 1]);
                const Inertia inertia = backend_of(ranks).inertia_at(whole.A, whole.M, sigma);
                EXPECT_LT(inertia.delta, 1000 * size * std::sqrt(rank)) << "or it proves nothing";
                const double distance = (all.eigenvalues.array() - sigma).abs().minCoeff();
                EXPECT_TRUE(inertia.delta >= size || 2 * size >= distance) << j;
                EXPECT_TRUE(inertia.below == j || inertia.delta >= distance) << "E of " << size << " at " << sigma;
            }
        }
    }
}
