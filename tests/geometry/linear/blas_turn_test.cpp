#include "geometry/linear/blas_turn.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "geometry/linear/cholesky_analysis.h"
#include "geometry/linear/sparse_factor.h"
#include "geometry/solver_test_meshes.h"
#include "mesh/samples/random_sphere.h"
#include "mesh/samples/sample_parts.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

/// M − λC of some 172,000 vertices: supernodal, and of supernodes of so many sizes that threads meet in BLAS. Regular meshes are too tame.
SparseMatrix irregular_system() {
    const TriangleMesh mesh = subdivided_onto(random_sphere(43'000, 1), 1, [](const Vector3& p) { return p; });
    const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
    SparseMatrix A(mesh.vertex_count(), mesh.vertex_count());
    A = laplacian.M.asDiagonal();
    return A - 1e-3 * laplacian.C;
}

/// How many of `threads` × `repetitions` runs of `is_right` were not, an exception included.
template <class Run>
int wrong_of(int threads, int repetitions, const Run& is_right) {
    std::atomic<int> wrong{0};
    std::vector<std::thread> team;
    for (int t = 0; t < threads; ++t) {
        team.emplace_back([&] {
            for (int r = 0; r < repetitions; ++r) {
                try {
                    wrong += is_right() ? 0 : 1;
                } catch (const std::exception&) {
                    ++wrong;
                }
            }
        });
    }
    for (std::thread& thread : team) thread.join();
    return wrong;
}

}   // namespace

TEST(BlasTurn, BuildsOfOpenBlasThatGuardTheirBuffers) {
    EXPECT_TRUE(guards_its_buffers(BlasThreads::posix, "OpenBLAS 0.3.21 NO_LAPACKE DYNAMIC_ARCH NO_AFFINITY Zen MAX_THREADS=64"));
    EXPECT_TRUE(guards_its_buffers(BlasThreads::none, "OpenBLAS 0.3.28 NO_AFFINITY USE_LOCKING Zen SINGLE_THREADED"));
    EXPECT_FALSE(guards_its_buffers(BlasThreads::none, "OpenBLAS 0.3.21 NO_LAPACKE DYNAMIC_ARCH NO_AFFINITY Zen SINGLE_THREADED"));
    EXPECT_FALSE(guards_its_buffers(BlasThreads::openmp, "OpenBLAS 0.3.21 NO_AFFINITY USE_OPENMP Zen MAX_THREADS=64"));
    EXPECT_FALSE(guards_its_buffers(static_cast<BlasThreads>(7), "")) << "of a version to come";
}

TEST(BlasTurn, OneHoldsItUnlessTheLibraryIsSafe) {
    const auto turn = blas_turn();
    EXPECT_EQ(turn.owns_lock(), !blas_library().is_safe);
}

// Fails within a few factorisations where OpenBLAS for one thread is called without a turn.
TEST(BlasTurn, LargeFactorsAreTheSameFromSeveralThreads) {
    const SparseMatrix A = irregular_system();
    const CholeskyAnalysis analysis(A);
    const std::vector<double> L = analysis.factor(A).values;
    const SparseFactor factor = SparseFactor::cholesky(A);
    const DenseMatrix B = DenseMatrix::NullaryExpr(A.rows(), 3, [](auto i, auto j) { return std::sin(1.0 + double(i) + 7.0 * double(j)); });
    const DenseMatrix X = factor.solve(B);
    EXPECT_EQ(wrong_of(4, 1, [&] { return analysis.factor(A).values == L; }), 0) << "factors";
    EXPECT_EQ(wrong_of(4, 1, [&] { return factor.solve(B) == X; }), 0) << "solutions";
}
