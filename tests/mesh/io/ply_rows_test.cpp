#include "mesh/io/ply_rows.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

#include "mesh/io/append_bytes.h"
#include "mesh/io/mesh_files.h"
#include "mesh/io/rejections.h"
#include "mesh/small_meshes.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

/// A grid of points with floats as coordinates and an odd property on either side of them, and of each face's corners.
struct GridFile {
    TriangleMesh mesh = flat_grid(150, 200);
    int corners = 3;                      // that each face says it has
    std::string count = "uchar", after;   // type of the list's length; bytes behind the last row
    bool with_extras = true;

    std::string text() const {
        std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.vertex_count()) + "\n" +
                            (with_extras ? "property uchar red\n" : "") + "property float x\nproperty float y\nproperty float z\n" +
                            (with_extras ? "property double quality\n" : "") + "element face " + std::to_string(mesh.face_count()) + "\n" +
                            (with_extras ? "property short flags\n" : "") + "property list " + count + " int vertex_indices\nend_header\n";
        for (int v = 0; v < mesh.vertex_count(); ++v) {
            if (with_extras) append(bytes, std::uint8_t{200});
            for (int axis = 0; axis < 3; ++axis) append(bytes, static_cast<float>(mesh.X(v, axis)));
            if (with_extras) append(bytes, 0.25);
        }
        for (int t = 0; t < mesh.face_count(); ++t) {
            if (with_extras) append(bytes, std::int16_t{-3});
            if (count == "uchar") append(bytes, static_cast<std::uint8_t>(corners));
            if (count == "int") append(bytes, static_cast<std::int32_t>(corners));
            for (int k = 0; k < 3; ++k) append(bytes, mesh.F(t, k));
        }
        return bytes + after;
    }
};

std::optional<PlyTriangles> at_once(const std::string& bytes) {
    const PlyHeader header = parse_ply_header(bytes, "m.ply");
    return read_triangle_rows(bytes, header, mesh_parts(header, "m.ply"));
}

}   // namespace

TEST(PlyRows, AreReadAtOnceAsOneByOne) {
    for (const bool with_extras : {false, true}) {
        GridFile file;
        file.with_extras = with_extras;
        const auto rows = at_once(file.text());
        ASSERT_TRUE(rows.has_value());
        EXPECT_EQ(rows->end, file.text().size());
        EXPECT_EQ(rows->mesh.X, file.mesh.X);
        EXPECT_EQ(rows->mesh.F, file.mesh.F);
        file.count = "int";   // goes value by value
        EXPECT_FALSE(at_once(file.text()).has_value());
        const LoadedMesh loaded = parse_ply(file.text(), "m.ply");
        EXPECT_EQ(loaded.mesh.X, file.mesh.X);
        EXPECT_EQ(loaded.mesh.F, file.mesh.F);
    }
}

TEST(PlyRows, BytesBehindTheLastAreWarnedOf) {
    GridFile file;
    file.after = "abc";
    EXPECT_EQ(warnings_of(parse_ply(file.text(), "m.ply")), "0: bytes after the last element ignored (3)\n");
}

// What the quick way leaves alone is refused by the careful one, with the row.
TEST(PlyRows, FaultsAnywhereAreNamed) {
    for (const int t : {0, 20'000, flat_grid(150, 200).face_count() - 1}) {
        GridFile file;
        file.mesh.F(t, 1) = 30'000;
        EXPECT_EQ(refusal(file.text(), "m.ply"),
                  "m.ply: face " + std::to_string(t) + ": index 30000 out of range (30000 vertices); indices are whole numbers from 0");
        file.mesh.F(t, 1) = -1;
        EXPECT_EQ(refusal(file.text(), "m.ply"),
                  "m.ply: face " + std::to_string(t) + ": index -1 out of range (30000 vertices); indices are whole numbers from 0");
    }
    for (const int v : {0, 17'000, 29'999}) {
        GridFile file;
        file.mesh.X(v, 1) = std::numeric_limits<double>::quiet_NaN();
        EXPECT_EQ(refusal(file.text(), "m.ply"), "m.ply: vertex " + std::to_string(v) + ": y is nan; every coordinate must be finite");
        file.mesh.X(v, 1) = -std::numeric_limits<double>::infinity();
        EXPECT_EQ(refusal(file.text(), "m.ply"), "m.ply: vertex " + std::to_string(v) + ": y is inf; every coordinate must be finite");
    }
}

TEST(PlyRows, CutFilesAndOtherPolygonsAreLeftToTheCarefulReader) {
    const std::string whole = GridFile().text();
    for (const std::size_t less : {1, 5, 13, 300'000}) {
        EXPECT_FALSE(at_once(whole.substr(0, whole.size() - less)).has_value());
        EXPECT_NE(refusal(whole.substr(0, whole.size() - less), "m.ply"), "accepted");
    }
    GridFile quads;
    quads.corners = 4;
    EXPECT_FALSE(at_once(quads.text()).has_value());
}
