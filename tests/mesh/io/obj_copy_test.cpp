// An OBJ file written with other positions keeps everything else.
#include <gtest/gtest.h>

#include "base/number_text.h"
#include "mesh/io/mesh_files.h"
#include "mesh/io/rejections.h"
#include "mesh/io/text_scanner.h"
#include "mesh/mesh_checks.h"
#include "mesh/triangle_measures.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

PreparedMesh prepared(const std::string& text) { return prepare_mesh(parse_obj(text, "m.obj", Keep::attributes)); }

/// Returns the OBJ written with the positions X, or with its own.
std::string copied(const PreparedMesh& of, const Positions& X) { return encode_mesh(moved_to(of.mesh, X), "m.obj", of.attributes); }
std::string copied(const std::string& text) { return copied(prepared(text), prepared(text).mesh.X); }

/// Returns the lines that begin with the keyword.
std::string lines_of(const std::string& text, const std::string& keyword) {
    std::string found;
    LineScanner lines(text);
    while (lines.next()) {
        std::string_view rest = lines.line();
        if (take_word(rest) == keyword) found += std::string(lines.line()) + "\n";
    }
    return found;
}

const std::string corner = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";

}   // namespace

TEST(ObjCopy, EverythingButPositionsStays) {
    const std::string text =
        "# a cube's corner\nmtllib a.mtl\no thing\n\nv 0 0 0 0.5 0.25 1\nv 1 0 0 1 0 0 # first\nv 0 1 0 0 1 0\r\nv 0 0 1 0 0 1\n"
        "vt 0 0\nvt 1 0\nvt 0.5 1 # tip\ng side\nusemtl red\ns 1\nf 1/1 3/2 2/3\nf 1/1 2/2 4/3\n# between\ng other\nusemtl blue\n"
        "f -4/-3 -1/-2 -2/-1\nf 2/1 3/2 4/3\nl 1 2\n# end";
    const PreparedMesh mesh = prepared(text);
    const std::string copy = copied(mesh, 2 * mesh.mesh.X);
    for (const char* keyword : {"#", "mtllib", "o", "vt", "g", "usemtl", "s", "f", "l"})
        EXPECT_EQ(lines_of(copy, keyword), lines_of(text, keyword)) << copy;
    EXPECT_EQ(lines_of(copy, "v"), "v 0 0 0 0.5 0.25 1\nv 2 0 0 1 0 0 \nv 0 2 0 0 1 0\nv 0 0 2 0 0 1\n") << "colours too";
    EXPECT_EQ(parse_mesh(copy, "m.obj").mesh.X, 2 * mesh.mesh.X);
    EXPECT_EQ(parse_mesh(copy, "m.obj").mesh.F, mesh.mesh.F);
    EXPECT_EQ(copied(copied(text)), copied(text));
}

TEST(ObjCopy, LinesEndInOneWay) {
    const std::string text = corner + "vt 0 0\ng side # a\nf 1/1 2/1 3/1\nl 1 2\n";
    std::string windows;
    for (const char c : text) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
    EXPECT_EQ(copied(windows), copied(text));
}

TEST(ObjCopy, PolygonsStayWhereTheyFallIntoTheSameTriangles) {
    const std::string flat = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nf 1 2 3 4\n";
    PreparedMesh mesh = prepared(flat);
    EXPECT_EQ(copied(mesh, 3 * mesh.mesh.X), "v 0 0 0\nv 6 0 0\nv 6 6 0\nv 0 6 0\nf 1 2 3 4\n");
    Positions dented = mesh.mesh.X;
    dented.row(3) << 1.5, 0.5, 0;   // beyond the diagonal that was cut along
    const std::string copy = copied(mesh, dented);
    EXPECT_EQ(lines_of(copy, "f"), "f 1 2 3\nf 1 3 4\n");
    EXPECT_EQ(parse_mesh(copy, "m.obj").mesh.F, mesh.mesh.F);
    EXPECT_NE(parse_mesh("v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1.5 .5 0\nf 1 2 3 4\n", "m.obj").mesh.F, mesh.mesh.F)
        << "it would have been another";
}

TEST(ObjCopy, RepairsAreWritten) {
    const std::string turned = corner + "f 1/1 3/2 2/3\nf 1/1 4/2 2/3\nf 1 4 3\nf 2 3 4\nf 2 2 3\nf 3 4 2\nvt 0 0\nvt 1 0\nvt 0 1\n";
    const PreparedMesh mesh = prepared(turned);
    EXPECT_EQ(mesh.preflight.flipped_faces, 1);
    EXPECT_EQ(mesh.mesh.face_count(), 4);
    const std::string copy = copied(turned);
    EXPECT_EQ(lines_of(copy, "f"), "f 1/1 3/2 2/3\nf 1/1 2/3 4/2\nf 1 4 3\nf 2 3 4\n");
    EXPECT_EQ(warnings_of(parse_mesh(copy, "m.obj")), "");
    EXPECT_EQ(parse_mesh(copy, "m.obj").mesh.F, mesh.mesh.F);
}

// A normal of one face alone becomes the normal of that face; a shared one becomes the mean, by area, of the faces around the vertex.
TEST(ObjCopy, NormalsAreThoseOfTheNewSurface) {
    const std::string flat = corner +
                             "vn 1 0 0\nvn 0 1 0\nvn 0 0 1\nvn 1 1 1\nf 1//1 3//1 2//1\nf 1//2 2//2 4//2\nf 1//3 4//3 3//3\n"
                             "f 2//4 3//4 4//4\n";
    const PreparedMesh mesh = prepared(flat);
    const std::string copy = copied(mesh, mesh.mesh.X);
    EXPECT_EQ(lines_of(copy, "vn").substr(0, 30), "vn 0 0 -1\nvn 0 0 -1\nvn 0 0 -1\n");
    EXPECT_EQ(lines_of(copy, "f").substr(0, 51), "f 1//1 3//2 2//3\nf 1//4 2//5 4//6\nf 1//7 4//8 3//9\n");
    const PreparedMesh smooth = prepared(corner + "vn 0 0 1\nf 1//1 3//1 2//1\nf 1//-1 2//1 4//1\nf 1//1 4//1 3//1\nf 2//1 3//1 4//1\n");
    const Positions X = smooth.mesh.X * Vector3(1, 2, 3).asDiagonal();
    const Positions normals = vertex_normals(moved_to(smooth.mesh, X));
    std::string expected;
    for (const int v : {0, 2, 1, 3}) {
        expected += "vn";
        for (int k = 0; k < 3; ++k) expected += ' ' + plain_text(normals(v, k));
        expected += '\n';
    }
    EXPECT_EQ(lines_of(copied(smooth, X), "vn"), expected);
    EXPECT_EQ(warnings_of(parse_mesh(copied(smooth, X), "m.obj")), "");
}

TEST(ObjCopy, OddTextsHoldTheSameMesh) {
    for (const std::string& text : std::vector<std::string>{
             "\xef\xbb\xbf" + corner + "f 1 3 2 \\\n 4 # c\nf 1 2 4", corner + "fo 1 3 2\ncsh rm\ncall x.obj\nf 1 2\nf 1 2 2 4 4\n",
             "v 0 0 \\\n 0\r\nv 1 0 0 2\rv 0 1 0\nf 1 2 3\nv 0 0 1\nf -1 -2 -3", corner + "f 1//9 2//0 3//-9\nf 1/7/7 2/8/9 4\n"}) {
        const PreparedMesh mesh = prepared(text);
        const std::string copy = copied(text);
        const PreparedMesh again = prepared(copy);
        EXPECT_EQ(again.mesh.X, mesh.mesh.X) << copy;
        EXPECT_EQ(again.mesh.F, mesh.mesh.F) << copy;
        EXPECT_EQ(lines_of(copy, "csh") + lines_of(copy, "call"), "") << "no commands";
    }
}
