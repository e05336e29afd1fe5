// Properties of a mesh that a GLB keeps: its shape far from the origin, bodies that touch, its colours.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/joined.h"
#include "mesh/io/glb/glb_parts.h"
#include "mesh/io/mesh_files.h"
#include "mesh/io/rejections.h"
#include "mesh/small_meshes.h"
#include "mesh/triangle_measures.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

LoadedMesh through_glb(const TriangleMesh& mesh, const Attributes& attributes = {}) {
    return parse_mesh(encode_mesh(mesh, "m.glb", attributes), "m.glb", Keep::attributes);
}

Attributes colors_of(const std::vector<Vector>& channels, ScalarType type) {
    static const char* names[] = {"red", "green", "blue", "alpha"};
    Attributes attributes;
    for (std::size_t k = 0; k < channels.size(); ++k) attributes.columns.push_back({names[k], channels[k], type});
    return attributes;
}

std::string told_of_glb(const TriangleMesh& mesh, const Attributes& attributes) { return joined(losses(mesh, "m.glb", attributes), "\n"); }

}   // namespace

// Rounding is half a unit in the last place of half the size, for a mesh of any place and size; a mesh that was read is kept bit by bit.
TEST(GlbWriter, PlaceAndSizeDoNotMatter) {
    const TriangleMesh mesh = torus(19, 11);
    for (const double size : {1.0, 1e-50, 1e-30, 1e30, 1e90}) {
        for (const double offset : {0.0, 1.0, 1e3, 1e5, 1e7}) {
            const TriangleMesh there = moved_to(mesh, moved(size * mesh.X, size * offset * Vector3(1, -0.3, 0.2)));
            const TriangleMesh read = through_glb(there).mesh;
            ASSERT_EQ(read.F, there.F);
            EXPECT_LT((read.X - there.X).cwiseAbs().maxCoeff(), size * (2e-7 + 2e-16 * offset)) << size << " " << offset;
            EXPECT_EQ(through_glb(read).mesh.X, read.X) << size << " " << offset;
            EXPECT_EQ(told_of_glb(there, {}), "");
        }
    }
    EXPECT_EQ(through_glb(tetrahedron()).mesh.X, tetrahedron().X);
    const GlbFrame frame = float_frame(tetrahedron());
    EXPECT_TRUE(frame.translation.isZero(0) && frame.scale == 1) << "floats stay as they are";
}

TEST(GlbWriter, BodiesThatTouchStayApart) {
    const TriangleMesh touching = joined(unit_cube(), moved_to(unit_cube(), moved(unit_cube().X, Vector3(1, 0, 0))));
    const TriangleMesh three = joined(touching, moved_to(unit_cube(), moved(unit_cube().X, Vector3(5, 0, 0))));
    for (const TriangleMesh& mesh : {touching, three, joined(touching, touching)}) {
        const Vector heights = Vector::LinSpaced(mesh.vertex_count(), 0, 1);
        const LoadedMesh read = through_glb(mesh, {.columns = {{"h", heights}}});
        EXPECT_EQ(read.mesh.X, mesh.X) << "in the same order";
        EXPECT_EQ(read.mesh.F, mesh.F);
        EXPECT_EQ(read.attributes.columns.at(0).values, Vector(heights.cast<float>().cast<double>()));
    }
}

TEST(GlbWriter, AllColoursOf8BitsComeBack) {
    TriangleMesh mesh = torus(16, 16);
    Vector ramp = Vector::LinSpaced(256, 0, 255).array().round();
    const Attributes bytes = colors_of({ramp, ramp.reverse(), Vector::Constant(256, 128), ramp}, ScalarType::uint8);
    const LoadedMesh read = through_glb(mesh, bytes);
    ASSERT_EQ(read.attributes.columns.size(), 4U);
    for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_EQ(read.attributes.columns[k].type, ScalarType::uint8);
        EXPECT_EQ(read.attributes.columns[k].values, bytes.columns[k].values) << k;
    }
    const Attributes shorts = colors_of({257 * ramp, 13 * ramp, 2 * ramp}, ScalarType::uint16);
    const Attributes floats = colors_of({ramp / 300, ramp / 255, Vector::Constant(256, 0.3)}, ScalarType::float32);
    for (const Attributes& attributes : {shorts, floats}) {
        const LoadedMesh again = through_glb(mesh, attributes);
        for (std::size_t k = 0; k < 3; ++k) {
            const double largest = attributes.columns[k].type == ScalarType::uint16 ? 65535 : 1;
            EXPECT_EQ(again.attributes.columns[k].type, attributes.columns[k].type);
            EXPECT_LT((again.attributes.columns[k].values - attributes.columns[k].values).cwiseAbs().maxCoeff(), 1.1e-4 * largest) << k;
        }
    }
}

TEST(GlbWriter, ColoursThatGltfDoesNotHoldAreValuesOrWhiteAndReported) {
    const Vector one = Vector::Ones(4), bright = (Vector(4) << 0, 0.5, 1, 7).finished();
    Attributes beyond = colors_of({bright, one, one}, ScalarType::float32);
    EXPECT_NE(told_of_glb(tetrahedron(), beyond).find("are written as values (_red"), std::string::npos);
    const auto columns = through_glb(tetrahedron(), beyond).attributes.columns;
    const auto red = std::ranges::find(columns, "red", &VertexColumn::name);
    ASSERT_NE(red, columns.end());
    EXPECT_EQ(red->values, bright);
    beyond.columns[0].values[3] = NAN;
    beyond.columns[1].values[3] = beyond.columns[2].values[3] = NAN;
    EXPECT_EQ(told_of_glb(tetrahedron(), beyond), "1 vertices have no colour, and are written as white");
    EXPECT_NEAR(through_glb(tetrahedron(), beyond).attributes.columns.at(0).values[3], 1, 1e-12);
}
