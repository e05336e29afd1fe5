#include "geometry/operators/cotangent_laplacian.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <limits>

#include "base/errors.h"
#include "geometry/dense_pairs.h"
#include "geometry/operator_test_meshes.h"
#include "geometry/operators/laplace_operator.h"
#include "mesh/mesh_topology.h"

namespace meshfolio {
namespace {

using namespace testing;

constexpr CotangentOptions averaged{.opposite = CotangentOptions::OppositeVertices::mean};
constexpr CotangentOptions clamped{.clamp_negative = true};

SparseMatrix stiffness(const TriangleMesh& mesh, const CotangentOptions& options = {}) { return laplace_beltrami(mesh, {}, options).C; }

double largest_entry(const SparseMatrix& A) { return A.coeffs().cwiseAbs().maxCoeff(); }

double relative_difference(const SparseMatrix& A, const SparseMatrix& B) {
    return DenseMatrix(A - B).cwiseAbs().maxCoeff() / largest_entry(B);
}

double smallest_off_diagonal(const SparseMatrix& C) {
    double smallest = std::numeric_limits<double>::infinity();
    for (Eigen::Index j = 0; j < C.outerSize(); ++j) {
        for (SparseMatrix::InnerIterator entry(C, j); entry; ++entry) {
            if (entry.row() != entry.col()) smallest = std::min(smallest, entry.value());
        }
    }
    return smallest;
}

/// The definition, entry by entry through a list of triplets.
SparseMatrix stiffness_by_triplets(const TriangleMesh& mesh) {
    std::vector<Eigen::Triplet<double>> entries;
    for (Eigen::Index t = 0; t < mesh.F.rows(); ++t) {
        for (int k = 0; k < 3; ++k) {
            const int i = mesh.F(t, (k + 1) % 3), j = mesh.F(t, (k + 2) % 3);
            const Vector3 u = mesh.X.row(i) - mesh.X.row(mesh.F(t, k)), v = mesh.X.row(j) - mesh.X.row(mesh.F(t, k));
            const double half_cotangent = 0.5 * u.dot(v) / u.cross(v).norm();
            for (const auto& [row, column, sign] : {std::tuple{i, j, 1}, {j, i, 1}, {i, i, -1}, {j, j, -1}}) {
                entries.emplace_back(row, column, sign * half_cotangent);
            }
        }
    }
    SparseMatrix C(mesh.X.rows(), mesh.X.rows());
    C.setFromTriplets(entries.begin(), entries.end());
    return C;
}

TEST(CotangentLaplacian, EquilateralTriangle) {
    const SparseMatrix C = stiffness(triangle({0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0}));
    const double weight = 0.5 / std::sqrt(3.0);   // ½ cot 60°
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) EXPECT_NEAR(C.coeff(i, j), i == j ? -2 * weight : weight, 1e-15);
    }
}

TEST(CotangentLaplacian, WeightsBelongToTheOppositeCorner) {
    const SparseMatrix C = stiffness(triangle({0, 0, 0}, {4, 0, 0}, {0, 3, 0}));
    EXPECT_NEAR(C.coeff(1, 2), 0, 1e-15);
    EXPECT_NEAR(C.coeff(0, 2), 0.5 * 4.0 / 3, 1e-15);
    EXPECT_NEAR(C.coeff(0, 1), 0.5 * 3.0 / 4, 1e-15);
}

TEST(CotangentLaplacian, IsTheSumOfItsTriangles) {
    for (const TriangleMesh& mesh : {irregular_sphere(2), irregular_plane(7), cube_mesh(3), fan(200, 0.2)}) {
        EXPECT_LT(relative_difference(stiffness(mesh), stiffness_by_triplets(mesh)), 1e-14);
    }
}

TEST(CotangentLaplacian, ColumnsAreSortedAndHaveTheirDiagonal) {
    for (const TriangleMesh& mesh : {irregular_sphere(2), fan(200), with_shuffled_vertices(fan(200)).mesh}) {
        const SparseMatrix C = stiffness(mesh);
        ASSERT_TRUE(C.isCompressed());
        EXPECT_EQ(C.nonZeros(), mesh.X.rows() + 2 * static_cast<Eigen::Index>(topology_of(mesh).edges.size()));
        for (Eigen::Index j = 0; j < C.cols(); ++j) {
            bool diagonal = false;
            for (int place = C.outerIndexPtr()[j]; place < C.outerIndexPtr()[j + 1]; ++place) {
                diagonal = diagonal || C.innerIndexPtr()[place] == j;
                EXPECT_TRUE(place == C.outerIndexPtr()[j] || C.innerIndexPtr()[place - 1] < C.innerIndexPtr()[place]);
            }
            EXPECT_TRUE(diagonal) << j;
        }
    }
}

TEST(CotangentLaplacian, SymmetricWithRowsThatSumToZero) {
    for (const TriangleMesh& mesh : {irregular_sphere(3), irregular_plane(10), torus_mesh(12, 7, 2, 0.8)}) {
        for (const CotangentOptions& options : {CotangentOptions{}, averaged, clamped}) {
            const SparseMatrix C = stiffness(mesh, options);
            EXPECT_EQ(DenseMatrix(C - SparseMatrix(C.transpose())).cwiseAbs().maxCoeff(), 0);
            EXPECT_LT((C * Vector::Ones(C.cols())).cwiseAbs().maxCoeff(), 1e-14 * largest_entry(C));
        }
    }
}

TEST(CotangentLaplacian, NegativeSemidefiniteEvenWithNegativeWeights) {
    for (const TriangleMesh& mesh : {irregular_sphere(2), irregular_plane(12)}) {
        for (const CotangentOptions& options : {CotangentOptions{}, clamped}) {
            const SparseMatrix C = stiffness(mesh, options);
            const Vector eigenvalues = dense_pairs(DenseMatrix(C)).eigenvalues;
            EXPECT_LT(eigenvalues.maxCoeff(), 1e-13 * -eigenvalues.minCoeff());
            EXPECT_LT(eigenvalues[eigenvalues.size() - 2], -1e-6);   // one zero eigenvalue: the constants
        }
        EXPECT_LT(smallest_off_diagonal(stiffness(mesh)), -0.1);
    }
}

/// Largest |(A x)_i| over interior vertices of the irregular unit plane, x its coordinates.
double planar_residual(const TriangleMesh& mesh, const SparseMatrix& A) {
    const MeshTopology topology = topology_of(mesh);
    const DenseMatrix residual = A * mesh.X;
    double largest = 0;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        if (!topology.on_boundary[static_cast<std::size_t>(v)]) largest = std::max(largest, residual.row(v).norm());
    }
    return largest;
}

TEST(CotangentLaplacian, LinearPrecisionInThePlaneIsLostByClampingAndByEdgeNormalising) {
    const TriangleMesh mesh = irregular_plane(16);
    const LaplaceBeltrami plain = laplace_beltrami(mesh);
    const auto L = [&](const SparseMatrix& C) { return SparseMatrix(plain.M.cwiseInverse().asDiagonal() * C); };
    EXPECT_LT(planar_residual(mesh, L(plain.C)), 1e-10);   // of entries up to 1e5
    EXPECT_GT(planar_residual(mesh, L(stiffness(mesh, clamped))), 1);
    EXPECT_GT(planar_residual(mesh, edge_normalised_laplacian(mesh, false)), 1);
    EXPECT_GT(planar_residual(mesh, edge_normalised_laplacian(mesh, true)), 1);
    EXPECT_LT(planar_residual(mesh, stiffness(mesh, averaged)), 1e-13);   // the same as the sum inside
}

TEST(CotangentLaplacian, ClampingActsOnEdgesNotOnCorners) {
    // Edge 0–1 sees a right and an obtuse corner; edge 0–2 is obtuse on one side, but sharper on the other: it keeps its sum.
    TriangleMesh mesh;
    mesh.X.resize(4, 3);
    mesh.X << 0, 0, 0, 2, 0, 0, 1, 0.5, 0, 1, -4, 0;
    mesh.F.resize(2, 3);
    mesh.F << 0, 1, 2, 1, 0, 3;
    const double obtuse = (0.25 - 1) / 1.0, sharp = (16 - 1) / 8.0;
    EXPECT_NEAR(stiffness(mesh, clamped).coeff(0, 1), 0.5 * (obtuse + sharp), 1e-14);
    mesh.X(3, 1) = -1;   // a right angle: the sum is negative now
    EXPECT_NEAR(stiffness(mesh).coeff(0, 1), 0.5 * obtuse, 1e-14);
    EXPECT_EQ(stiffness(mesh, clamped).coeff(0, 1), 0);
    EXPECT_EQ(stiffness(mesh, clamped).coeff(0, 2), stiffness(mesh).coeff(0, 2));
    EXPECT_GE(smallest_off_diagonal(stiffness(irregular_sphere(2), clamped)), 0);
}

TEST(CotangentLaplacian, MeanOverOppositeVerticesDoublesTheBoundary) {
    const TriangleMesh mesh = irregular_plane(6);
    const SparseMatrix sum = stiffness(mesh), mean = stiffness(mesh, averaged);
    for (const Edge& edge : topology_of(mesh).edges) {
        EXPECT_NEAR(mean.coeff(edge.a, edge.b), (edge.faces == 1 ? 2 : 1) * sum.coeff(edge.a, edge.b), 1e-14);
    }
}

TEST(CotangentLaplacian, NonManifoldEdgeHasAllItsOppositeVertices) {
    TriangleMesh mesh;   // three wings on the edge 0–1 with opposite angles 90°, 2·atan ½ and 2·atan ¼
    mesh.X.resize(5, 3);
    mesh.X << -1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 2, 0, -4, 0;
    mesh.F.resize(3, 3);
    mesh.F << 0, 1, 2, 0, 1, 3, 0, 1, 4;
    const double cotangents = 0 + 3.0 / 4 + 15.0 / 8;
    EXPECT_NEAR(stiffness(mesh).coeff(0, 1), cotangents / 2, 1e-15);
    EXPECT_NEAR(stiffness(mesh, averaged).coeff(0, 1), cotangents / 3, 1e-15);
}

TEST(CotangentLaplacian, IsIntrinsic) {
    const TriangleMesh mesh = irregular_sphere(3);
    const CornerValues lengths = edge_lengths(mesh);
    const CornerValues difference = corner_cotangents(lengths) - corner_cotangents(mesh);
    EXPECT_LT(difference.cwiseAbs().maxCoeff(), 1e-12 * corner_cotangents(mesh).cwiseAbs2().maxCoeff());
    for (const AreaForm area : {AreaForm::barycentric, AreaForm::mixed}) {
        const LaplaceBeltrami intrinsic = laplace_beltrami(mesh.F, mesh.vertex_count(), lengths, area);
        const LaplaceBeltrami extrinsic = laplace_beltrami(mesh, area);
        EXPECT_LT(relative_difference(intrinsic.C, extrinsic.C), 1e-11);
        EXPECT_LT(largest_relative_difference(intrinsic.M, extrinsic.M), 1e-12);
    }
}

/// −C times the wave cos(2π(pi/nx + qj/ny)) on a flat torus of unit parallelograms, divided by the wave where that is 1.
double wave_eigenvalue(const FlatTorus& torus, int nx, int ny, int p, int q, double* residual) {
    const SparseMatrix C = cotangent_stiffness(torus.F, torus.vertex_count, corner_cotangents(torus.lengths));
    Vector wave(nx * ny);
    for (int j = 0; j < ny; ++j) {
        for (int i = 0; i < nx; ++i) wave[i + nx * j] = std::cos(2 * pi * (double(p) * i / nx + double(q) * j / ny));
    }
    const Vector image = -(C * wave);
    *residual = (image - image[0] * wave).cwiseAbs().maxCoeff();
    return image[0];
}

// Squares: horizontal and vertical edges weigh 1, diagonals 0. Also when the torus is so small that two edges join the same two
// vertices or an edge returns to its vertex.
TEST(CotangentLaplacian, FlatTorusOfSquares) {
    for (const auto& [nx, ny] : {std::pair{6, 5}, {3, 3}, {2, 4}, {2, 2}, {2, 1}, {1, 3}, {1, 1}}) {
        const FlatTorus torus = flat_torus(nx, ny, std::sqrt(2.0));
        for (int p = 0; p < nx; ++p) {
            for (int q = 0; q < ny; ++q) {
                double residual = 1;
                const double expected = 4 - 2 * std::cos(2 * pi * p / nx) - 2 * std::cos(2 * pi * q / ny);
                EXPECT_NEAR(wave_eigenvalue(torus, nx, ny, p, q, &residual), expected, 1e-14) << nx << "×" << ny;
                EXPECT_LT(residual, 1e-13);
            }
        }
    }
}

// Equilateral triangles, edge h = 1: six weights 1/√3, M = √3/2, so the wave of largest eigenvalue 9/√3 gives μ_max = 6/h² and
// λ_crit = 2/μ_max = h²/3.
TEST(CotangentLaplacian, HexagonalTorusHasItsLargestStableStepAtAThirdOfTheSquaredEdge) {
    const FlatTorus torus = flat_torus(6, 6, 1);
    double residual = 1;
    const double top = wave_eigenvalue(torus, 6, 6, 2, 4, &residual);
    EXPECT_LT(residual, 1e-13);
    const LaplaceBeltrami laplacian = laplace_beltrami(torus.F, torus.vertex_count, torus.lengths);
    EXPECT_NEAR(2 * laplacian.M[0] / top, 1.0 / 3, 1e-14);
}

TEST(CotangentLaplacian, FollowsMotionScaleAndOrder) {
    const TriangleMesh mesh = irregular_sphere(2);
    const SparseMatrix C = stiffness(mesh);
    EXPECT_LT(relative_difference(stiffness(rotated_and_moved(mesh)), C), 1e-11);
    EXPECT_LT(relative_difference(stiffness(turned_inside_out(mesh)), C), 1e-13);
    for (const double s : {3.0, 1e100, 1e30, 1e-30, 1e-100}) EXPECT_LT(relative_difference(stiffness(scaled(mesh, s)), C), 1e-12) << s;
    const Renamed shuffled = with_shuffled_vertices(mesh);
    const SparseMatrix D = stiffness(shuffled.mesh);
    for (const Edge& edge : topology_of(mesh).edges) {
        const int a = shuffled.name[static_cast<std::size_t>(edge.a)], b = shuffled.name[static_cast<std::size_t>(edge.b)];
        EXPECT_NEAR(D.coeff(a, b), C.coeff(edge.a, edge.b), 1e-13 * largest_entry(C));
    }
}

TEST(CotangentLaplacian, FarFromTheOrigin) {
    TriangleMesh mesh = irregular_sphere(2);
    mesh.X = (mesh.X * 0x1p20).array().round();
    TriangleMesh far = mesh;
    far.X.array() += 0x1p50;   // 1e15, and exact
    EXPECT_EQ(relative_difference(stiffness(far), stiffness(mesh)), 0);
}

TEST(CotangentLaplacian, TrianglesWithoutAreaHaveNoCotangents) {
    const TriangleMesh line = triangle({0, 0, 0}, {1, 0, 0}, {3, 0, 0}), point = triangle({1, 1, 1}, {1, 1, 1}, {1, 1, 1});
    for (const TriangleMesh* mesh : {&line, &point}) EXPECT_EQ(corner_cotangents(*mesh).cwiseAbs().maxCoeff(), 0);
    EXPECT_NEAR(floored_laplace_beltrami(line).C.coeff(1, 2), 0.5 * 3 / 9e-12, 1);
    EXPECT_NEAR(floored_laplace_beltrami(line).C.coeff(0, 2), 0.5 * -2 / 9e-12, 1);
    EXPECT_EQ(DenseMatrix(floored_laplace_beltrami(point).C).cwiseAbs().maxCoeff(), 0);
    EXPECT_GT(corner_cotangents(triangle({0, 0, 0}, {1, 0, 0}, {3, 1e-6, 0}))(0, 0), 1e5);
    CornerValues lengths(2, 3);
    lengths << 1, 2, 4, 3, 4, 5;   // no triangle, and a right one
    const CornerValues cotangents = corner_cotangents(lengths);
    EXPECT_EQ(cotangents.row(0).cwiseAbs().maxCoeff(), 0);
    EXPECT_NEAR(cotangents(1, 0), 4.0 / 3, 1e-15);
    EXPECT_NEAR(cotangents(1, 2), 0, 1e-15);
}

/// Two triangles at an edge and, as the third, one without area: its tip lies on that edge.
TriangleMesh first_of_quad_with_flat_triangle(int triangles) {
    TriangleMesh mesh{Positions(5, 3), Faces(triangles, 3)};
    mesh.X << 0, 0, 0, 1, 0, 0, 0.6, 0.8, 0, 0.4, -0.9, 0, 0.5, 0, 0;
    const int corners[3][3] = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
    for (int t = 0; t < triangles; ++t) mesh.F.row(t) << corners[t][0], corners[t][1], corners[t][2];
    return mesh;
}

// Of every operator made from lengths: C, M and so the spectrum are those of the mesh without the triangle.
TEST(CotangentLaplacian, TrianglesWithoutAreaChangeNoOperator) {
    const TriangleMesh with = first_of_quad_with_flat_triangle(3), without = first_of_quad_with_flat_triangle(2);
    for (const OperatorKind kind :
         {OperatorKind::cotan, OperatorKind::cotan_no_half, OperatorKind::clamped, OperatorKind::edge_normalised}) {
        const LaplaceBeltrami a = laplace_operator(with, kind), b = laplace_operator(without, kind);
        EXPECT_EQ((DenseMatrix(a.C) - DenseMatrix(b.C)).cwiseAbs().maxCoeff(), 0) << operator_entry(kind).name;
        const bool masses_are_areas = kind != OperatorKind::edge_normalised;
        EXPECT_TRUE(!masses_are_areas || a.M == b.M) << operator_entry(kind).name;
        EXPECT_TRUE(DenseMatrix(laplace_operator(with, kind).C).allFinite());
    }
    for (const AreaForm form : {AreaForm::barycentric, AreaForm::voronoi, AreaForm::mixed}) {
        EXPECT_EQ((laplace_beltrami(with, form).M - vertex_areas(without, form)).cwiseAbs().maxCoeff(), 0);
    }
    const LaplaceBeltrami idt = laplace_operator(with, OperatorKind::idt);
    EXPECT_LE(DenseMatrix(idt.C).cwiseAbs().maxCoeff(), 10) << "no weight of a triangle without area";
    EXPECT_NEAR(idt.M.sum(), vertex_areas(without, AreaForm::barycentric).sum(), 1e-12);
}

// Two edges of length 1, the third 2ε: half the sharp angle is asin ε, the others have cot = ε/√(1 − ε²).
TEST(CotangentLaplacian, NeedlesKeepTheirDigits) {
    const double eps = 1e-5;
    const TriangleMesh needle = rotated_and_moved(triangle({0, std::sqrt(1 - eps * eps), 0}, {-eps, 0, 0}, {eps, 0, 0}));
    const CornerValues from_positions = corner_cotangents(needle);
    CornerValues lengths(1, 3);
    lengths << 2 * eps, 1, 1;
    const double sharp = (1 - 2 * eps * eps) / (2 * eps * std::sqrt(1 - eps * eps));
    EXPECT_NEAR(corner_cotangents(lengths)(0, 0) / sharp, 1, 1e-14);
    EXPECT_NEAR(from_positions(0, 0) / sharp, 1, 1e-9);
}

TEST(CotangentLaplacian, UnreferencedVerticesHaveEmptyRows) {
    TriangleMesh mesh = fan(6);
    mesh.X.conservativeResize(9, 3);
    mesh.X.bottomRows(2).setConstant(1e50);
    const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
    EXPECT_EQ(laplacian.C.rows(), 9);
    EXPECT_EQ(laplacian.C.col(8).cwiseAbs().sum(), 0);
    EXPECT_EQ(laplacian.M[8], 0);
    EXPECT_NEAR(laplacian.C.coeff(0, 1), 1 / std::sqrt(3.0), 1e-14);
}

TEST(EdgeNormalisedLaplacian, DividesEachEdgeByItsTwoAreas) {
    const TriangleMesh mesh = irregular_sphere(2);
    const SparseMatrix L = edge_normalised_laplacian(mesh, false), C = stiffness(mesh);
    const Vector A = vertex_areas(mesh, AreaForm::barycentric);
    for (const Edge& edge : topology_of(mesh).edges) {
        EXPECT_NEAR(L.coeff(edge.a, edge.b), 2 * C.coeff(edge.a, edge.b) / (A[edge.a] + A[edge.b]), 1e-12 * largest_entry(L));
    }
    EXPECT_LT((L * Vector::Ones(L.cols())).cwiseAbs().maxCoeff(), 1e-14 * largest_entry(L));
    EXPECT_EQ(DenseMatrix(L - SparseMatrix(L.transpose())).cwiseAbs().maxCoeff(), 0);
    EXPECT_GE(smallest_off_diagonal(edge_normalised_laplacian(mesh)), 0);
    EXPECT_LT(smallest_off_diagonal(L), 0);
}

TEST(CotangentLaplacian, RefusesSizesThatDoNotFit) {
    const TriangleMesh mesh = fan(5);
    const CornerValues cotangents = corner_cotangents(mesh);
    EXPECT_THROW(cotangent_stiffness(mesh.F, 5, cotangents), MeshError);
    EXPECT_THROW(cotangent_stiffness(mesh.F, 6, cotangents.topRows(4)), MeshError);
    Faces negative = mesh.F;
    negative(3, 1) = -1;
    EXPECT_THROW(cotangent_stiffness(negative, 6, cotangents), MeshError);
    CornerValues lengths = edge_lengths(mesh);
    lengths(0, 0) = -1;
    EXPECT_THROW(corner_cotangents(lengths), MeshError);
    EXPECT_THROW(laplace_beltrami(mesh.F, 6, lengths), MeshError);
    lengths(0, 0) = 0;
    EXPECT_NO_THROW(corner_cotangents(lengths)) << "an edge without length is a defect that files have";
}

}   // namespace
}   // namespace meshfolio
