// The laws of the operators on the real meshes beside the project, where they are there.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "geometry/curvature/curvature.h"
#include "geometry/measures/mesh_error.h"
#include "geometry/operator_test_meshes.h"
#include "geometry/smoothing/dirichlet_energy.h"
#include "mesh/mesh_checks.h"
#include "shared_meshes.h"

namespace meshfolio {
namespace {

using namespace testing;

using testing_tools::shared_meshes;

const std::filesystem::path mesh_folder = testing_tools::shared_mesh_folder();

TEST(SharedMeshes, GaussBonnetAreasAndDirichletEnergy) {
    const auto paths = shared_meshes();
    if (paths.empty()) GTEST_SKIP() << "no meshes at " << mesh_folder;
    for (const auto& path : paths) {
        SCOPED_TRACE(path.filename().string());
        const PreparedMesh prepared = prepare_mesh(read_mesh(path));
        const TriangleMesh& mesh = prepared.mesh;
        if (prepared.preflight.manifold()) {
            const double total = angle_deficit(mesh, prepared.topology).sum();
            EXPECT_NEAR(total, 2 * pi * prepared.preflight.euler_characteristic, 1e-14 * mesh.face_count() + 1e-11);
        }
        const double area = surface_area(mesh);
        for (const AreaForm form : {AreaForm::barycentric, AreaForm::mixed, AreaForm::voronoi}) {
            EXPECT_NEAR(vertex_areas(mesh, form).sum() / area, 1, 1e-9) << name_of(form);
        }
        const SparseMatrix C = laplace_beltrami(mesh).C;
        EXPECT_NEAR(dirichlet_energy(C, mesh.X) / area, 1, 1e-9);
        EXPECT_LT((C * Vector::Ones(C.cols())).cwiseAbs().maxCoeff(), 1e-13 * C.coeffs().cwiseAbs().maxCoeff());
    }
}

// Measured independently: plane.obj is exactly flat; ½‖Lx‖ is rounding inside, and 63.6 on the boundary, where it is no curvature.
TEST(SharedMeshes, PlaneIsFlatInsideAndTheBoundaryIsArtefact) {
    const auto path = mesh_folder / "coursework" / "curvatures" / "plane.obj";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no mesh at " << path;
    const PreparedMesh prepared = prepare_mesh(read_mesh(path));
    const LaplaceBeltrami laplacian = laplace_beltrami(prepared.mesh);
    const Vector H = cotangent_mean_curvature(prepared.mesh, prepared.topology, laplacian);
    const Positions Lx = laplacian.M.cwiseInverse().asDiagonal() * (laplacian.C * prepared.mesh.X);
    double inside = 0, boundary = 0;
    for (int v = 0; v < prepared.mesh.vertex_count(); ++v) {
        const bool on_boundary = prepared.topology.on_boundary[static_cast<std::size_t>(v)] != 0;
        EXPECT_EQ(std::isnan(H[v]), on_boundary);
        if (!on_boundary) inside = std::max(inside, std::abs(H[v]));
        if (on_boundary) boundary = std::max(boundary, 0.5 * Lx.row(v).norm());
    }
    EXPECT_LT(inside, 1e-12);
    EXPECT_NEAR(boundary, 63.6, 0.05);
}

}   // namespace
}   // namespace meshfolio
