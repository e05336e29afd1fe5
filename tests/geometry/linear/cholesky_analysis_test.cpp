#include "geometry/linear/cholesky_analysis.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.h"
#include "geometry/linear/panel_kernels.h"
#include "geometry/linear/solver_versions.h"
#include "geometry/smoothing/position_rows.h"
#include "geometry/solver_test_meshes.h"
#include "geometry/spectrum/stability.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

SparseMatrix system_of(const TriangleMesh& mesh, double lambda) {
    const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
    SparseMatrix mass(laplacian.M.size(), laplacian.M.size());
    mass = laplacian.M.asDiagonal();
    return mass - lambda * laplacian.C;
}

/// Largest entry of A X − B over that of B.
double residual_of(const SparseMatrix& A, const LdltPanels& factor) {
    Positions B(A.rows(), 3);
    for (Eigen::Index i = 0; i < B.size(); ++i) B.data()[i] = std::sin(double(i));
    FourColumns rows = gathered(B, factor.order);
    solve_in_place(factor, rows);
    Positions X = B;
    scatter(rows, factor.order, X);
    return (A * X - B).cwiseAbs().maxCoeff() / B.cwiseAbs().maxCoeff();
}

}   // namespace

TEST(CholeskyAnalysis, SolvesInEveryForm) {
    for (const TriangleMesh& mesh : {irregular_sphere(4), grid_mesh(3, 2, 1, 1), irregular_plane(20)}) {
        const double step = critical_step(mesh);
        const SparseMatrix first = system_of(mesh, step), second = system_of(mesh, 100 * step);
        for (const FactorForm form : {FactorForm::automatic, FactorForm::simplicial, FactorForm::supernodal}) {
            for (const FactorLibrary library : {FactorLibrary::automatic, FactorLibrary::eigen}) {
                const CholeskyAnalysis analysis(first, form, library);
                for (const SparseMatrix& A : {first, second, first}) EXPECT_LT(residual_of(A, analysis.factor(A)), 1e-11);
            }
        }
    }
}

// Columns are joined to supernodes by zeros between their entries: a form that was asked for is the one that is taken.
TEST(CholeskyAnalysis, FormsDifferInTheirEntries) {
    const TriangleMesh mesh = irregular_sphere(4);
    const SparseMatrix A = system_of(mesh, critical_step(mesh));
    const auto entries = [&](FactorForm form, FactorLibrary library = FactorLibrary::automatic) {
        return CholeskyAnalysis(A, form, library).nonzeros();
    };
    EXPECT_EQ(entries(FactorForm::automatic), entries(FactorForm::simplicial)) << "below 100 000 rows";
    EXPECT_EQ(entries(FactorForm::supernodal, FactorLibrary::eigen), entries(FactorForm::simplicial, FactorLibrary::eigen));
    if (solver_versions().contains("CHOLMOD")) {
        EXPECT_GT(entries(FactorForm::supernodal), entries(FactorForm::simplicial));
    }
}

TEST(CholeskyAnalysis, RefusesWhatIsNotPositiveDefinite) {
    const TriangleMesh mesh = irregular_sphere(2);
    for (const FactorForm form : {FactorForm::simplicial, FactorForm::supernodal}) {
        const SparseMatrix A = system_of(mesh, -critical_step(mesh));
        EXPECT_THROW(CholeskyAnalysis(A, form).factor(A), SolverError);
    }
}
