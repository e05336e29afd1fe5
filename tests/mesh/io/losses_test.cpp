// Sentences about parts of a mesh that a format cannot hold.
#include <gtest/gtest.h>

#include <limits>

#include "base/joined.h"
#include "mesh/io/mesh_files.h"
#include "mesh/samples/sample_shapes.h"
#include "mesh/small_meshes.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

std::string told(const TriangleMesh& mesh, const std::string& file, const Attributes& attributes = {}) {
    return joined(losses(mesh, file, attributes), "\n");
}

/// True if one of the sentences begins like that.
bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}   // namespace

TEST(Losses, RoundingIsReportedWhereItDamagesTheSurface) {
    const TriangleMesh mesh = torus(9, 7), far = moved_to(mesh, moved(mesh.X, Vector3(1e8, 0, 0)));
    for (const std::string ending : {".obj", ".off", ".ply", ".vtp"}) EXPECT_EQ(told(far, "m" + ending), "") << ending;
    EXPECT_EQ(told(mesh, "m.stl"), "") << "every number is rounded, no triangle suffers";
    EXPECT_EQ(told(mesh, "m.glb") + told(far, "m.glb"), "") << "its node moves it";
    EXPECT_TRUE(says(told(far, "m.stl"), " of 63 vertices fall onto others")) << told(far, "m.stl");
    const TriangleMesh read = parse_mesh(encode_mesh(far, "m.stl"), "m.stl").mesh;
    EXPECT_TRUE(says(told(far, "m.stl"), std::to_string(63 - read.vertex_count()) + " of 63")) << "as many as reading it again misses";
    TriangleMesh sheets = joined(tetrahedron(), moved_to(tetrahedron(), moved(tetrahedron().X, Vector3(1e-12, 0, 0))));
    sheets.X.array() += 1;
    EXPECT_TRUE(says(told(sheets, "m.stl"), "4 of 8 vertices fall onto others and 0 of 8 faces"));
    const TriangleMesh small = moved_to(mesh, 1e-50 * mesh.X);
    EXPECT_TRUE(says(told(small, "m.stl"), "62 of 63 vertices fall onto others and 126 of 126 faces")) << told(small, "m.stl");
    EXPECT_EQ(told(small, "m.glb"), "") << "its node scales it";
}

// Bodies that touch become one when an STL is read, or a GLB in which their vertices are mixed; the reported number of vertices is then
// missing.
TEST(Losses, VerticesThatReadersWeldAreCounted) {
    const TriangleMesh touching = joined(unit_cube(), moved_to(unit_cube(), moved(unit_cube().X, Vector3(1, 0, 0))));
    EXPECT_TRUE(says(told(touching, "m.stl"), "4 of 16 vertices lie where others do")) << told(touching, "m.stl");
    EXPECT_EQ(told(touching, "m.glb") + told(touching, "m.ply"), "");
    TriangleMesh mixed = touching;   // vertex 2 v of one, 2 v + 1 of the other
    for (int v = 0; v < 16; ++v) mixed.X.row(v) = touching.X.row(v / 2 + v % 2 * 8);
    mixed.F = touching.F.unaryExpr([](int v) { return v % 8 * 2 + v / 8; });
    for (const std::string file : {"m.stl", "m.glb"}) {
        EXPECT_TRUE(says(told(mixed, file), "4 of 16 vertices lie where others do")) << told(mixed, file);
        EXPECT_EQ(parse_mesh(encode_mesh(mixed, file), file).mesh.vertex_count(), 12) << file;
    }
}

TEST(Losses, GlbReportsValuesThatFloatsCannotHold) {
    const double infinity = std::numeric_limits<double>::infinity(), nothing = std::nan("");
    Attributes attributes{.columns = {{"h", (Vector(4) << nothing, 1, infinity, 2).finished()},
                                      {"k", (Vector(4) << nothing, 0.1, 1e300, -1e-300).finished()},
                                      {"id", (Vector(4) << 16777216, 16777217, 0, -16777219).finished(), ScalarType::int32}}};
    const std::string text = told(tetrahedron(), "m.glb", attributes);
    EXPECT_TRUE(says(text, "3 values of h, k are undefined or infinite")) << text;
    EXPECT_TRUE(says(text, "2 values of id are whole numbers")) << text;
    EXPECT_TRUE(says(text, "1 values of k are beyond the largest float")) << text;
    EXPECT_TRUE(says(text, "1 values of k are too small for a float")) << text;
    for (const char* file : {"m.ply", "m.vtp"}) EXPECT_EQ(told(tetrahedron(), file, attributes), "");
    const LoadedMesh read = parse_mesh(encode_mesh(tetrahedron(), "m.glb", attributes), "m.glb", Keep::attributes);
    for (const VertexColumn& column : read.attributes.columns) EXPECT_TRUE(column.values.allFinite()) << column.name;
    EXPECT_EQ(told(read.mesh, "m.glb", read.attributes), "") << "floats stay floats";
}

TEST(Losses, ReadersNameTheAttributesThatTheyDrop) {
    std::string text =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty list uchar int near\n";
    text += "element face 1\nproperty list uchar int vertex_indices\nproperty float quality\nelement edge 1\nproperty int a\nend_header\n";
    text += "0 0 0 0\n1 0 0 0\n0 1 0 1 5\n3 0 1 2 0.5\n7\n";
    const LoadedMesh read = parse_mesh(text, "m.ply", Keep::attributes);
    ASSERT_EQ(read.warnings.size(), 1U);
    EXPECT_EQ(read.warnings[0].message, "properties that are not kept (near, quality, edge)");
    EXPECT_TRUE(parse_mesh(text, "m.ply").warnings.empty()) << "where they are not asked for";
}

TEST(Losses, ColoursOfObjGoToOtherFormats) {
    const LoadedMesh read = parse_mesh("v 0 0 0 1 0 0.5\nv 1 0 0 0 1 0\nv 0 1 0 0.2 0.4 0.6\nf 1 2 3\n", "m.obj", Keep::attributes);
    for (const char* file : {"m.ply", "m.vtp", "m.glb"}) {
        EXPECT_EQ(told(read.mesh, file, read.attributes), "") << file;
        const LoadedMesh again = parse_mesh(encode_mesh(read.mesh, file, read.attributes), file, Keep::attributes);
        ASSERT_EQ(again.attributes.columns.size(), 3U) << file;
        EXPECT_EQ(again.attributes.columns[0].values, (Vector(3) << 255, 0, 51).finished()) << file;
        EXPECT_EQ(again.attributes.columns[2].values, (Vector(3) << 128, 0, 153).finished()) << file;
    }
    EXPECT_EQ(told(read.mesh, "m.obj", read.attributes), "") << "the text stays";
    EXPECT_TRUE(says(encode_mesh(read.mesh, "m.obj", read.attributes), "v 0 1 0 0.2 0.4 0.6"));
    const auto some = parse_mesh("v 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "m.obj", Keep::attributes).attributes.columns;
    ASSERT_EQ(some.size(), 3U);
    EXPECT_EQ(some[1].values, (Vector(3) << 0, 255, 255).finished()) << "white where the file has none";
}

// Half a float's digit at 1e5 is 4e-3: curvatures of a sphere of edges 0.1 are wrong long before a face turns.
TEST(Losses, StlFarFromTheOriginIsReportedBeforeFacesTurn) {
    TriangleMesh sphere = icosphere(3);
    EXPECT_EQ(told(sphere, "m.stl"), "");
    sphere.X.rowwise() += Eigen::RowVector3d(1e4, 5e3, -3e3);
    EXPECT_TRUE(says(told(sphere, "m.stl"), "of the mean edge, and curvatures change"));
    EXPECT_EQ(told(sphere, "m.glb"), "") << "moved and scaled";
}

TEST(Losses, FormatsWithoutValuesNameTheLostOnes) {
    const Attributes attributes{
        .columns = {{"nx", Vector::Ones(4)}, {"quality", Vector::Ones(4)}, {"red", Vector::Ones(4), ScalarType::uint8}}};
    for (const char* file : {"m.obj", "m.off", "m.stl", "-"})
        EXPECT_TRUE(says(told(tetrahedron(), file, attributes), "not kept are quality, red;"));
    EXPECT_EQ(told(tetrahedron(), "m.ply", attributes), "");
    EXPECT_EQ(told(tetrahedron(), "m.obj", {.columns = {{"nx", Vector::Ones(4)}}}), "") << "normals are made anew";
    const Attributes textured{.obj = "v 0 0 0\nvt 0 0\n"};
    EXPECT_TRUE(says(told(tetrahedron(), "m.ply", textured), "from OBJ to OBJ only"));
    EXPECT_EQ(told(tetrahedron(), "m.obj", textured), "");
}
