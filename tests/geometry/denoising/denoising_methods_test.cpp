#include "geometry/denoising/denoising_methods.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "base/errors.h"
#include "geometry/denoising/component_size.h"
#include "geometry/denoising/noisy_mesh.h"
#include "geometry/denoising/normal_filters.h"
#include "geometry/measures/mesh_error.h"
#include "geometry/operator_test_meshes.h"
#include "geometry/smoothing/laplacian_smoothing.h"
#include "geometry/spectrum/stability.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

DenoisingRun run_alone(const DenoisingInput& input, const DenoisingOptions& options) {
    ImplicitSolver solver;
    return denoise(input, options, solver);
}

/// A parameter that suits the mesh: a tenth of a squared mean edge, half the stable step, a pass band of 0.1, or σ_r of 0.4.
double suiting(DenoisingMethod method, const TriangleMesh& mesh, double largest) {
    if (method == DenoisingMethod::explicit_flow) return 1 / largest;
    if (method == DenoisingMethod::taubin) return 0.1;
    if (filters_normals(method)) return 0.4;
    const double h = mean_edge_length(mesh);
    return 0.1 * h * h;
}

TriangleMesh denoised(DenoisingMethod method, const TriangleMesh& mesh, int steps = 5) {
    const MeshTopology topology = topology_of(mesh);
    const double largest = largest_eigenvalue(laplace_beltrami(mesh)).value;
    DenoisingOptions options;
    options.method = method;
    options.parameter = suiting(method, mesh, largest);
    options.steps = steps;
    const DenoisingRun run = run_alone({mesh, topology, largest}, options);
    EXPECT_EQ(run.steps, steps);
    EXPECT_FALSE(run.ended);
    return moved_to(mesh, run.X);
}

double largest_move(const Positions& a, const Positions& b) { return (a - b).rowwise().norm().maxCoeff(); }

TriangleMesh two_of(const TriangleMesh& a, const TriangleMesh& b) {
    TriangleMesh both{Positions(a.X.rows() + b.X.rows(), 3), Faces(a.F.rows() + b.F.rows(), 3)};
    both.X << a.X, b.X;
    both.F << a.F, b.F.array() + a.vertex_count();
    return both;
}

/// (largest − smallest)/mean distance from the centroid of the surface: 0 for a sphere.
double roundness_defect(const TriangleMesh& mesh) {
    const ComponentSizes sizes = component_sizes(mesh, topology_of(mesh));
    const Vector distance = (mesh.X.rowwise() - sizes.centroid.row(0)).rowwise().norm();
    return (distance.maxCoeff() - distance.minCoeff()) / distance.mean();
}

}   // namespace

TEST(DenoisingMethods, AreKnownByName) {
    std::set<std::string_view> names, titles;
    for (const DenoisingEntry& entry : denoising_list()) {
        EXPECT_TRUE(names.insert(entry.name).second);
        EXPECT_TRUE(titles.insert(entry.title).second);
        EXPECT_EQ(denoising_entry(entry.method).name, entry.name);
    }
    EXPECT_EQ(names.size(), 8u);
}

TEST(DenoisingMethods, MoveAndTurnAndScaleWithTheMesh) {
    const TriangleMesh mesh = noisy(ellipsoid_mesh(2, {1, 0.8, 0.5}), 0.1);
    for (const DenoisingEntry& entry : denoising_list()) {
        const TriangleMesh plain = denoised(entry.method, mesh);
        for (const double s : {40.0, 1e-6}) {
            const TriangleMesh moved = denoised(entry.method, rotated_and_moved(scaled(mesh, s)));
            EXPECT_LT(largest_move(moved.X, rotated_and_moved(scaled(plain, s)).X), 1e-9 * std::max(s, 1e-5)) << entry.name << " " << s;
        }
    }
}

TEST(DenoisingMethods, LessenNoise) {
    const TriangleMesh clean = icosphere(3), spoilt = noisy(clean, 0.15);
    const Positions normals = face_normals(clean);
    for (const DenoisingEntry& entry : denoising_list()) {
        const TriangleMesh better = denoised(entry.method, spoilt, entry.method == DenoisingMethod::taubin ? 20 : 5);
        EXPECT_LT(mean_normal_angle(normals, face_normals(better)), 0.6 * mean_normal_angle(normals, face_normals(spoilt))) << entry.name;
        const bool shrinks = entry.method == DenoisingMethod::explicit_flow || entry.method == DenoisingMethod::implicit_flow ||
                             entry.method == DenoisingMethod::rebuilt_flow;
        const bool inflates = entry.method == DenoisingMethod::conformal_flow;   // to the area of the noisy mesh
        const double shape = shape_rms(clean, better.X) / shape_rms(clean, spoilt.X);
        EXPECT_TRUE(shrinks || inflates || shape < 0.75) << entry.name << " " << shape;
    }
}

TEST(DenoisingMethods, DoLittleWithoutNoise) {
    const TriangleMesh sphere = icosphere(3);
    for (const DenoisingEntry& entry : denoising_list())
        EXPECT_LT(largest_move(denoised(entry.method, sphere, 1).X, sphere.X), 0.06 * mean_edge_length(sphere)) << entry.name;
}

TEST(DenoisingMethods, PlanesStayPlanesInsideWhateverTheirTriangles) {
    const TriangleMesh plane = irregular_plane(10);
    const MeshTopology topology = topology_of(plane);
    for (const DenoisingEntry& entry : denoising_list()) {
        if (!is_defined(entry.method, plane, topology)) continue;
        const TriangleMesh after = denoised(entry.method, plane, 1);
        EXPECT_LT(after.X.col(2).cwiseAbs().maxCoeff(), 1e-14) << entry.name;
        if (!filters_normals(entry.method)) continue;
        EXPECT_LT(largest_move(after.X, plane.X), 1e-14) << entry.name << ": nothing to do";
    }
}

TEST(DenoisingMethods, FiltersOfNormalsKeepTheEdgesOfACubeAndDiffusionRoundsThem) {
    const TriangleMesh cube = cube_mesh(6);
    const MeshTopology topology = topology_of(cube);
    const double largest = largest_eigenvalue(laplace_beltrami(cube)).value, h = mean_edge_length(cube);
    for (const DenoisingEntry& entry : denoising_list()) {
        DenoisingOptions options;
        options.method = entry.method;
        options.parameter = filters_normals(entry.method) ? 0.2 : suiting(entry.method, cube, largest);
        options.steps = 10;
        const double moved = largest_move(run_alone({cube, topology, largest}, options).X, cube.X);
        if (filters_normals(entry.method)) {
            EXPECT_LT(moved, 1e-8 * h) << entry.name;
        } else {
            EXPECT_GT(moved, 0.1 * h) << entry.name;
        }
    }
}

TEST(DenoisingMethods, FlowsAreThoseOfSmooth) {
    const TriangleMesh mesh = noisy(icosphere(2), 0.1);
    const double largest = largest_eigenvalue(laplace_beltrami(mesh)).value;
    SmoothingOptions options;
    options.iterations = 5;
    options.lambda = 1 / largest;
    EXPECT_LT(largest_move(denoised(DenoisingMethod::explicit_flow, mesh).X, smooth(mesh, options).X), 1e-13);
    options.scheme = SmoothingScheme::taubin;
    EXPECT_LT(largest_move(denoised(DenoisingMethod::taubin, mesh).X, smooth(mesh, options).X), 1e-10) << "pass band 0.1 is the default";
    options.scheme = SmoothingScheme::implicit_euler;
    options.lambda = suiting(DenoisingMethod::implicit_flow, mesh, largest);
    EXPECT_LT(largest_move(denoised(DenoisingMethod::implicit_flow, mesh).X, smooth(mesh, options).X), 1e-13);
    options.rebuild = true;
    EXPECT_LT(largest_move(denoised(DenoisingMethod::rebuilt_flow, mesh).X, smooth(mesh, options).X), 1e-13);
}

TEST(DenoisingMethods, FiltersOfNormalsAreTheirPiecesInTurn) {
    const TriangleMesh mesh = noisy(cube_mesh(4), 0.15);
    const Incidence around = triangles_around(mesh);
    TriangleMesh bilateral = mesh, guided = mesh;
    const NormalKernel kernel = normal_kernel(mesh);   // that of the input throughout
    Positions N = face_normals(mesh);
    for (int step = 0; step < 3; ++step) {
        N = filtered_normals(kernel, N, N, 0.4);   // of themselves again and again
        bilateral.X = moved_to_normals(bilateral, around, N, 10);
        const Positions now = face_normals(guided);   // of the mesh as it has become, and so is the kernel
        const NormalKernel own = normal_kernel(guided);
        guided.X = moved_to_normals(guided, around, filtered_normals(own, now, guiding_normals(guided, own.rings, now), 0.4), 10);
    }
    EXPECT_LT(largest_move(denoised(DenoisingMethod::bilateral_normals, mesh, 3).X, bilateral.X), 1e-12);
    EXPECT_LT(largest_move(denoised(DenoisingMethod::guided_normals, mesh, 3).X, guided.X), 1e-12);
}

TEST(VolumeRescaling, KeepsTheVolumeOfEveryComponentAndWhereItIs) {
    TriangleMesh second = scaled(cube_mesh(4), 0.5);
    second.X.col(0).array() += 4;
    const TriangleMesh both = noisy(two_of(ellipsoid_mesh(2, {1, 0.8, 0.5}), second), 0.1);
    const MeshTopology topology = topology_of(both);
    const ComponentSizes before = component_sizes(both, topology);
    ASSERT_EQ(before.volume.size(), 2);
    EXPECT_NEAR(before.volume[1], 0.125, 0.02);
    const TriangleMesh shrunk = denoised(DenoisingMethod::implicit_flow, both);
    EXPECT_LT(component_sizes(shrunk, topology).volume[1], 0.95 * before.volume[1]) << "diffusion alone does not";
    const ComponentSizes after = component_sizes(denoised(DenoisingMethod::volume_rescaled, both), topology);
    EXPECT_LT((after.volume - before.volume).cwiseQuotient(before.volume).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT((after.centroid - before.centroid).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(VolumeRescaling, AfterEveryStepIsTheSameAsAtTheEnd) {
    const TriangleMesh mesh = noisy(ellipsoid_mesh(2, {1, 0.8, 0.5}), 0.1);
    const MeshTopology topology = topology_of(mesh);
    const ComponentSizes wanted = component_sizes(mesh, topology);
    const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
    Positions X = mesh.X;
    for (int step = 0; step < 5; ++step) {
        X = with_volumes(moved_to(mesh, implicit_step(laplacian, suiting(DenoisingMethod::volume_rescaled, mesh, 1), X)), topology, wanted);
    }
    EXPECT_LT(largest_move(denoised(DenoisingMethod::volume_rescaled, mesh).X, X), 1e-12);
}

TEST(VolumeRescaling, NeedsAVolume) {
    const TriangleMesh open = irregular_plane(4), closed = icosphere(1);
    EXPECT_FALSE(is_defined(DenoisingMethod::volume_rescaled, open, topology_of(open)));
    TriangleMesh one_sided = torus_mesh(9, 7, 1, 0.4);   // closed, but a triangle disagrees: no volume, as on a Klein bottle
    std::swap(one_sided.F(0, 0), one_sided.F(0, 1));
    EXPECT_FALSE(is_defined(DenoisingMethod::volume_rescaled, one_sided, topology_of(one_sided)));
    EXPECT_TRUE(is_defined(DenoisingMethod::volume_rescaled, closed, topology_of(closed)));
    EXPECT_FALSE(is_defined(DenoisingMethod::volume_rescaled, two_of(closed, open), topology_of(two_of(closed, open))));
    DenoisingOptions options;
    options.method = DenoisingMethod::volume_rescaled;
    options.parameter = 1;
    EXPECT_THROW(run_alone({open, topology_of(open)}, options), MeshError);
    const ComponentSizes wanted = component_sizes(open, topology_of(open));
    EXPECT_EQ(with_volumes(scaled(open, 2), topology_of(open), wanted), scaled(open, 2).X) << "what has none stays";
}

TEST(ComponentSizes, OfACubeAndASheet) {
    TriangleMesh cube = cube_mesh(3, 1);
    cube.X.col(1).array() += 7;
    const TriangleMesh both = two_of(cube, grid_mesh(4, 4, 2, 1));
    const ComponentSizes sizes = component_sizes(both, topology_of(both));
    EXPECT_NEAR(sizes.area[0], 24, 1e-12);
    EXPECT_NEAR(sizes.area[1], 2, 1e-12);
    EXPECT_NEAR(sizes.volume[0], 8, 1e-12);
    EXPECT_TRUE(std::isnan(sizes.volume[1]));
    EXPECT_LT((sizes.centroid.row(0) - Eigen::RowVector3d(0, 7, 0)).norm(), 1e-12);
    EXPECT_LT((sizes.centroid.row(1) - Eigen::RowVector3d(1, 0.5, 0)).norm(), 1e-12);
}

TEST(ConformalFlow, OneStepAsWritten) {
    const TriangleMesh mesh = noisy(ellipsoid_mesh(2, {1, 0.8, 0.5}), 0.1);
    const MeshTopology topology = topology_of(mesh);
    const ComponentSizes wanted = component_sizes(mesh, topology);
    LaplaceBeltrami laplacian = laplace_beltrami(mesh);
    const double lambda = suiting(DenoisingMethod::conformal_flow, mesh, 1);
    TriangleMesh current = mesh;
    for (int step = 0; step < 3; ++step) {
        laplacian.M = vertex_areas(current, AreaForm::barycentric);   // C stays that of the input
        current.X = implicit_step(laplacian, lambda, current.X);
        current.X = with_areas(current, topology, wanted);
    }
    EXPECT_LT(largest_move(denoised(DenoisingMethod::conformal_flow, mesh, 3).X, current.X), 1e-12);
    EXPECT_NEAR(surface_area(current) / surface_area(mesh), 1, 1e-13);
}

TEST(ConformalFlow, LeadsToASphereAsTheTrianglesGetFinerWhereTheRebuiltFlowCollapses) {
    const auto flown = [](const TriangleMesh& mesh, DenoisingMethod method) {
        DenoisingOptions options;
        options.method = method;
        options.parameter = 0.01 * surface_area(mesh);
        options.steps = 60;
        return run_alone({mesh, topology_of(mesh)}, options);
    };
    const auto defect = [&](const TriangleMesh& mesh) {
        const DenoisingRun run = flown(mesh, DenoisingMethod::conformal_flow);
        EXPECT_EQ(run.steps, 60);
        EXPECT_NEAR(surface_area(moved_to(mesh, run.X)) / surface_area(mesh), 1, 1e-12);
        return roundness_defect(moved_to(mesh, run.X));
    };
    // The remaining error comes from the size of the triangles: it falls with its square.
    const double coarse_cube = defect(cube_mesh(5)), fine_cube = defect(cube_mesh(10));
    EXPECT_LT(fine_cube, 0.02);
    EXPECT_NEAR(coarse_cube / fine_cube, 4, 0.6);
    EXPECT_GT(roundness_defect(cube_mesh(10)), 0.5);
    const double coarse = defect(ellipsoid_mesh(3, {2, 1, 0.7})), fine = defect(ellipsoid_mesh(4, {2, 1, 0.7}));
    EXPECT_LT(fine, 0.025);
    EXPECT_NEAR(coarse / fine, 4, 0.6);
    try {
        EXPECT_TRUE(flown(ellipsoid_mesh(3, {2, 1, 0.7}), DenoisingMethod::rebuilt_flow).ended);
    } catch (const SolverError&) {   // nothing is left that could be factored
    }
}

TEST(DenoisingMethods, StopWhenTheCallbackReturnsFalse) {
    const TriangleMesh mesh = noisy(icosphere(2), 0.1);
    const double largest = largest_eigenvalue(laplace_beltrami(mesh)).value;
    const MeshTopology topology = topology_of(mesh);
    for (const DenoisingEntry& entry : denoising_list()) {
        DenoisingOptions options;
        options.method = entry.method;
        options.parameter = suiting(entry.method, mesh, largest);
        options.steps = 9;
        std::vector<int> told;
        Positions last;
        options.after_step = [&](int step, const Positions& X) {
            told.push_back(step);
            last = X;
            return step < 3;
        };
        const DenoisingRun run = run_alone({mesh, topology, largest}, options);
        EXPECT_EQ(told, (std::vector{1, 2, 3})) << entry.name;
        EXPECT_EQ(run.steps, 3) << entry.name;
        EXPECT_LT(largest_move(run.X, last), 1e-14) << entry.name;
    }
}

TEST(DenoisingMethods, ImpossibleSettingsAreRefused) {
    const TriangleMesh mesh = icosphere(1);
    const MeshTopology topology = topology_of(mesh);
    for (const DenoisingEntry& entry : denoising_list()) {
        DenoisingOptions options;
        options.method = entry.method;
        for (const double wrong : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
            options.parameter = wrong;
            EXPECT_THROW(run_alone({mesh, topology, 100}, options), MeshError) << entry.name << " " << wrong;
        }
        options.parameter = 0.1;
        options.steps = -1;
        EXPECT_THROW(run_alone({mesh, topology, 100}, options), MeshError) << entry.name;
        options.steps = 0;
        EXPECT_EQ(run_alone({mesh, topology, 100}, options).X, mesh.X) << entry.name << ": no step, no change";
    }
    DenoisingOptions taubin;
    taubin.method = DenoisingMethod::taubin;
    taubin.parameter = 0.1;
    EXPECT_THROW(run_alone({mesh, topology}, taubin), MeshError) << "without μ_max";
}
