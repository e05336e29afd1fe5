#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "mesh/io/mesh_files.h"
#include "mesh/io/rejections.h"
#include "mesh/small_meshes.h"
#include "mesh/triangle_measures.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

std::string little_endian(std::uint32_t value) {
    std::string bytes;
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(value >> (8 * i) & 255);
    return bytes;
}

std::string binary_stl(const TriangleMesh& mesh, std::string title = "") {
    title.resize(80, '\0');
    std::string bytes = title + little_endian(static_cast<std::uint32_t>(mesh.face_count()));
    for (int t = 0; t < mesh.face_count(); ++t) {
        bytes += std::string(12, '\x7f');   // a normal that is not a number: not used
        for (int k = 0; k < 3; ++k) {
            for (int axis = 0; axis < 3; ++axis)
                bytes += little_endian(std::bit_cast<std::uint32_t>(static_cast<float>(mesh.X(mesh.F(t, k), axis))));
        }
        bytes += "\xff\x7f";
    }
    return bytes;
}

std::string facet(const std::string& a, const std::string& b, const std::string& c) {
    return " facet normal nan nan nan\n  outer loop\n   vertex " + a + "\n   vertex " + b + "\n   vertex " + c + "\n  endloop\n endfacet\n";
}
const std::string text_stl = "solid <b>\n" + facet("0 0 0", "0 1 0", "1 0 0") + facet("0 -0.0 0", "1 0 0", "0 0 1") +
                             facet("-0 0 0", "0 0 1", "0 1 0") + facet("1 0 0", "0 1e0 0", "0 0 1.") + "endsolid\n";

}   // namespace

TEST(StlFile, WeldedCornersGiveBackTheSurface) {
    const TriangleMesh mesh = unit_cube();
    const LoadedMesh loaded = parse_stl(binary_stl(mesh), "m.stl");
    EXPECT_EQ(loaded.mesh.vertex_count(), 8);
    EXPECT_EQ(surface_area(loaded.mesh), 6);
    EXPECT_EQ(signed_volume(loaded.mesh), 1);
    EXPECT_EQ(loaded.mesh.F.row(0), (Eigen::RowVector3i(0, 1, 2)));   // numbered as they first appear
    EXPECT_EQ(warnings_of(loaded), "");
}

TEST(StlFile, TextAndBinaryAgreeAndMinusZeroIsZero) {
    const LoadedMesh text = parse_stl(text_stl, "m.stl");
    EXPECT_EQ(text.mesh.vertex_count(), 4);
    EXPECT_EQ(text.mesh.X, parse_stl(binary_stl(tetrahedron(), "solid but binary"), "m.stl").mesh.X);
    EXPECT_EQ(text.mesh.F, parse_stl(binary_stl(tetrahedron()), "m.stl").mesh.F);
    EXPECT_EQ(text.face_lines, (std::vector<long>{2, 9, 16, 23}));
    std::string upper = text_stl;
    for (char& c : upper) c = c == '\n' ? '\n' : static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    EXPECT_EQ(parse_stl(upper, "m.stl").mesh.X, text.mesh.X);
}

// meshlab #194, numpy-stl #206, meshio #642: other programs write the keywords of a facet with and without blanks, on any line.
TEST(StlFile, NamesMayHoldKeywords) {
    for (const char* name : {"facet normal vertex", "facet", "end facet normal of"}) {
        std::string named = text_stl;
        named.replace(named.find("<b>"), 3, name);
        EXPECT_EQ(parse_mesh(named, "m.stl").mesh.F, parse_mesh(text_stl, "m.stl").mesh.F) << name;
    }
}

TEST(StlFile, KeywordsMayBeOneWordOrTwoAndStandOnAnyLine) {
    const auto all_replaced = [](std::string text, const std::string& from, const std::string& to) {
        for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
            text.replace(at, from.size(), to);
        return text;
    };
    const std::vector<std::pair<std::string, std::string>> spellings{{"endloop", "end loop"},
                                                                     {"endfacet", "End \t Facet"},
                                                                     {"outer loop", "OUTERLOOP"},
                                                                     {"facet normal", "facetNormal"},
                                                                     {"\nendsolid", "\nend solid"},
                                                                     {"  outer", "\touter"},
                                                                     {"nan nan nan", "0 0\n 1"},
                                                                     {"nan nan nan", "0 0"},
                                                                     {"normal nan", "\nnormal nan"},
                                                                     {"\n", " "},
                                                                     {"\n", "\t"},
                                                                     {"\n", "\r"},
                                                                     {"\n  outer", " outer"}};
    const TriangleMesh expected = parse_stl(text_stl, "m.stl").mesh;
    for (unsigned chosen = 0; chosen < 1U << spellings.size(); chosen += chosen < 64 ? 1 : 37) {
        std::string text = text_stl;
        for (std::size_t i = 0; i < spellings.size(); ++i)
            if ((chosen >> i & 1) != 0) text = all_replaced(text, spellings[i].first, spellings[i].second);
        const LoadedMesh read = parse_stl(text, "m.stl");
        EXPECT_EQ(read.mesh.X, expected.X) << text;
        EXPECT_EQ(read.mesh.F, expected.F) << text;
        EXPECT_EQ(warnings_of(read), "") << text;
        EXPECT_NE(refusal(all_replaced(text, "1 0 0", "1 0"), "m.stl"), "accepted") << text;
    }
    EXPECT_EQ(parse_stl(all_replaced(text_stl, "facet normal nan nan nan", "facet"), "m.stl").mesh.F, expected.F);
    const std::string two = text_stl + text_stl;
    EXPECT_EQ(parse_stl(all_replaced(two, "\n", " "), "m.stl").mesh.face_count(), 8);
    EXPECT_EQ(parse_mesh(all_replaced(text_stl, "solid", "SOLID"), standard_input).mesh.F, expected.F);
}

TEST(StlFile, MissingKeywordsAreErrors) {
    const std::string whole = "solid x facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet endsolid\n";
    EXPECT_EQ(parse_stl(whole, "m.stl").mesh.face_count(), 1);
    for (const std::string word : {"outer loop ", "outer ", "loop ", "vertex ", "endloop ", "endfacet ", "1 0 0 "})
        EXPECT_TRUE(refused(replaced(whole, word, "") + whole, "m.stl:1", "")) << word;
    EXPECT_TRUE(refused(replaced(whole, "endloop", "end\nloop"), "m.stl:1", "expected 'endloop', found 'end'"));
    EXPECT_TRUE(refused(replaced(whole, "endloop", "end facet"), "m.stl:1", "expected 'endloop', found 'end'"));
}

TEST(StlFile, NearlyEqualCornersAreNotWelded) {
    TriangleMesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0x1p-30, 0, 0}, {1, 0, 0}, {0, 0, 1}}, {{0, 1, 2}, {3, 4, 5}});
    EXPECT_EQ(parse_stl(binary_stl(mesh), "m.stl").mesh.vertex_count(), 5);
}

TEST(StlFile, WarnsOfOddEnds) {
    EXPECT_EQ(warnings_of(parse_stl(binary_stl(tetrahedron()) + "abcd", "m.stl")), "0: bytes after the last triangle ignored (4)\n");
    EXPECT_EQ(warnings_of(parse_stl(text_stl.substr(0, text_stl.size() - 9), "m.stl")), "0: no endsolid\n");
}

TEST(StlFile, RefusesDamagedFiles) {
    const std::string whole = binary_stl(tetrahedron());
    for (std::size_t size = 1; size < whole.size(); ++size) EXPECT_NE(refusal(whole.substr(0, size), "m.stl"), "accepted") << size;
    EXPECT_TRUE(refused(whole.substr(0, 83), "m.stl", "too short"));
    EXPECT_TRUE(refused(whole.substr(0, whole.size() - 1), "m.stl", "4 triangles announced, room for 3"));
    EXPECT_TRUE(refused(std::string(84, '\0'), "m.stl", "no triangles"));
    std::string nan = whole;
    nan.replace(84 + 12, 4, little_endian(0x7fc00000));
    EXPECT_TRUE(refused(nan, "m.stl", "coordinate is nan"));
    EXPECT_TRUE(refused("solid x\nendsolid x\n", "m.stl", "no triangles"));
    EXPECT_TRUE(refused(text_stl.substr(0, text_stl.find("endloop")), "m.stl:7", "ends inside a facet"));
    EXPECT_TRUE(refused("solid\n facet normal 0 0 1\n outer loop\n vertex 0 0 0\n vertex 1 0 0\n endloop\n", "m.stl:6",
                        "expected 'vertex', found 'endloop'"));
    EXPECT_TRUE(refused("solid\n" + facet("0 0 0", "1 0 0", "0 1 0\n vertex 1 1 1"), "m.stl:7", "expected 'endloop'"));
    EXPECT_TRUE(refused("solid\n" + facet("0 0 0", "1,0 0 0", "0 1 0"), "m.stl:5", "'1,0'"));
    EXPECT_TRUE(refused("solid\n" + facet("0 0 0", "1 0", "0 1 0"), "m.stl:5", "3 coordinates"));
    EXPECT_TRUE(refused("solid\nfacette\n", "m.stl:2", "expected 'facet'"));
}
