#include <gtest/gtest.h>

#include "mesh/io/mesh_files.h"
#include "mesh/io/rejections.h"
#include "mesh/small_meshes.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

const std::string obj_points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";             // lines 1 to 4
const std::string obj_tet = obj_points + "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";   // lines 5 to 8

void expect_in_obj(const std::string& text) { expect_tetrahedron(parse_obj(text, "m.obj"), "", text); }

}   // namespace

TEST(ObjFile, TheSameTetrahedronInManySpellings) {
    expect_in_obj(obj_tet);
    expect_in_obj("\xef\xbb\xbf" + obj_tet);
    expect_in_obj("f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n" + obj_points);
    expect_in_obj(obj_points + "f -4 -2 -3\nf -4 -3 -1\nf -4 -1 -2\nf -3 -2 -1");
    expect_in_obj("# comment\r\n" + obj_points +
                  "\r\nvt 0 0\rvn 0 0 1\rf 1/1 3/1 2/1\rf 1//1 2//1 4//1\r\nf 1/1/1 4/1/1 3/1/1\nf 2 +3 4\n");
    expect_in_obj("v 0 \\\n0 0\nv 1\\\r\n 0 0 # x\nv 0. 1E0 -0 1 0 0\n  v\t+0 .0 1.0 1\nf 1 3 2\n\vf 1 2 \\\n 4\f\nf 1 4 3\nf 2 3 4\n");
    expect_in_obj("mtllib /dev/zero\no\ng a b\ns 1\nusemtl \xff\n" + obj_tet + "vn nan 0 0\n");
}

TEST(ObjFile, FaceLinesArePhysical) {
    const LoadedMesh loaded = parse_obj(obj_points + "\nf 1 \\\n 3 \\\n 2\nf 1 2 4 3\n", "m.obj");
    EXPECT_EQ(loaded.face_lines, (std::vector<long>{6, 9, 9}));
}

TEST(ObjFile, NumbersAreRoundedCorrectly) {
    const LoadedMesh loaded = parse_obj("v 0.1 0.10000000000000000555 1e-320\nv 123456.654321 9007199254740993 -0\nv 4.9e-324 1e-400 3." +
                                            std::string(800, '0') + "\nf 1 2 3\n",
                                        "m.obj");
    EXPECT_EQ(loaded.mesh.X, (Positions(3, 3) << 0.1, 0.1, 1e-320, 123456.654321, 9007199254740992.0, -0.0, 4.9e-324, 0, 3).finished());
}

TEST(ObjFile, RelativeIndicesCountFromWhereTheyStand) {
    const LoadedMesh loaded = parse_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf -3 -2 -1\n", "m.obj");
    EXPECT_EQ(loaded.mesh.F, (Faces(2, 3) << 0, 1, 2, 3, 4, 5).finished());
}

TEST(ObjFile, RefusesBadIndicesWithTheirLine) {
    for (const char* index : {"0", "5", "-5", "4.0", "0x4", "4x", "2147483648", "-2147483648", "4294967297", "9223372036854775808",
                              "999999999999999999999999999999", "nan", "²"}) {
        EXPECT_TRUE(refused(obj_tet + "f 1 2 " + index + "\n", "m.obj:9", "is not a valid index")) << index;
    }
    for (const char* corner : {"1/", "1//", "1/1/", "1/1/1/1", "1/x", "//1", "1/1.5"}) {
        EXPECT_TRUE(refused(obj_tet + "f 3 2 " + corner + "\n", "m.obj:9", "'")) << corner;
    }
    EXPECT_TRUE(refused("f 1 2 3\n", "m.obj:1", "file has 0 vertices"));
    EXPECT_TRUE(refused("V 0 0 0\nv 0 0 0\nf 1 2 3\n", "m.obj:3", "the first unknown statement is 'V' at line 1"));
    EXPECT_TRUE(refused(obj_points + "f 1 \\\n3 2\nf 2 3 9\n", "m.obj:7", "vertex index 9"));
}

TEST(ObjFile, RefusesBadNumbersWithTheirLine) {
    for (const char* number : {"nan", "inf", "-1.#IND", "0,5", "abc", "--1", "1.2.3", "0x1p3", "1e400", "1e", "0#"}) {
        EXPECT_TRUE(refused("v 0 0 0\nv 0 " + std::string(number) + " 0\n" + obj_points + "f 1 2 3\n", "m.obj:2", "is not a finite number"))
            << number;
    }
    EXPECT_TRUE(refused("\nv 0 0 1e101\n" + obj_tet, "m.obj:2", "1e100"));
    EXPECT_TRUE(refused("v 0 0 0\nv 1 0\n", "m.obj:2", "needs 3 coordinates, has 2"));
    EXPECT_TRUE(refused("v 0 0 0 nan\n" + obj_tet, "m.obj:1", "'nan'"));
}

TEST(ObjFile, RefusesFilesWithoutAMesh) {
    EXPECT_TRUE(refused("# nothing\n", "m.obj", "no vertices"));
    EXPECT_TRUE(refused(obj_points, "m.obj", "no polygon faces"));
    EXPECT_TRUE(refused(obj_points + "cstype bezier\ndeg 1 1\nsurf 0 1 0 1 1 2 3 4\nend\n", "m.obj", "free-form"));
    EXPECT_TRUE(refused(obj_points + "f 1 2\n", "m.obj", "no polygon faces"));
    EXPECT_TRUE(refused(std::string("v 0 0 0\nv\0 1", 13), "m.obj:2", "NUL byte"));
}

TEST(ObjFile, WarnsOnceAKindWithTheFirstLine) {
    std::string text = obj_tet;
    for (int i = 0; i < 100; ++i) text += "f 1 2\n";
    text += "p 1\nl 1 2\ncsh -rm x\ncall y.obj\nv 1 2 3 4 5\nnonsense 1\nv 1 1 1 2\nf 1 2 3 \\";
    EXPECT_EQ(warnings_of(parse_obj(text, "m.obj")),
              "9: 100 faces with fewer than 3 vertices ignored\n"
              "109: 2 point or line elements ignored\n"
              "111: 2 command statements ignored (first 'csh')\n"
              "113: extra numbers on a vertex ignored\n"
              "114: unknown statement ignored ('nonsense')\n"
              "115: vertex weight other than 1 ignored\n"
              "116: line continuation at the end of the file\n");
}

TEST(ObjFile, WarnsOfUnusedIndicesOutOfRange) {
    EXPECT_EQ(warnings_of(parse_obj(obj_points + "vt 0 0\nf 1/1 2/0 3/-2\n", "m.obj")), "6: 2 texture indices ignored (first 0)\n");
    EXPECT_EQ(warnings_of(parse_obj(obj_points + "f 1//1 2//2 3//3\nf 1//9 2//2 4//3\nvn 0 0 1\nvn 0 0 1\nvn 0 0 1\n", "m.obj")),
              "6: normal index ignored (9, the file has 3 normals)\n");
}

TEST(ObjFile, PolygonsOfAnySize) {
    std::string text;
    std::string face = "f";
    for (int i = 0; i < 1000; ++i) {
        text += "v " + std::to_string(std::cos(0.002 * std::numbers::pi * i)) + " " +
                std::to_string(std::sin(0.002 * std::numbers::pi * i)) + " 0\n";
        face += " " + std::to_string(i + 1);
    }
    const LoadedMesh loaded = parse_obj(text + face + "\n", "m.obj");   // tinyobjloader's own counts wrap at 255
    EXPECT_EQ(loaded.mesh.face_count(), 998);
    EXPECT_EQ(warnings_of(loaded), "");
}

TEST(ObjFile, RepeatedCornersOfAQuadAreOneCorner) {
    const LoadedMesh loaded = parse_obj(obj_points + "f 1 2 2 3\nf 1 2 3 1\nf 2 2 2 2\n", "m.obj");
    EXPECT_EQ(loaded.mesh.F, (Faces(2, 3) << 0, 1, 2, 0, 1, 2).finished());
    EXPECT_EQ(warnings_of(loaded), "5: 3 polygons with repeated corners, which are ignored\n7: face with fewer than 3 vertices ignored\n");
}

// assimp #3532: a Windows path ends in a backslash, and the next line was read as part of it.
TEST(ObjFile, ABackslashBehindANameSwallowsNoStatement) {
    for (const std::string line :
         {"g C:\\a\\", "o part\\ ", "usemtl a\\\r", "mtllib x\\", "s off\\", "vt 0 0\\", "vn 0 0 1 \\", "g\\", "x y\\", "l 1 2\\"}) {
        const LoadedMesh read = parse_obj(obj_points + line + "\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n", "m.obj");
        EXPECT_EQ(read.mesh.F, tetrahedron().F) << line;
        EXPECT_NE(warnings_of(read).find("5: \\ at the end of a line before a statement ignored"), std::string::npos) << line;
    }
    const std::string faces = "\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    EXPECT_EQ(warnings_of(parse_obj(obj_points + "g left \\\n right \\\nhand" + faces, "m.obj")), "") << "more of the name";
    EXPECT_EQ(warnings_of(parse_obj(obj_points + "# C:\\a\\" + faces, "m.obj")), "");
    EXPECT_EQ(parse_obj(obj_points + "g a \\\nb \\" + faces, "m.obj").mesh.F, tetrahedron().F);
    EXPECT_TRUE(refused(obj_points + "f 1 3 2\\" + faces, "m.obj:5", "'f'")) << "numbers go on";
    const LoadedMesh named = parse_obj(obj_points + "g C:\\a\\" + faces, "m.obj", Keep::attributes);
    EXPECT_EQ(warnings_of(parse_obj(encode_mesh(named.mesh, "m.obj", named.attributes), "m.obj")), "") << "written so that all read it";
}

// three.js #19254
TEST(ObjFile, ColoursOfSomeVerticesOrUpTo255AreKeptOrReported) {
    const auto colors = [](const std::string& first, const std::string& second) {
        const LoadedMesh read = parse_obj("v 0 0 0" + first + "\nv 1 0 0" + second + "\nv 0 1 0\nf 1 2 3\n", "m.obj", Keep::attributes);
        std::string told;
        for (const VertexColumn& column : read.attributes.columns)
            for (const double value : column.values) told += std::to_string(static_cast<int>(value)) + " ";
        return told + warnings_of(read);
    };
    const std::string white = "0: vertices without a colour, white in other formats than OBJ (";
    EXPECT_EQ(colors(" 0 1 0", ""), "0 255 255 255 255 255 0 255 255 " + white + "2)\n");
    EXPECT_EQ(colors(" 0 0.5 1", " 1 1 1 1"), "0 255 255 128 255 255 255 255 255 " + white + "1)\n");
    EXPECT_EQ(colors(" 0 128 255", " 1 2 3"),
              "0 1 255 128 2 255 255 3 255 0: colours above 1 are taken as from 0 to 255\n" + white + "1)\n");
    for (const std::string odd : {" 0 1.5 0", " 0 256 0", " -1 0 0", " 2 0.5 0"})
        EXPECT_EQ(colors(odd, ""), "0: colours are not kept: they are neither from 0 to 1 nor whole numbers up to 255\n") << odd;
    EXPECT_EQ(colors("", ""), "");
}
