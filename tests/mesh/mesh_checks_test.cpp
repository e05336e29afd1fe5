#include "mesh/mesh_checks.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "base/errors.h"
#include "mesh/io/rejections.h"
#include "mesh/orientation.h"
#include "mesh/random_triangles.h"
#include "mesh/small_meshes.h"
#include "mesh/triangle_measures.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

/// Returns the mesh as if read from a file with one face per line, from line 101 on.
LoadedMesh loaded(const TriangleMesh& mesh) {
    LoadedMesh result{mesh, "m.obj", {}, {}};
    for (int t = 0; t < mesh.face_count(); ++t) result.face_lines.push_back(101 + t);
    return result;
}

PreparedMesh prepared(const TriangleMesh& mesh) { return prepare_mesh(loaded(mesh)); }

std::string warnings_of(const PreparedMesh& mesh) { return meshfolio::testing::warnings_of(LoadedMesh{{}, "", {}, mesh.warnings}); }

TriangleMesh with_face(TriangleMesh mesh, int a, int b, int c) {
    mesh.F.conservativeResize(mesh.F.rows() + 1, 3);
    mesh.F.bottomRows(1) << a, b, c;
    return mesh;
}

void flip(TriangleMesh& mesh, int t) { std::swap(mesh.F(t, 0), mesh.F(t, 1)); }

}   // namespace

TEST(MeshChecks, SoundMeshesPassUnchanged) {
    for (const TriangleMesh& mesh : {tetrahedron(), unit_cube(), torus(9, 7), flat_grid(4, 5)}) {
        const PreparedMesh result = prepared(mesh);
        EXPECT_EQ(result.mesh.F, mesh.F);
        EXPECT_EQ(warnings_of(result), "");
        EXPECT_TRUE(result.preflight.manifold());
        EXPECT_TRUE(result.preflight.orientable);
    }
}

TEST(MeshChecks, CountsOfATorus) {
    const Preflight p = prepared(torus(12, 8)).preflight;
    EXPECT_EQ(p.vertices, 96);
    EXPECT_EQ(p.triangles, 192);
    EXPECT_EQ(p.edges, 288);
    EXPECT_EQ(p.euler_characteristic, 0);
    EXPECT_EQ(p.genus, 1);
    EXPECT_TRUE(p.closed());
    EXPECT_NEAR(p.area, surface_area(torus(12, 8)), 1e-12);
    EXPECT_NEAR(p.mean_edge, mean_edge_length(torus(12, 8)), 1e-14);
    EXPECT_EQ(p.box_high.x(), 2.5);
}

TEST(MeshChecks, CountsOfOpenMeshes) {
    const Preflight grid = prepared(flat_grid(4, 6)).preflight;
    EXPECT_EQ(grid.euler_characteristic, 1);
    EXPECT_EQ(grid.boundary_edges, 2 * 3 + 2 * 5);
    EXPECT_EQ(grid.boundary_loops, 1);
    EXPECT_EQ(grid.genus, 0);
    EXPECT_FALSE(grid.closed());
}

TEST(MeshChecks, DropsDegenerateAndDuplicateFacesWithTheirLines) {
    TriangleMesh mesh = with_face(with_face(with_face(tetrahedron(), 3, 3, 3), 1, 0, 1), 2, 1, 0);
    mesh = with_face(mesh, 0, 2, 1);
    const PreparedMesh result = prepared(mesh);
    EXPECT_EQ(result.mesh.F, tetrahedron().F);
    EXPECT_EQ(result.preflight.dropped_degenerate_faces, 2);
    EXPECT_EQ(result.preflight.dropped_duplicate_faces, 2);
    EXPECT_EQ(warnings_of(result), "105: 2 degenerate faces (a corner named twice) ignored\n107: 2 duplicate faces ignored\n");
}

TEST(MeshChecks, TurnsTheMinorityAndKeepsTheLines) {
    TriangleMesh mesh = with_face(torus(9, 7), 0, 0, 1);
    mesh.F.row(0).swap(mesh.F.row(mesh.F.rows() - 1));   // dropped first: later lines must not shift
    const Faces right = mesh.F.bottomRows(mesh.F.rows() - 1);
    for (const int t : {20, 5, 77}) flip(mesh, t);
    const PreparedMesh result = prepared(mesh);
    EXPECT_EQ(result.preflight.flipped_faces, 3);
    EXPECT_EQ(result.preflight.inside_out_components, 0);
    EXPECT_GT(result.preflight.volume, 0);
    EXPECT_NE(warnings_of(result).find("106: 3 faces turned"), std::string::npos) << warnings_of(result);
    EXPECT_LT((face_normals(result.mesh) - face_normals({mesh.X, right})).norm(), 1e-12);
}

TEST(MeshChecks, OpenSurfacesKeepTheMajorityOfTheFile) {
    TriangleMesh mesh = flat_grid(5, 5);   // normals +z
    for (int t = 0; t < 20; ++t) flip(mesh, t);
    const PreparedMesh result = prepared(mesh);   // 20 of 32 said −z
    EXPECT_EQ(result.preflight.flipped_faces, 12);
    EXPECT_EQ(face_normals(result.mesh).col(2).maxCoeff(), -1);
    TriangleMesh other = flat_grid(5, 5);
    for (int t = 0; t < 5; ++t) flip(other, t);
    EXPECT_EQ(prepared(other).mesh.F.row(31), flat_grid(5, 5).F.row(31));
    EXPECT_EQ(prepared(other).preflight.flipped_faces, 5);
}

TEST(MeshChecks, ClosedPiecesAreTurnedOutwardsEachOnItsOwn) {
    TriangleMesh other = unit_cube();
    for (int t = 0; t < other.face_count(); ++t) flip(other, t);
    other.X = moved(other.X, {2, 0.25, 0.25}, 0.5);
    const PreparedMesh result = prepared(joined(unit_cube(), other));
    EXPECT_EQ(result.preflight.inside_out_components, 1);
    EXPECT_EQ(result.preflight.flipped_faces, 0);
    EXPECT_EQ(result.preflight.components, 2);
    EXPECT_EQ(result.preflight.genus, -1);
    EXPECT_NEAR(result.preflight.volume, 1.125, 1e-14);
    EXPECT_EQ(warnings_of(result), "113: 1 closed component was inside out (negative volume), reoriented\n");
}

// Both boxes share an edge, which has four triangles; each is closed.
TEST(MeshChecks, ClosedPiecesThatShareAnEdgeAreTurnedOutwardsEachOnItsOwn) {
    TriangleMesh beside = unit_cube();
    for (int t = 0; t < beside.face_count(); ++t) flip(beside, t);
    beside.X = moved(beside.X, {1, 1, 0}, 1);
    TriangleMesh both = joined(unit_cube(), beside);
    for (int corner = 0; corner < both.F.size(); ++corner) {   // the second box takes the first one's vertices where they meet
        int& v = both.F.data()[corner];
        for (int u = 0; u < v; ++u) {
            if (both.X.row(u) == both.X.row(v)) v = u;
        }
    }
    const PreparedMesh result = prepared(both);
    EXPECT_EQ(result.preflight.nonmanifold_edges, 1);
    EXPECT_EQ(result.preflight.inside_out_components, 1);
    EXPECT_NEAR(result.preflight.volume, 2, 1e-14);
}

// Three pages of a book share a spine; none of them encloses a volume in any orientation.
TEST(MeshChecks, PagesOfABookAreNotTurned) {
    TriangleMesh book;
    book.X.resize(5, 3);
    book.X << 0, 0, 0, 0, 0, 1, 1, 0, 0, -1, 1, 0, -1, -1, 0;
    book.F.resize(3, 3);
    book.F << 0, 1, 2, 0, 1, 3, 1, 0, 4;
    const PreparedMesh result = prepared(book);
    EXPECT_EQ(result.preflight.inside_out_components, 0);
    EXPECT_EQ(result.mesh.F, book.F);
}

TEST(MeshChecks, OrientationHoldsFarFromTheOriginAndAtAnyScale) {
    TriangleMesh mesh = unit_cube();
    for (int t = 0; t < mesh.face_count(); ++t) flip(mesh, t);
    for (const auto& [shift, scale] : {std::pair(1e15, 1.0), std::pair(-1e7, 1.0 / 64), std::pair(0.0, 1e-30), std::pair(0.0, 1e99)}) {
        TriangleMesh other = moved_to(mesh, moved(mesh.X, Vector3::Constant(shift), scale));
        EXPECT_GT(prepared(other).preflight.volume, 0) << shift;
        flip(other, 3);
        EXPECT_EQ(prepared(other).preflight.flipped_faces, 1);
    }
}

TEST(MeshChecks, AMoebiusStripIsKeptAndReported) {
    const PreparedMesh result = prepared(moebius_strip(12));
    EXPECT_FALSE(result.preflight.orientable);
    EXPECT_EQ(result.mesh.F, moebius_strip(12).F);
    EXPECT_EQ(result.preflight.genus, -1);
    EXPECT_NE(warnings_of(result).find("no consistent orientation"), std::string::npos);
}

TEST(MeshChecks, NonManifoldPlacesAreCountedAndNamed) {
    const TriangleMesh pages = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
    const PreparedMesh book = prepared(pages);
    EXPECT_EQ(book.preflight.nonmanifold_edges, 1);
    EXPECT_EQ(book.preflight.nonmanifold_vertices, 2);
    EXPECT_EQ(warnings_of(book),
              "0: 1 non-manifold edge (first: 3 faces on vertices 0 and 1, counted from 0); curvature is undefined there\n");
    const PreparedMesh bow_tie = prepared(mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, {{0, 1, 2}, {0, 3, 4}}));
    EXPECT_EQ(bow_tie.preflight.nonmanifold_vertices, 1);
    EXPECT_NE(warnings_of(bow_tie).find("1 non-manifold vertex (first: 0"), std::string::npos);
}

TEST(MeshChecks, CountsUnusedAndCoincidentVertices) {
    TriangleMesh mesh = joined(tetrahedron(), mesh_of({{9, 9, 9}, {-0.0, 0, 0}}, {}));
    mesh = with_face(with_face(mesh, 1, 3, 5), 5, 3, 2);
    const PreparedMesh result = prepared(mesh);
    EXPECT_EQ(result.preflight.vertices, 6);
    EXPECT_EQ(result.preflight.vertices_in_use, 5);
    EXPECT_EQ(result.preflight.duplicated_positions, 1);
    EXPECT_NE(warnings_of(result).find("1 isolated vertex ignored"), std::string::npos);
    EXPECT_EQ(result.mesh.vertex_count(), 6);
}

TEST(MeshChecks, KeepsAndCountsBadShapes) {
    const TriangleMesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1, -1e-3, 0}}, {{0, 1, 3}, {0, 2, 1}, {0, 4, 2}});
    for (const double scale : {1e-40, 1.0, 1e40}) {
        const PreparedMesh result = prepared(moved_to(mesh, moved(mesh.X, Vector3::Zero(), scale)));
        EXPECT_EQ(result.preflight.zero_area_faces, 1);
        EXPECT_EQ(result.preflight.needle_faces, 1);
        EXPECT_EQ(result.preflight.triangles, 3);
        EXPECT_NE(warnings_of(result).find("102: 1 face of no area kept"), std::string::npos);
    }
}

TEST(MeshChecks, RefusesUnusableMeshes) {
    TriangleMesh mesh = tetrahedron();
    EXPECT_THROW(prepared(moved_to(mesh, Positions::Ones(4, 3))), InputError);
    mesh.X(3, 2) = 1.1e100;
    EXPECT_THROW(prepared(mesh), InputError);
    mesh.X(3, 2) = std::nan("");
    EXPECT_THROW(prepared(mesh), InputError);
    EXPECT_THROW(prepared(mesh_of({{0, 0, 0}, {1, 0, 0}}, {{0, 1, 1}})), InputError);
    EXPECT_THROW(prepared(mesh_of({{0, 0, 0}, {1, 0, 0}}, {{0, 1, 2}})), InputError);
}

TEST(MeshChecks, ReadersWarningsComeFirst) {
    LoadedMesh mesh = loaded(with_face(tetrahedron(), 1, 1, 2));
    mesh.warnings.push_back({"of the reader", 7});
    EXPECT_EQ(warnings_of(prepare_mesh(mesh)), "7: of the reader\n105: 1 degenerate face (a corner named twice) ignored\n");
}

TEST(MeshChecks, PicturesGetTheSameRepairsAndWarnings) {
    TriangleMesh bad = joined(unit_cube(), flat_grid(5, 4));
    flip(bad, 3);
    flip(bad, 20);
    bad = with_face(with_face(bad, 0, 0, 1), 2, 0, 1);
    TriangleMesh inside_out = joined(torus(9, 7), torus(5, 4));
    for (int t = 126; t < inside_out.face_count(); ++t) flip(inside_out, t);
    TriangleMesh flat = torus(8, 8);
    flat.X.col(0).setZero();
    std::vector<TriangleMesh> meshes{torus(9, 7), flat_grid(4, 5), moebius_strip(9), bad, inside_out, flat, joined(bad, inside_out)};
    for (unsigned seed = 0; seed < 50; ++seed) meshes.push_back(random_triangles(20, 4 + static_cast<int>(seed), seed));
    for (const TriangleMesh& mesh : meshes) {
        const PreparedMesh all = prepared(mesh), some = prepare_mesh(loaded(mesh), Checks::for_pictures);
        EXPECT_EQ(all.mesh.F, some.mesh.F);
        EXPECT_EQ(warnings_of(all), warnings_of(some));
        EXPECT_EQ(all.preflight.vertices_in_use, some.preflight.vertices_in_use);
        EXPECT_EQ(all.preflight.triangles, some.preflight.triangles);
        EXPECT_EQ(all.preflight.box_low, some.preflight.box_low);
        EXPECT_EQ(all.topology.on_boundary, some.topology.on_boundary);
        EXPECT_EQ(all.topology.component, some.topology.component);
    }
}

// In an oriented manifold the orientation is found from the components alone: it must be that of the walk over all edges.
TEST(MeshChecks, OrientationOfManifoldsAgreesWithTheGeneralWay) {
    TriangleMesh open_torus = torus(9, 7);   // encloses much, but is not closed: it stays as it is
    open_torus.F.conservativeResize(125, 3);
    TriangleMesh mesh = joined(joined(torus(9, 7), open_torus), joined(tetrahedron(), unit_cube()));
    for (const auto& [begin, end] : {std::pair{0, 126}, std::pair{126, 251}, std::pair{255, 267}}) {
        for (int t = begin; t < end; ++t) flip(mesh, t);
        const Orientation quick = consistent_orientation(mesh, topology_of(mesh)), slow = consistent_orientation(mesh);
        ASSERT_TRUE(topology_of(mesh).oriented_manifold);
        EXPECT_EQ(quick.flip, slow.flip);
        EXPECT_EQ(quick.inside_out_components, slow.inside_out_components);
        EXPECT_EQ(quick.first_inside_out, slow.first_inside_out);
    }
}

TEST(MeshChecks, CoincidentVerticesAreCountedAsASetCountsThem) {
    for (const int n : {10, 3000, 60'000}) {
        TriangleMesh mesh = random_triangles(n, n, 3);
        std::mt19937 random(4);
        for (double& x : mesh.X.reshaped()) x = (random() % 40 < 20 ? 1 : -1) * static_cast<double>(random() % 20);   // has −0
        const PreparedMesh prepared = prepare_mesh({mesh, "m.obj", {}, {}});
        std::set<std::array<double, 3>> points;   // −0 < 0 is false: they are one
        for (int v = 0; v < n; ++v) {
            if (prepared.topology.vertex_faces.size(v) > 0) points.insert({mesh.X(v, 0), mesh.X(v, 1), mesh.X(v, 2)});
        }
        const Preflight& counts = prepared.preflight;
        EXPECT_EQ(counts.duplicated_positions, counts.vertices_in_use - static_cast<int>(points.size())) << n;
    }
}

// Triangles just on either side of the limits, at any scale: the test by squares must leave them to the exact one.
TEST(MeshChecks, NeedlesAreFoundByTheirAngleAtAnyScale) {
    const double degree = std::numbers::pi / 180;
    for (const double scale : {1e-99, 1e-81, 1e-30, 1e-9, 1.0, 1e20, 1e95}) {
        for (const double off : {-1e-6, -1e-12, 1e-12, 1e-6}) {
            const double angle = degree * (1 + off);
            TriangleMesh mesh = mesh_of({{0, 0, 0}, {3, 0, 0}, {2 * std::cos(angle), 2 * std::sin(angle), 0}}, {{0, 1, 2}});
            mesh.X *= scale;
            EXPECT_EQ(prepared(mesh).preflight.needle_faces, off < 0 ? 1 : 0) << scale << " " << off;
            EXPECT_EQ(prepared(mesh).preflight.zero_area_faces, 0) << scale << " " << off;
        }
    }
}
