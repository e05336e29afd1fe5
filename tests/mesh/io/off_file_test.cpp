#include <gtest/gtest.h>

#include "mesh/io/mesh_files.h"
#include "mesh/io/rejections.h"
#include "mesh/small_meshes.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

const std::string off_points = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
const std::string off_faces = "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
const std::string off_tet = "OFF\n4 4 6\n" + off_points + off_faces;   // faces on lines 7 to 10

void expect_in_off(const std::string& text, const std::string& warnings = "") {
    expect_tetrahedron(parse_off(text, "m.off"), warnings, text);
}

}   // namespace

TEST(OffFile, TheSameTetrahedronInManySpellings) {
    expect_in_off(off_tet);
    expect_in_off("\xef\xbb\xbf" + off_tet);
    expect_in_off("OFF 4 4 0\n" + off_points + off_faces);
    expect_in_off("# c\nOFF # c\n\n4 4 0 # c\n" + off_points + "# c\n" + off_faces + "\n# the end");
    expect_in_off("OFF\r\n4\t4 6\r\n0\n0 0\r\n1 0 0\n0 1\n0\n0 0 1\n3 0 2 1 7\n3 0\n1 3\n3 0 3 2 255 0 0\n3 1 2 3 0.1 0.2 0.3 1");
    expect_in_off("NOFF\n4 4 6\n0 0 0 0 0 1\n1 0 0 nan 0 1\n0 1 0 0 0 1\n0 0 1 0 0 1\n" + off_faces);
    expect_in_off("STCNOFF\n4 4 6\n0 0 0 0 0 1 1 1 1 1 0 0\n1 0 0 0 0 1 1 1 1 1 0 0\n0 1 0 0 0 1 1 1 1 1 0 0\n0 0 1 0 0 1 1 1 1 1 0 0\n" +
                  off_faces);
    expect_in_off("COFF\n4 4 6\n0 0 0 255 0 0 255\n1 0 0 0 0 0 1\n0 1 0 0 0 0 1\n0 0 1 0 0 0 1\n" + off_faces);
}

TEST(OffFile, WarnsOfDefectsThatItAccepts) {
    expect_in_off("4 4 6\n" + off_points + off_faces, "1: no OFF keyword, assumed\n");
    expect_in_off("OFF\n4 4\n" + off_points + off_faces, "2: edge count missing\n");
    expect_in_off(off_tet + "3 0 1 2\n", "11: text after the last face ignored\n");
    expect_in_off("OFF\n4 5 0\n" + off_points + off_faces + "2 0 1\n", "11: face with fewer than 3 vertices ignored\n");
    expect_in_off("OFF\n4 4 0\n0 0 0 1\n1 0 0 1\n0 1 0\n0 0 1\n" + off_faces, "3: 2 vertices with extra numbers, which are ignored\n");
}

TEST(OffFile, FacesKnowTheirLines) { EXPECT_EQ(parse_off(off_tet, "m.off").face_lines, (std::vector<long>{7, 8, 9, 10})); }

TEST(OffFile, RefusesBadHeaders) {
    EXPECT_TRUE(refused("OFF\n", "m.off", "no counts"));
    EXPECT_TRUE(refused("4OFF\n4 4 6\n", "m.off:1", "4OFF"));
    EXPECT_TRUE(refused("nOFF\n3 4 4 6\n", "m.off:1", "nOFF"));
    EXPECT_TRUE(refused("OFFICE\n4 4 6\n", "m.off:1", "not an OFF keyword"));
    EXPECT_TRUE(refused(std::string(5000, 'X') + "\n4 4 6\n", "m.off:1", "not an OFF keyword"));
    EXPECT_TRUE(refused(std::string("OFF BINARY\n\0\0\0\4", 15), "m.off:1", "binary OFF"));
    EXPECT_TRUE(refused("OFF\nfour 4 6\n" + off_points + off_faces, "m.off:2", "bad vertex count 'four'"));
    EXPECT_TRUE(refused("OFF\n4 4 x\n" + off_points + off_faces, "m.off:2", "bad edge count"));
}

TEST(OffFile, RefusesImpossibleCountsAtOnce) {
    for (const char* counts : {"-1 4 6", "4 -1 6", "0 4 6", "2147483648 4 0", "4 2147483648 0", "768614336404564651 4 0", "1000 4 0"}) {
        EXPECT_TRUE(refused("OFF\n" + std::string(counts) + "\n" + off_points + off_faces, "m.off:2", "impossible counts")) << counts;
    }
    EXPECT_TRUE(refused("OFF\n4 99999999999999999999 6\n" + off_points + off_faces, "m.off:2", "bad face count"));
}

TEST(OffFile, RefusesMissingAndBadData) {
    EXPECT_TRUE(refused("OFF\n4 5 6\n" + off_points + off_faces, "m.off:2", "5 faces announced, file ends after 4"));
    EXPECT_TRUE(refused("OFF\n5 4 6\n" + off_points + off_faces, "m.off:2", "4 faces announced, file ends after 3"));
    EXPECT_TRUE(refused("OFF\n4 4 6\n" + off_points + "3 0 2 1\n3 0 1 3\n3 0 3 2\n4 1 2 3\n", "m.off:10", "face of 4 corners has 3"));
    EXPECT_TRUE(refused("OFF\n4 4 6\n" + off_points + "3 0 2 1\n4 0 1 3\n3 0 3 2\n3 1 2 3\n", "m.off:8", "fewer corners"));
    EXPECT_TRUE(refused("OFF\n4 4 6\n" + off_points + "4 0 2 1\n3 0 1 3\n3 0 3 2\n4 1 2 3\n", "m.off:7", "face of 4 corners"));
    EXPECT_TRUE(refused("OFF\n4 1 6\n0 0 0\n1 0 0\n0 1 0\n   0       0 ", "m.off:6", "ends early"));
    EXPECT_TRUE(refused("NOFF\n4 4 6\n" + off_points + off_faces, "m.off:3", "needs 6 numbers, has 3"));
    for (const char* index : {"4", "-1", "3.0", "4294967298", "x"}) {
        EXPECT_TRUE(
            refused("OFF\n4 4 6\n" + off_points + "3 0 2 1\n3 0 1 " + index + "\n3 0 3 2\n3 1 2 3\n", "m.off:8", "is not a valid index"));
    }
    EXPECT_TRUE(refused("OFF\n4 4 6\n" + off_points + "2147483648 0 2 1\n" + off_faces, "m.off:7", "number of corners"));
    for (const char* number : {"nan", "0,5", "1e999", "1e101"}) {
        EXPECT_TRUE(refused("OFF\n4 4 6\n0 0 0\n1 0 " + std::string(number) + "\n0 1 0\n0 0 1\n" + off_faces, "m.off:4", "")) << number;
    }
}

TEST(OffFile, PointsWithoutFacesAreReported) {
    EXPECT_TRUE(refused("OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", "m.off:2", "no faces (3 vertices alone)"));
    EXPECT_TRUE(refused("COFF 1 0 0\n0 0 0 1 1 1\n", "m.off:1", "no faces (1 vertex alone)"));
    EXPECT_TRUE(refused("OFF\n0 0 0\n", "m.off:2", "no faces (0 vertices alone)"));
    EXPECT_TRUE(refused("OFF\n900 0 0\n0 0 0\n", "m.off:2", "impossible counts"));
    EXPECT_TRUE(refused("OFF\n-3 0 0\n0 0 0\n", "m.off:2", "impossible counts"));
}
