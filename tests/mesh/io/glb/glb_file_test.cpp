#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <cmath>

#include "mesh/io/glb/glb_bytes.h"
#include "mesh/io/mesh_files.h"
#include "mesh/io/rejections.h"
#include "mesh/mesh_checks.h"
#include "mesh/small_meshes.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

std::string glb(const std::string& node = "", const std::string& primitive = "", const std::string& more = "") {
    return glb_of(glb_text(tetrahedron(), node, primitive, more), glb_data(tetrahedron()));
}

TriangleMesh mesh_in(const std::string& bytes) { return parse_mesh(bytes, "m.glb").mesh; }

/// Returns the tetrahedron with a replacement in its text.
std::string with(const std::string& from, const std::string& to) {
    return glb_of(replaced(glb_text(tetrahedron()), from, to), glb_data(tetrahedron()));
}

/// Returns the mesh with separate corners for every triangle, as flat shading and seams of textures make them.
TriangleMesh taken_apart(const TriangleMesh& mesh) {
    TriangleMesh apart;
    apart.X.resize(mesh.F.size(), 3);
    apart.F = Faces::NullaryExpr(mesh.F.rows(), 3, [](Eigen::Index t, Eigen::Index k) { return static_cast<int>(3 * t + k); });
    for (int i = 0; i < mesh.F.size(); ++i) apart.X.row(i) = mesh.X.row(mesh.F(i / 3, i % 3));
    return apart;
}

}   // namespace

TEST(Glb, ReadsASimpleMesh) { expect_tetrahedron(parse_mesh(glb(), "m.glb")); }

TEST(Glb, SeamsAreWelded) {
    for (const TriangleMesh& mesh : {tetrahedron(), unit_cube()}) {
        const TriangleMesh apart = taken_apart(mesh);
        const PreparedMesh read = prepare_mesh(parse_mesh(glb_of(glb_text(apart), glb_data(apart)), "m.glb"));
        EXPECT_EQ(read.preflight.euler_characteristic, 2);
        EXPECT_EQ(read.preflight.boundary_edges, 0);
        EXPECT_EQ(read.preflight.vertices, mesh.vertex_count());
        for (int t = 0; t < mesh.face_count(); ++t) {
            for (int k = 0; k < 3; ++k) EXPECT_EQ(read.mesh.X.row(read.mesh.F(t, k)), mesh.X.row(mesh.F(t, k)));
        }
    }
}

// Scale, then turn by 90° about z (x → y, y → −x), then move; a matrix gives the same; the matrix of a child multiplies from the right.
TEST(Glb, TransformationsAreThoseComputedByHand) {
    Positions expected(4, 3);
    expected << 10, 20, 30, 10, 22, 30, 7, 20, 30, 10, 20, 34;
    const std::string turn = R"(,"translation":[10,20,30],"rotation":[0,0,0.7071067811865476,0.7071067811865476],"scale":[2,3,4])";
    EXPECT_LT((mesh_in(glb(turn)).X - expected).cwiseAbs().maxCoeff(), 1e-14);
    EXPECT_EQ(mesh_in(glb(R"(,"matrix":[0,2,0,0,-3,0,0,0,0,0,4,0,10,20,30,1])")).X, expected);
    const std::string nested =
        with(R"("nodes":[{"mesh":0}])", R"("nodes":[{"children":[1]})" + std::string(",{\"mesh\":0") + R"(,"scale":[2,3,4]}])");
    const std::string turned =
        replaced(glb_text(tetrahedron()), R"("nodes":[{"mesh":0}])",
                 R"("nodes":[{"children":[1],"matrix":[0,1,0,0,-1,0,0,0,0,0,1,0,10,20,30,1]},{"mesh":0,"scale":[2,3,4]}])");
    EXPECT_EQ(mesh_in(nested).X, Positions(tetrahedron().X * Vector3(2, 3, 4).asDiagonal()));
    EXPECT_EQ(mesh_in(glb_of(turned, glb_data(tetrahedron()))).X, expected);
}

TEST(Glb, AMirrorTurnsTheTriangles) {
    const PreparedMesh read = prepare_mesh(parse_mesh(glb(R"(,"scale":[1,1,-1])"), "m.glb"));
    EXPECT_EQ(read.preflight.inside_out_components, 0);
    EXPECT_GT(read.preflight.volume, 0);
}

TEST(Glb, NodesShareAMeshAndMayStandApart) {
    const std::string twice = with(R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}])",
                                   R"("scenes":[{"nodes":[0,1]}],"nodes":[{"mesh":0},{"mesh":0,"translation":[5,0,0]}])");
    const TriangleMesh mesh = mesh_in(twice);
    EXPECT_EQ(mesh.X, joined(tetrahedron(), moved_to(tetrahedron(), moved(tetrahedron().X, Vector3(5, 0, 0)))).X);
    EXPECT_EQ(mesh.F.bottomRows(4), Faces(tetrahedron().F.array() + 4));
}

TEST(Glb, StripsAndFans) {
    TriangleMesh grid = flat_grid(2, 3);   // 0 1 2 above 3 4 5
    grid.F.resize(2, 3);
    grid.F << 0, 3, 1, 4, 2, 5;   // read as a strip of six
    const TriangleMesh strip = mesh_in(glb_of(glb_text(grid, "", R"(,"mode":5)"), glb_data(grid)));
    ASSERT_EQ(strip.face_count(), 4);
    for (int t = 0; t < 4; ++t) {
        const Vector3 a = strip.X.row(strip.F(t, 0)), b = strip.X.row(strip.F(t, 1)), c = strip.X.row(strip.F(t, 2));
        EXPECT_EQ((b - a).cross(c - a), Vector3(0, 0, 1)) << "all face the same side";
    }
    grid.F << 0, 3, 4, 5, 2, 1;
    const TriangleMesh fan = mesh_in(glb_of(glb_text(grid, "", R"(,"mode":6)"), glb_data(grid)));
    EXPECT_EQ(fan.F, mesh_of({}, {{0, 3, 4}, {0, 4, 5}, {0, 5, 2}, {0, 2, 1}}).F);
    EXPECT_TRUE(refused(glb("", R"(,"mode":1)"), "m.glb", "no triangles"));
}

TEST(Glb, QuantizedPositionsAndSmallIndices) {
    std::string data = glb_data(tetrahedron());
    for (int v = 0; v < 4; ++v) {
        for (int k = 0; k < 3; ++k) data[static_cast<std::size_t>(4 * v + k)] = tetrahedron().X(v, k) > 0 ? '\x7f' : '\0';
    }
    for (int i = 0; i < 12; ++i) data[1024 + static_cast<std::size_t>(i)] = static_cast<char>(tetrahedron().F(i / 3, i % 3));
    std::string text = replaced(glb_text(tetrahedron()), "5126", "5120");
    text = replaced(replaced(text, "5123", "5121"), R"("byteLength":1024})", R"("byteLength":1024,"byteStride":4})");
    EXPECT_EQ(mesh_in(glb_of(text, data)).X, Positions(127 * tetrahedron().X));
    text = replaced(text, R"("componentType":5120)", R"("normalized":true,"componentType":5120)");
    EXPECT_EQ(mesh_in(glb_of(text, data)).X, tetrahedron().X);
}

TEST(Glb, CustomColoursAndValuesAreColumns) {
    const TriangleMesh mesh = tetrahedron();
    std::string data = glb_data(mesh);
    for (int v = 0; v < 4; ++v) {
        for (int k = 0; k < 4; ++k) data[512 + static_cast<std::size_t>(4 * v + k)] = static_cast<char>(50 * v + k);
    }
    std::string heights;
    for (const float h : {0.5F, 1.5F, -2.5F, 1e30F}) append(heights, h);
    data.replace(768, 16, heights);
    std::string text = replaced(glb_text(mesh), R"("POSITION":0)", R"("POSITION":0,"COLOR_0":2,"_HEIGHT":3,"TEXCOORD_0":0)");
    text = replaced(text, R"("bufferViews":[)", R"("bufferViews":[)");
    text = replaced(text, R"("count":12}])",
                    R"("count":12},{"bufferView":0,"byteOffset":512,"componentType":5121,"normalized":true,"type":"VEC4","count":4},)"
                    R"({"bufferView":0,"byteOffset":768,"componentType":5126,"type":"SCALAR","count":4}])");
    text = replaced(text, R"("indices":1})", R"("indices":1,"material":0})");
    const LoadedMesh read = parse_mesh(glb_of(text, data), "m.glb", Keep::attributes);
    EXPECT_EQ(warnings_of(read), "0: attributes that are not kept (TEXCOORD_0, material)\n");
    const std::vector<VertexColumn>& columns = read.attributes.columns;
    ASSERT_EQ(columns.size(), 5U);
    EXPECT_EQ(columns[1].name, "green");
    const auto as_srgb = [](double x) { return std::round(255 * (1.055 * std::pow(x / 255, 1 / 2.4) - 0.055)); };
    EXPECT_EQ(columns[1].values, (Vector(4) << 13, as_srgb(51), as_srgb(101), as_srgb(151)).finished()) << "linear light in the file";
    EXPECT_EQ(columns[3].values, (Vector(4) << 3, 53, 103, 153).finished()) << "alpha is linear everywhere";
    EXPECT_EQ(columns[1].type, ScalarType::uint8);
    EXPECT_EQ(columns[4].name, "HEIGHT");
    EXPECT_EQ(columns[4].values, (Vector(4) << 0.5, 1.5, -2.5, 1e30F).finished());
    const LoadedMesh bare = parse_mesh(glb_of(text, data), "m.glb");
    EXPECT_TRUE(bare.attributes.columns.empty() && bare.warnings.empty()) << "where they are not asked for";
}

TEST(Glb, RefusalsNameTheProblem) {
    EXPECT_TRUE(refused(glb("", "", R"(,"extensionsRequired":["KHR_draco_mesh_compression"])"), "m.glb", "'KHR_draco_mesh_compression'"));
    EXPECT_TRUE(refused(glb("", "", R"(,"extensionsRequired":["EXT_meshopt_compression"])"), "m.glb", "'EXT_meshopt_compression'"));
    EXPECT_EQ(refusal(glb("", "", R"(,"extensionsRequired":["KHR_mesh_quantization","KHR_materials_unlit"])"), "m.glb"), "accepted");
    EXPECT_TRUE(refused(with(R"({"byteLength":2048})", R"({"byteLength":2048,"uri":"m.bin"})"), "m.glb", "in another file"));
    EXPECT_TRUE(refused(with(R"("count":4})", R"("count":4,"sparse":{}})"), "m.glb", "no valid glTF"));
    EXPECT_TRUE(refused(with(R"("count":4})", R"("count":400})"), "m.glb", "accessor 0 reaches beyond its data"));
    EXPECT_TRUE(refused(with(R"("count":4})", R"("count":4294967295})"), "m.glb", "reaches beyond its data"));
    EXPECT_TRUE(refused(with(R"("count":4})", R"("count":-4})"), "m.glb", "count is no whole number"));
    EXPECT_TRUE(refused(with(R"("count":4})", R"("count":1e400})"), "m.glb", "no valid glTF"));
    EXPECT_TRUE(refused(with(R"("count":4})", R"("count":3})"), "m.glb", "index 3 out of range (3 vertices)"));
    EXPECT_TRUE(refused(with(R"("nodes":[{"mesh":0}])", R"("nodes":[{"mesh":0,"children":[0]}])"), "m.glb", "its own ancestor"));
    EXPECT_TRUE(refused(with(R"("nodes":[{"mesh":0}])", R"("nodes":[{"children":[1,1]},{"mesh":0}])"), "m.glb", "has two parents"));
    EXPECT_TRUE(refused(with(R"("nodes":[0])", R"("nodes":[0,0])"), "m.glb", "names node 0 twice"));
    EXPECT_TRUE(refused(with(R"("scenes":[{"nodes":[0]}])", R"("scenes":[{"nodes":[7]}])"), "m.glb", "no entry 7 of nodes"));
    std::string draco = replaced(glb_text(tetrahedron()), R"("indices":1)", R"("extensions":{"KHR_draco_mesh_compression":{}})");
    draco = replaced(draco, R"({"bufferView":0,"componentType":5126)", R"({"componentType":5126)");
    EXPECT_TRUE(refused(glb_of(draco, glb_data(tetrahedron())), "m.glb", "'KHR_draco_mesh_compression'")) << "not named as required";
    EXPECT_TRUE(refused(with(R"("mesh":0)", R"("mesh":0,"translation":[1e101,0,0])"), "m.glb", "out of the supported range"));
    EXPECT_TRUE(refused(with(R"("mesh":0)", R"("mesh":0,"translation":"far")"), "m.glb", "no valid glTF"));
    EXPECT_TRUE(refused(with(R"({"asset")", R"(["asset")"), "m.glb", "no valid glTF"));
    EXPECT_TRUE(refused(replaced(glb(), std::string("\2\0\0\0", 4), std::string("\1\0\0\0", 4)), "m.glb", "version 1"));
    EXPECT_TRUE(refused(glb().substr(0, 3000 - 1000), "m.glb", "ends early"));
    EXPECT_TRUE(refused(glb(), "m.obj", "looks like GLB, but the name says .obj"));
}

// A few hundred bytes may not ask for gigabytes.
TEST(Glb, InstancesAreLimited) {
    std::string nodes, numbers;
    for (int i = 0; i < 30000; ++i) {
        nodes += R"({"mesh":0},)";
        numbers += std::to_string(i) + ",";
    }
    nodes.pop_back();
    numbers.pop_back();
    std::string text = replaced(glb_text(tetrahedron()), R"("nodes":[{"mesh":0}])", R"("nodes":[)" + nodes + "]");
    text = replaced(text, R"({"nodes":[0]})", R"({"nodes":[)" + numbers + "]}");
    EXPECT_EQ(refusal(glb_of(text, glb_data(tetrahedron())), "m.glb"), "accepted") << "few enough";
    std::string primitives = R"("indices":1})";
    for (int i = 1; i < 40; ++i) primitives += R"(,{"attributes":{"POSITION":0},"indices":1})";
    const std::string many = replaced(text, R"("indices":1})", primitives);
    EXPECT_TRUE(refused(glb_of(many, glb_data(tetrahedron())), "m.glb", "its instances make more than"));
}
