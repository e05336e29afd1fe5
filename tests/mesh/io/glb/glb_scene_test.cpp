// Parts of glTF 2.0 that change the vertices of a primitive: skins, morph targets, sparse accessors, instances, shared buffers, missing
// scenes.
#include <gtest/gtest.h>

#include <cmath>

#include "mesh/io/glb/glb_bytes.h"
#include "mesh/io/mesh_files.h"
#include "mesh/io/rejections.h"
#include "mesh/small_meshes.h"
#include "mesh/triangle_measures.h"

using namespace meshfolio;
using namespace meshfolio::testing;
using nlohmann::json;

namespace {

/// The tetrahedron in node 0.
GlbParts plain_glb() {
    GlbParts glb;
    glb.add_mesh(tetrahedron());
    glb.json["nodes"] = json::array({{{"mesh", 0}}});
    return glb;
}

json& primitive_of(GlbParts& glb) { return glb.json["meshes"][0]["primitives"][0]; }

TriangleMesh shape_in(GlbParts& glb) { return parse_mesh(glb.bytes(), "m.glb").mesh; }

/// The tetrahedron, all of it held by both joints: node 1, twice as large, and node 2, moved by (8, 0, 0).
template <class T> GlbParts skinned(const std::vector<std::uint8_t>& joints, const std::vector<T>& weights) {
    GlbParts glb = plain_glb();
    std::vector<std::uint8_t> all_joints;
    std::vector<T> all_weights;
    for (int v = 0; v < 4; ++v) {
        all_joints.insert(all_joints.end(), joints.begin(), joints.end());
        all_weights.insert(all_weights.end(), weights.begin(), weights.end());
    }
    const std::size_t joint = glb.accessor(all_joints, "VEC4"), weight = glb.accessor(all_weights, "VEC4", !std::is_same_v<T, float>);
    primitive_of(glb)["attributes"].update({{"JOINTS_0", joint}, {"WEIGHTS_0", weight}});
    glb.json["nodes"] = json::parse(R"([{"mesh":0,"skin":0,"scale":[100,100,100]},{"scale":[2,2,2]},{"translation":[8,0,0]}])");
    glb.json["skins"] = json::parse(R"([{"joints":[1,2]}])");
    return glb;
}

Positions at_place(double scale, const Vector3& move) { return moved(scale * tetrahedron().X, move); }

std::string refusal_of(GlbParts glb) { return refusal(glb.bytes(), "m.glb"); }

bool has_text(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}   // namespace

// Σ w G B v: half of (2 v) and half of (v + 8).
TEST(GlbScene, SkinsAreAtRestWhereTheirJointsPutThem) {
    const Positions half = at_place(1.5, Vector3(4, 0, 0));
    GlbParts floats = skinned<float>({0, 1, 0, 0}, {0.5F, 0.5F, 0, 0});
    EXPECT_LT((shape_in(floats).X - half).cwiseAbs().maxCoeff(), 1e-12) << "the node's own scale plays no part";
    GlbParts bytes = skinned<std::uint8_t>({0, 1, 0, 0}, {51, 204, 0, 0});
    EXPECT_LT((shape_in(bytes).X - at_place(1.2, Vector3(6.4, 0, 0))).cwiseAbs().maxCoeff(), 1e-12);
    GlbParts shorts = skinned<std::uint16_t>({1, 0, 0, 0}, {13107, 52428, 0, 0});
    EXPECT_LT((shape_in(shorts).X - at_place(1.8, Vector3(1.6, 0, 0))).cwiseAbs().maxCoeff(), 1e-12);
    // The inverse bind matrix of joint 0 undoes its scale, that of joint 1 its translation.
    std::vector<float> inverse(32, 0);
    for (const std::size_t k : {0, 5, 10}) inverse[k] = 0.5F, inverse[16 + k] = 1;
    inverse[15] = inverse[31] = 1, inverse[28] = -8;
    floats.json["skins"][0]["inverseBindMatrices"] = floats.accessor(inverse, "MAT4");
    EXPECT_EQ(shape_in(floats).X, tetrahedron().X);
}

TEST(GlbScene, JointsHaveParentsAndVerticesMoreThanFourOfThem) {
    GlbParts glb = skinned<float>({0, 0, 0, 0}, {0.5F, 0, 0, 0});
    const auto& attributes = primitive_of(glb)["attributes"];
    primitive_of(glb)["attributes"].update(
        {{"JOINTS_1", glb.accessor(std::vector<std::uint16_t>(16, 1), "VEC4")}, {"WEIGHTS_1", attributes["WEIGHTS_0"]}});
    EXPECT_LT((shape_in(glb).X - at_place(1.5, Vector3(4, 0, 0))).cwiseAbs().maxCoeff(), 1e-12);
    glb.json["nodes"].push_back({{"children", {1, 2}}, {"translation", {0, 10, 0}}});
    EXPECT_LT((shape_in(glb).X - at_place(1.5, Vector3(4, 10, 0))).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(GlbScene, WeightsThatDoNotSumToOneAreNormalisedWithAWarning) {
    GlbParts half = skinned<float>({0, 1, 0, 0}, {0.25F, 0.25F, 0, 0}), none = skinned<float>({1, 0, 0, 0}, {0, 0, 0, 0});
    EXPECT_EQ(shape_in(half).X, at_place(1.5, Vector3(4, 0, 0)));
    EXPECT_TRUE(has_text(warnings_of(parse_mesh(half.bytes(), "m.glb")), "4 vertices have weights of joints that do not sum to 1"));
    EXPECT_EQ(shape_in(none).X, at_place(1, Vector3(8, 0, 0))) << "its first joint";
    EXPECT_TRUE(has_text(refusal_of(skinned<float>({2, 0, 0, 0}, {1, 0, 0, 0})), "joint out of range (2 joints)"));
    EXPECT_TRUE(has_text(refusal_of(skinned<float>({0, 0, 0, 0}, {-1, 2, 0, 0})), "a weight is below 0"));
    EXPECT_TRUE(has_text(refusal_of(skinned<float>({0, 0, 0, 0}, {NAN, 1, 0, 0})), "or no number"));
    half.json["skins"][0]["inverseBindMatrices"] = half.accessor(std::vector<float>(32, NAN), "MAT4");
    EXPECT_TRUE(has_text(refusal_of(half), "coordinate is not finite"));
    half.json["skins"][0]["inverseBindMatrices"] = half.accessor(std::vector<float>(16, 1), "MAT4");
    EXPECT_TRUE(has_text(refusal_of(half), "do not fit the joints"));
}

TEST(GlbScene, MorphWeightsAreThoseOfTheNodeElseOfTheMeshElseZero) {
    GlbParts glb = plain_glb();
    const std::size_t target = glb.positions(tetrahedron());   // v + w v
    primitive_of(glb)["targets"] = json::array({{{"POSITION", target}}});
    EXPECT_EQ(shape_in(glb).X, tetrahedron().X);
    glb.json["meshes"][0]["weights"] = {1};
    EXPECT_EQ(shape_in(glb).X, Positions(2 * tetrahedron().X));
    glb.json["nodes"][0]["weights"] = {2};
    EXPECT_EQ(shape_in(glb).X, Positions(3 * tetrahedron().X));
    // A sparse target without a base moves vertex 3 alone.
    const std::size_t number = glb.view(std::vector<std::uint8_t>{3}), by = glb.view(std::vector<float>{0, 0, 1});
    json& accessor = glb.json["accessors"][target];
    accessor.erase("bufferView");
    accessor["sparse"] = {{"count", 1}, {"indices", {{"bufferView", number}, {"componentType", 5121}}}, {"values", {{"bufferView", by}}}};
    Positions expected = tetrahedron().X;
    expected(3, 2) += 2;
    EXPECT_EQ(shape_in(glb).X, expected);
    glb.json["accessors"][target]["count"] = 5;
    EXPECT_TRUE(has_text(refusal_of(glb), "morph target does not fit"));
}

TEST(GlbScene, SparseElementsReplaceThoseOfTheBaseOrZeros) {
    const auto sparse = [](const std::vector<std::uint16_t>& numbers, bool has_base) {
        GlbParts glb = plain_glb();
        const std::size_t at = glb.view(numbers), values = glb.view(std::vector<float>{5, 6, 7, 8, 9, 10});
        json& accessor = glb.json["accessors"][0];
        if (!has_base) accessor.erase("bufferView");
        accessor["sparse"] = {
            {"count", 2}, {"indices", {{"bufferView", at}, {"componentType", 5123}}}, {"values", {{"bufferView", values}}}};
        return glb;
    };
    for (const bool has_base : {true, false}) {
        GlbParts glb = sparse({1, 3}, has_base);
        const Vector3 kept = parse_mesh(glb.bytes(), "m.glb").mesh.X.row(has_base ? 2 : 0);
        EXPECT_EQ(kept, has_base ? Vector3(tetrahedron().X.row(2)) : Vector3(0, 0, 0));
        EXPECT_EQ(shape_in(glb).X.row(1), Eigen::RowVector3d(5, 6, 7));
        EXPECT_EQ(shape_in(glb).X.bottomRows(1), Eigen::RowVector3d(8, 9, 10));
    }
    for (const std::vector<std::uint16_t>& numbers : std::vector<std::vector<std::uint16_t>>{{3, 1}, {1, 1}, {1, 4}})
        EXPECT_TRUE(has_text(refusal_of(sparse(numbers, true)), "do not rise or are out of range"));
    GlbParts many = sparse({1, 3}, true);
    many.json["accessors"][0]["sparse"]["count"] = 5;
    EXPECT_TRUE(has_text(refusal_of(many), "cannot be"));
}

TEST(GlbScene, InstancesStandWhereTheirAttributesPutThem) {
    GlbParts glb = plain_glb();
    const std::size_t moves = glb.accessor(std::vector<float>{0, 0, 0, 10, 0, 0, 20, 0, 0}, "VEC3"),
                      turns = glb.accessor(std::vector<std::int8_t>{0, 0, 0, 127, 0, 0, 127, 0, 0, 0, 90, 90}, "VEC4", true),
                      sizes = glb.accessor(std::vector<float>{1, 1, 1, 1, 1, 1, 2, 2, 2}, "VEC3");
    glb.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", moves}, {"ROTATION", turns}, {"SCALE", sizes}};
    glb.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    glb.json["nodes"][0]["translation"] = {0, 0, 1};
    const TriangleMesh mesh = shape_in(glb);
    ASSERT_EQ(mesh.vertex_count(), 12);
    for (int v = 0; v < 4; ++v) {
        const Vector3 x = tetrahedron().X.row(v);
        EXPECT_LT((mesh.X.row(v).transpose() - Vector3(x[0], x[1], x[2] + 1)).norm(), 1e-12);
        EXPECT_LT((mesh.X.row(4 + v).transpose() - Vector3(10 - x[0], -x[1], x[2] + 1)).norm(), 1e-12) << "half a turn about z";
        EXPECT_LT((mesh.X.row(8 + v).transpose() - Vector3(20 - 2 * x[1], 2 * x[0], 2 * x[2] + 1)).norm(), 1e-12) << "a quarter";
    }
    glb.json["accessors"][sizes]["count"] = 2;
    EXPECT_TRUE(has_text(refusal_of(glb), "SCALE of instances does not fit"));
}

TEST(GlbScene, WithoutScenesAllRootsAreShownAndWithoutNodesAllMeshes) {
    GlbParts glb = plain_glb();
    glb.json["nodes"] = json::parse(R"([{"children":[1],"translation":[0,0,5]},{"mesh":0},{"mesh":0}])");
    EXPECT_EQ(shape_in(glb).X, joined(moved_to(tetrahedron(), at_place(1, Vector3(0, 0, 5))), tetrahedron()).X);
    glb.json.erase("nodes");
    glb.add_mesh(unit_cube());
    EXPECT_EQ(shape_in(glb).X, joined(tetrahedron(), unit_cube()).X);
    glb.json["nodes"] = json::parse(R"([{"children":[1]},{"children":[0],"mesh":0},{"mesh":0}])");
    EXPECT_TRUE(has_text(refusal_of(glb), "its own ancestor"));
    glb.json["nodes"] = json::parse(R"([{"mesh":0}])");
    glb.json["scene"] = 0;
    EXPECT_TRUE(has_text(refusal_of(glb), "no entry 0 of scenes"));
}

// A file with one buffer of vertices for 400 meshes and 4000 bodies has 10⁷ vertices by its accessors, and 16,000 by its triangles.
TEST(GlbScene, OnlyTheUsedPartOfASharedBufferCounts) {
    GlbParts glb;
    TriangleMesh pool = tetrahedron();
    for (int i = 1; i < 400; ++i) pool = joined(pool, tetrahedron());
    const std::size_t positions = glb.positions(pool);
    glb.json["nodes"] = json::array();
    for (int i = 0; i < 4000; ++i) {
        glb.json["nodes"].push_back({{"mesh", i % 400}, {"translation", {5 * i, 0, 0}}});
        if (i >= 400) continue;
        const std::size_t indices = glb.indices({pool.X, pool.F.middleRows(4 * i, 4)});
        const json primitive{{"attributes", {{"POSITION", positions}}}, {"indices", indices}};
        glb.json["meshes"].push_back({{"primitives", json::array({primitive})}});
    }
    const TriangleMesh mesh = shape_in(glb);
    EXPECT_EQ(mesh.vertex_count(), 16000);
    EXPECT_NEAR(signed_volume(mesh), 4000 * signed_volume(tetrahedron()), 1e-6);
}

TEST(GlbScene, WeldsWithinAMeshAndNotAcrossNodes) {
    GlbParts glb;
    glb.add_mesh(unit_cube());
    glb.json["nodes"] = json::parse(R"([{"mesh":0},{"mesh":0,"translation":[1,0,0]}])");
    EXPECT_EQ(shape_in(glb).vertex_count(), 16) << "two bodies that touch";
    glb.json["nodes"] = json::parse(R"([{"mesh":0}])");
    TriangleMesh top{unit_cube().X, unit_cube().F.topRows(6)}, bottom{unit_cube().X, unit_cube().F.bottomRows(6)};
    GlbParts cut;
    cut.add_mesh(top);
    cut.json["meshes"][0]["primitives"].push_back(
        {{"attributes", {{"POSITION", cut.positions(bottom)}}}, {"indices", cut.indices(bottom)}});
    cut.json["nodes"] = glb.json["nodes"];
    EXPECT_EQ(shape_in(cut).vertex_count(), 8) << "one body in two primitives";
}

// 100 kB may not ask for gigabytes or minutes: empty strips, targets, sets of joints and sparse entries read again for each of many nodes.
TEST(GlbScene, WorkIsLimited) {
    GlbParts glb = plain_glb();
    const json strip{{"attributes", {{"POSITION", 0}}}, {"indices", glb.accessor(std::vector<std::uint8_t>{0, 1}, "SCALAR")}, {"mode", 5}};
    for (int i = 0; i < 2000; ++i) glb.json["meshes"][0]["primitives"].push_back(strip);
    for (int i = 0; i < 4000; ++i) glb.json["nodes"].push_back({{"mesh", 0}});
    EXPECT_TRUE(has_text(refusal_of(glb), "its instances make more than"));
    GlbParts morphed = plain_glb();
    const json target{{"POSITION", 0}};
    for (int i = 0; i < 2000; ++i) {
        primitive_of(morphed)["targets"].push_back(target);
        morphed.json["meshes"][0]["weights"].push_back(0.5);
        morphed.json["nodes"].push_back({{"mesh", 0}});
    }
    EXPECT_TRUE(has_text(refusal_of(morphed), "its instances make more than"));
    GlbParts wide = plain_glb();
    wide.json["accessors"][0].erase("bufferView");
    wide.json["accessors"][0]["count"] = 4294967295;
    EXPECT_TRUE(has_text(refusal_of(wide), "its instances make more than")) << "zeros that no byte stands for";
    wide.json["meshes"][0]["primitives"][0].erase("indices");
    EXPECT_TRUE(has_text(refusal_of(wide), "its instances make more than"));
}

TEST(GlbScene, MeshesWithoutColoursAreWhiteAndSeamsAreReported) {
    GlbParts glb = plain_glb();
    glb.add_mesh(tetrahedron());
    glb.json["nodes"].push_back({{"mesh", 1}});
    std::vector<float> colors;
    for (int v = 0; v < 4; ++v) colors.insert(colors.end(), {0.5F, 0, 0.25F});
    glb.json["meshes"][1]["primitives"][0]["attributes"]["COLOR_0"] = glb.accessor(colors, "VEC3");
    glb.json["meshes"][1]["primitives"][0]["attributes"]["_ID"] = glb.accessor(std::vector<std::uint8_t>{1, 2, 3, 4}, "SCALAR");
    const LoadedMesh read = parse_mesh(glb.bytes(), "m.glb", Keep::attributes);
    ASSERT_EQ(read.attributes.columns.size(), 4U);
    for (const VertexColumn& column : read.attributes.columns) {
        const bool is_color = column.name != "ID";
        for (int v = 0; v < 4; ++v)
            EXPECT_TRUE(is_color ? std::abs(column.values[v] - 1) < 1e-12 : std::isnan(column.values[v])) << column.name;
        EXPECT_EQ(column.type, is_color ? ScalarType::float32 : ScalarType::float64);
    }
    EXPECT_NEAR(read.attributes.columns[0].values[4], 0.7353569831, 1e-6) << "half the light, in sRGB";
    EXPECT_EQ(warnings_of(read), "");
    // Repeats the same vertices within the mesh, in another colour.
    GlbParts seam = plain_glb();
    primitive_of(seam)["attributes"]["COLOR_0"] = seam.accessor(colors, "VEC3");
    json other = primitive_of(seam);
    colors[0] = 1;
    other["attributes"]["COLOR_0"] = seam.accessor(colors, "VEC3");
    seam.json["meshes"][0]["primitives"].push_back(other);
    EXPECT_EQ(warnings_of(parse_mesh(seam.bytes(), "m.glb", Keep::attributes)),
              "0: vertex has other colours or values across a seam: the first are kept\n");
    EXPECT_EQ(warnings_of(parse_mesh(seam.bytes(), "m.glb")), "") << "where they are not asked for";
}
