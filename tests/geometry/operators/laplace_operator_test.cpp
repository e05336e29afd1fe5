#include "geometry/operators/laplace_operator.h"

#include <gtest/gtest.h>

#include <set>

#include "base/errors.h"
#include "geometry/operators/uniform_laplacian.h"
#include "geometry/operators/vertices_with_mass.h"
#include "geometry/smoothing/laplacian_smoothing.h"
#include "geometry/solver_test_meshes.h"
#include "geometry/spectrum/stability.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

DenseMatrix dense_L(const LaplaceBeltrami& laplacian) { return laplacian.M.cwiseInverse().asDiagonal() * DenseMatrix(laplacian.C); }

}   // namespace

TEST(LaplaceOperator, NamesRoundTrip) {
    std::set<std::string_view> names, titles;
    for (const OperatorEntry& entry : operator_list()) {
        EXPECT_EQ(operator_named(std::string(entry.name)), entry.kind);
        EXPECT_EQ(operator_entry(entry.kind).name, entry.name);
        EXPECT_TRUE(names.insert(entry.name).second && titles.insert(entry.title).second) << entry.name;
        EXPECT_TRUE(entry.description.ends_with('.')) << entry.name;
    }
    EXPECT_EQ(operator_list().front().kind, OperatorKind::cotan) << "the default comes first";
}

TEST(LaplaceOperator, UnknownNamesAreRefusedWithTheNearest) {
    for (const char* name : {"", "Cotan", "cotangent", "unifrom"}) EXPECT_THROW(operator_named(name), UsageError) << name;
    try {
        operator_named("clampd");
        FAIL();
    } catch (const UsageError& error) {
        EXPECT_NE(std::string(error.what()).find("did you mean 'clamped'"), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("cotan, uniform, cotan-no-half, clamped"), std::string::npos) << error.what();
    }
}

TEST(LaplaceOperator, EveryKindKillsConstantsAndHasMassWhereThereAreTriangles) {
    const TriangleMesh mesh =
        with_unreferenced_vertex(side_by_side(irregular_sphere(2), moved_by(irregular_plane(6), {4, 0, 0})), {9, 9, 9});
    for (const OperatorEntry& entry : operator_list()) {
        const LaplaceBeltrami laplacian = laplace_operator(mesh, entry.kind);
        const double largest = DenseMatrix(laplacian.C).cwiseAbs().maxCoeff();
        EXPECT_LT((laplacian.C * Vector::Ones(mesh.vertex_count())).cwiseAbs().maxCoeff(), 1e-12 * largest) << entry.name;
        EXPECT_EQ(laplacian.M[0], 0) << entry.name;
        EXPECT_GT(laplacian.M.tail(mesh.vertex_count() - 1).minCoeff(), 0) << entry.name;
        EXPECT_NO_THROW(operator_with_mass(laplacian)) << entry.name;
    }
}

TEST(LaplaceOperator, EachIsWhatItsNameSays) {
    const TriangleMesh mesh = irregular_plane(6);
    const LaplaceBeltrami cotan = laplace_operator(mesh, OperatorKind::cotan);
    const auto L = [&](OperatorKind kind) { return dense_L(laplace_operator(mesh, kind)); };
    EXPECT_LT((L(OperatorKind::uniform) - DenseMatrix(uniform_laplacian(topology_of(mesh)))).cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_LT((L(OperatorKind::cotan_no_half) - 2 * dense_L(cotan)).cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_LT((L(OperatorKind::edge_normalised) - DenseMatrix(edge_normalised_laplacian(mesh))).cwiseAbs().maxCoeff(), 1e-15);

    const SparseMatrix clamped = laplace_operator(mesh, OperatorKind::clamped).C;
    const SparseMatrix mean = laplace_operator(mesh, OperatorKind::opposite_mean).C;
    const MeshTopology topology = topology_of(mesh);
    int negative = 0;
    for (int j = 0; j < mesh.vertex_count(); ++j) {
        for (const int* i = topology.neighbours.begin(j); i != topology.neighbours.end(j); ++i) {
            const double weight = cotan.C.coeff(*i, j);
            const bool both_on_boundary =
                topology.on_boundary[static_cast<std::size_t>(j)] != 0 && topology.on_boundary[static_cast<std::size_t>(*i)] != 0;
            negative += weight < 0 ? 1 : 0;
            EXPECT_EQ(clamped.coeff(*i, j), std::max(weight, 0.0));
            if (both_on_boundary) continue;
            EXPECT_NEAR(mean.coeff(*i, j), weight, 1e-14) << "two opposite vertices: the mean is half the sum";
        }
    }
    EXPECT_GT(negative, 0) << "the mesh is irregular enough to tell";
    EXPECT_GT((mean - cotan.C).norm(), 0.1) << "boundary weights double";
}

TEST(LaplaceOperator, AreasOfAllFormsAreTheMasses) {
    const TriangleMesh mesh = irregular_sphere(2);
    for (const AreaForm form : {AreaForm::barycentric, AreaForm::voronoi, AreaForm::mixed}) {
        for (const OperatorKind kind :
             {OperatorKind::cotan, OperatorKind::cotan_no_half, OperatorKind::clamped, OperatorKind::opposite_mean})
            EXPECT_EQ(laplace_operator(mesh, kind, form).M, vertex_areas(mesh, form));
    }
}

// λ is an area, but for the uniform operator: scaled meshes take scaled steps.
TEST(LaplaceOperator, SmoothingStepsHaveTheUnitOfTheOperator) {
    const TriangleMesh mesh = side_by_side(irregular_sphere(2), moved_by(irregular_plane(6), {4, 0, 0}));
    constexpr double s = 1e-3;
    for (const OperatorEntry& entry : operator_list()) {
        for (const SmoothingScheme scheme : {SmoothingScheme::explicit_euler, SmoothingScheme::implicit_euler, SmoothingScheme::taubin}) {
            for (const bool rebuild : {false, true}) {
                SmoothingOptions options{.scheme = scheme, .laplacian = entry.kind, .lambda = 1e-4, .iterations = 3, .rebuild = rebuild};
                const Positions X = smooth(mesh, options).X;
                if (!is_dimensionless(entry.kind)) options.lambda *= s * s;
                EXPECT_LT((smooth(scaled(mesh, s), options).X / s - X).cwiseAbs().maxCoeff(), 1e-11) << entry.name << " " << rebuild;
            }
        }
        const SmoothingOptions one{.laplacian = entry.kind, .lambda = 1e-4};
        const Positions expected = mesh.X + 1e-4 * (dense_L(laplace_operator(mesh, entry.kind)) * mesh.X);
        EXPECT_LT((smooth(mesh, one).X - expected).cwiseAbs().maxCoeff(), 1e-13) << entry.name;
    }
}

TEST(LaplaceOperator, MeanCurvatureOfTheSphere) {
    const TriangleMesh mesh = icosphere(3);
    const MeshTopology topology = topology_of(mesh);
    for (const OperatorEntry& entry : operator_list()) {
        const Vector H = operator_mean_curvature(mesh, topology, entry.kind, laplace_operator(mesh, entry.kind));
        const double tolerance = entry.kind == OperatorKind::uniform ? 0.3 : 0.03;   // the uniform one drifts along the surface
        EXPECT_NEAR(H.mean(), entry.kind == OperatorKind::cotan_no_half ? 2 : 1, tolerance) << entry.name;
        const TriangleMesh larger = scaled(mesh, 5);
        const Vector smaller = operator_mean_curvature(larger, topology, entry.kind, laplace_operator(larger, entry.kind));
        EXPECT_LT((5 * smaller - H).cwiseAbs().maxCoeff(), 1e-9) << entry.name << ": curvature is 1/length";
    }
}

// Mesh, ratio to the default of idt and of idt-original-mass, as measured by other means.
TEST(LaplaceOperator, LimitsOfIntrinsicDelaunayOnTheSharedMeshes) {
    struct Known {
        const char* file;
        double idt, own_areas;
    };
    for (const Known& known : {Known{"classic/cow.off", 6.5, 7.1}, Known{"coursework/smoothing/fandisk_ns.obj", 1.09, 1.57},
                               Known{"coursework/decompose/armadillo.obj", 0.85, 1.34}, Known{"classic/bunny.off", 0.60, 1.87}}) {
        SHARED_MESH_OR_SKIP(mesh, known.file);
        const auto limit = [&](OperatorKind kind) { return largest_stable_step(largest_eigenvalue(laplace_operator(mesh, kind))); };
        const double standard = limit(OperatorKind::cotan);
        EXPECT_NEAR(limit(OperatorKind::idt) / standard / known.idt, 1, 0.01) << known.file;
        EXPECT_NEAR(limit(OperatorKind::idt_original_mass) / standard / known.own_areas, 1, 0.01) << known.file;
    }
}
