#include "geometry/denoising/normal_filters.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.h"
#include "geometry/denoising/noisy_mesh.h"
#include "geometry/measures/mesh_error.h"
#include "geometry/operator_test_meshes.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

/// Returns the largest difference of unit normals.
double largest_change(const Positions& a, const Positions& b) { return (a - b).rowwise().norm().maxCoeff(); }

Positions bilateral(const TriangleMesh& mesh, double sigma_r) {
    const Positions N = face_normals(mesh);
    return filtered_normals(normal_kernel(mesh), N, N, sigma_r);
}

}   // namespace

TEST(FaceRings, OfARegularGrid) {
    const TriangleMesh mesh = grid_mesh(6, 6, 1, 1);
    const FaceRings rings = face_rings(mesh);
    int most_by_vertex = 0, most_by_edge = 0;
    for (int t = 0; t < mesh.face_count(); ++t) {
        most_by_vertex = std::max(most_by_vertex, rings.by_vertex.size(t));
        most_by_edge = std::max(most_by_edge, rings.by_edge.size(t));
        EXPECT_TRUE(std::binary_search(rings.by_vertex.begin(t), rings.by_vertex.end(t), t)) << "itself";
        for (const int* s = rings.by_edge.begin(t); s != rings.by_edge.end(t); ++s) {
            EXPECT_NE(*s, t);
            EXPECT_TRUE(std::binary_search(rings.by_edge.begin(*s), rings.by_edge.end(*s), t)) << "mutual";
        }
    }
    EXPECT_EQ(most_by_vertex, 13);   // three vertices of valence 6: 3·6 − 5 counted twice or more
    EXPECT_EQ(most_by_edge, 3);
}

TEST(NormalFilters, EqualNormalsStayAndWeightsAreAsWritten) {
    // Two triangles that meet at a right angle; all weights can be written down.
    TriangleMesh hinge;
    hinge.X.resize(4, 3);
    hinge.X << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 2;
    hinge.F.resize(2, 3);
    hinge.F << 0, 1, 2, 0, 3, 1;   // normals +z and +y, areas ½ and 1
    const double sigma_r = 0.9, near = std::exp(-0.5), alike = std::exp(-0.5 * 2 / (sigma_r * sigma_r));
    const Vector3 expected0 = Vector3(0, near * alike * 1, 0.5).normalized(), expected1 = Vector3(0, 1, near * alike * 0.5).normalized();
    const Positions filtered = bilateral(hinge, sigma_r);
    EXPECT_LT((filtered.row(0).transpose() - expected0).norm(), 1e-15);
    EXPECT_LT((filtered.row(1).transpose() - expected1).norm(), 1e-15);
    EXPECT_LT(largest_change(bilateral(irregular_plane(8), 0.3), face_normals(irregular_plane(8))), 1e-15);
}

TEST(NormalFilters, SharpEdgesStayWhenSigmaIsSmall) {
    const TriangleMesh cube = cube_mesh(6);
    const Positions N = face_normals(cube);
    EXPECT_LT(largest_change(bilateral(cube, 0.2), N), 1e-9);   // e^(−½·2/0.04) = 1.4e-11
    EXPECT_GT(largest_change(bilateral(cube, 2), N), 0.3) << "and are averaged away when it is not";
    const FaceRings rings = face_rings(cube);
    EXPECT_LT(largest_change(guiding_normals(cube, rings, N), N), 1e-15) << "every face lies in a patch of its own side";
}

TEST(NormalFilters, TheGuideIsThatOfTheMostConsistentPatchByTheFormula) {
    const TriangleMesh mesh = noisy(cube_mesh(3), 0.12);
    const Positions N = face_normals(mesh);
    const Vector areas = face_areas(mesh);
    const auto shared = [&](int s, int t) {
        int count = 0;
        for (const int v : mesh.F.row(s)) count += (mesh.F.row(t).array() == v).any();
        return count;
    };
    const int m = mesh.face_count();
    Vector H(m);
    Positions mean(m, 3);
    for (int t = 0; t < m; ++t) {
        double spread = 0, largest = 0, sum = 0;
        Eigen::RowVector3d n = Eigen::RowVector3d::Zero();
        for (int r = 0; r < m; ++r) {
            if (shared(r, t) == 0) continue;
            n += areas[r] * N.row(r);
            for (int s = 0; s < r; ++s) {
                if (shared(s, t) == 0) continue;
                const double difference = (N.row(r) - N.row(s)).norm();
                spread = std::max(spread, difference);
                if (shared(r, s) < 2) continue;
                largest = std::max(largest, difference);
                sum += difference;
            }
        }
        H[t] = spread * largest / (1e-9 + sum);
        mean.row(t) = n.normalized();
    }
    const Positions guide = guiding_normals(mesh, face_rings(mesh), N);
    for (int t = 0; t < m; ++t) {
        int best = t;
        for (int s = 0; s < m; ++s) best = shared(s, t) > 0 && H[s] < H[best] ? s : best;
        EXPECT_LT((guide.row(t) - mean.row(best)).norm(), 1e-12) << t;
    }
}

TEST(NormalFilters, TheGuideIsNearerToTheTruthThanTheNormals) {
    const TriangleMesh cube = cube_mesh(8), spoilt = noisy(cube, 0.15);
    const Positions truth = face_normals(cube), N = face_normals(spoilt);
    const Positions guide = guiding_normals(spoilt, face_rings(spoilt), N);
    EXPECT_LT(mean_normal_angle(truth, guide), 0.6 * mean_normal_angle(truth, N));
}

TEST(NormalFilters, TurnWithTheMeshAndIgnoreItsScale) {
    const TriangleMesh mesh = noisy(ellipsoid_mesh(2, {1, 0.8, 0.5}), 0.1), turned = scaled(rotated_and_moved(mesh), 40);
    EXPECT_LT(largest_change(bilateral(turned, 0.4), bilateral(mesh, 0.4) * some_rotation().transpose()), 1e-12);
    const auto guide = [](const TriangleMesh& m) { return guiding_normals(m, face_rings(m), face_normals(m)); };
    EXPECT_LT(largest_change(guide(turned), guide(mesh) * some_rotation().transpose()), 1e-12);
}

TEST(NormalFilters, SigmaMustBePositive) {
    const TriangleMesh mesh = icosphere(1);
    EXPECT_THROW(bilateral(mesh, 0), MeshError);
    EXPECT_THROW(bilateral(mesh, std::nan("")), MeshError);
}

TEST(NormalFilters, TrianglesWithoutAreaDoNoHarm) {
    TriangleMesh mesh = grid_mesh(4, 4, 1, 1);
    mesh.F.row(3) << mesh.F(3, 0), mesh.F(3, 1), mesh.F(3, 1) + 1;
    mesh.X.row(mesh.F(3, 2)) = mesh.X.row(mesh.F(3, 1));
    const Positions N = face_normals(mesh);
    EXPECT_TRUE(bilateral(mesh, 0.3).allFinite());
    EXPECT_TRUE(guiding_normals(mesh, face_rings(mesh), N).allFinite());
    EXPECT_TRUE(moved_to_normals(mesh, triangles_around(mesh), N, 5).allFinite());
}

TEST(VertexUpdate, VerticesThatFitTheNormalsStay) {
    for (const TriangleMesh& mesh : {cube_mesh(5), irregular_plane(7), icosphere(0)}) {
        const Positions X = moved_to_normals(mesh, triangles_around(mesh), face_normals(mesh), 20);
        // Faces that are flat, and vertices with all faces in planes through them: n · (c − x) = 0.
        EXPECT_LT((X - mesh.X).cwiseAbs().maxCoeff(), 1e-14);
    }
}

TEST(VertexUpdate, OneSweepAsWritten) {
    const TriangleMesh mesh = triangle({0, 0, 0}, {3, 0, 0}, {0, 3, 0});
    const Vector3 n = Vector3(1, 0, 1).normalized();
    const Positions X = moved_to_normals(mesh, triangles_around(mesh), n.transpose(), 1);
    for (int i = 0; i < 3; ++i) {
        const Vector3 x = mesh.X.row(i), expected = x + n * n.dot(Vector3(1, 1, 0) - x);
        EXPECT_LT((X.row(i).transpose() - expected).norm(), 1e-15);
    }
}

TEST(VertexUpdate, LeadsToTheNormalsAskedFor) {
    const TriangleMesh cube = cube_mesh(6), spoilt = noisy(cube, 0.1);
    const Positions truth = face_normals(cube);
    const auto off_after = [&](int sweeps) {
        return mean_normal_angle(truth, face_normals(moved_to(cube, moved_to_normals(spoilt, triangles_around(cube), truth, sweeps))));
    };
    EXPECT_LT(off_after(1), off_after(0));
    EXPECT_LT(off_after(20), 0.2 * off_after(0));
    EXPECT_LT(off_after(200), 0.5 * off_after(20));
}
