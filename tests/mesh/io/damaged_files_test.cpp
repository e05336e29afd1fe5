// Small files of each format, damaged at every byte, give a sound mesh or one line about the file.
#include <gtest/gtest.h>

#include <cstdint>

#include "base/errors.h"
#include "damaged_bytes.h"
#include "mesh/io/append_bytes.h"
#include "mesh/io/glb/glb_bytes.h"
#include "mesh/io/mesh_files.h"
#include "mesh/mesh_checks.h"
#include "mesh/small_meshes.h"

using namespace meshfolio;
using namespace meshfolio::testing;
using testing_tools::for_each_damage;
using testing_tools::is_one_line_about;

namespace {

std::string ply_of(const TriangleMesh& mesh, bool big_endian, bool quality) {
    std::string bytes = std::string("ply\nformat binary_") + (big_endian ? "big" : "little") +
                        "_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n" +
                        (quality ? "property list uchar short quality\n" : "") +
                        "element face 4\nproperty list uchar int vertex_indices\nend_header\n";
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        for (int k = 0; k < 3; ++k) append(bytes, static_cast<float>(mesh.X(v, k)), big_endian);
        if (!quality) continue;
        append(bytes, std::uint8_t{1});
        append(bytes, std::int16_t{7}, big_endian);
    }
    for (int t = 0; t < mesh.face_count(); ++t) {
        append(bytes, std::uint8_t{3});
        for (int k = 0; k < 3; ++k) append(bytes, static_cast<std::int32_t>(mesh.F(t, k)), big_endian);
    }
    return bytes;
}

std::string binary_stl_of(const TriangleMesh& mesh) {
    std::string bytes(80, '\0');
    append(bytes, static_cast<std::uint32_t>(mesh.face_count()));
    for (int t = 0; t < mesh.face_count(); ++t) {
        bytes.append(12, '\0');
        for (int k = 0; k < 3; ++k) {
            for (int axis = 0; axis < 3; ++axis) append(bytes, static_cast<float>(mesh.X(mesh.F(t, k), axis)));
        }
        bytes.append(2, '\0');
    }
    return bytes;
}

std::vector<std::pair<std::string, std::string>> good_files() {
    const TriangleMesh mesh = tetrahedron();
    const std::string obj = encode_mesh(mesh, "m.obj"), off = encode_mesh(mesh, "m.off");
    const std::string numbers = off.substr(off.find(" 0\n") + 3);
    return {
        {"m.obj", obj},
        {"all.obj",
         "\xef\xbb\xbf# c\nmtllib a\nv 0 0 0 1\nv 1 0 \\\n0\nv 0 1 0 .5 .5 .5\nv 0 0 1\nvt 0 0\nvn 0 0 1\ng a\nf 1/1/1 3/1/1 2/1/1\nf "
         "1//1 2//1 -1//1\nf 1/1 4/1 3/1\nf 2 3 4 2\np 1\n"},
        {"m.off", off},
        {"m.ply", encode_mesh(mesh, "m.ply")},
        {"ascii.ply",
         "ply\nformat ascii 1.0\ncomment c\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
         "element face 4\nproperty list uchar int vertex_indices\nend_header\n" +
             numbers},
        {"little.ply", ply_of(mesh, false, true)},
        {"big.ply", ply_of(mesh, true, false)},
        {"m.stl", binary_stl_of(mesh)},
        {"m.glb", glb_of(glb_text(mesh, R"(,"translation":[1,2,3],"scale":[1,1,2])"), glb_data(mesh))},
        {"ascii.stl",
         "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nfacet normal 0 0 -1\n"
         "outer loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 1 0 1\nendloop\nendfacet\nendsolid s\n"},
    };
}

/// True if the bytes are accepted.
bool read_and_judge(const std::string& file, const std::string& bytes) {
    try {
        const PreparedMesh mesh = prepare_mesh(parse_mesh(bytes, file));
        EXPECT_TRUE(mesh.mesh.X.allFinite());
        EXPECT_GT(mesh.mesh.face_count(), 0);
        EXPECT_TRUE(mesh.mesh.F.minCoeff() >= 0 && mesh.mesh.F.maxCoeff() < mesh.mesh.vertex_count());
        EXPECT_LE(mesh.warnings.size(), 20u);
        for (const MeshWarning& warning : mesh.warnings) EXPECT_TRUE(is_one_line_about("", warning.message));
        return true;
    } catch (const Error& error) {
        EXPECT_EQ(error.exit_code(), ExitCode::input) << error.what();
        EXPECT_TRUE(is_one_line_about(file, error.what()));
        EXPECT_NE(std::string(error.what()).find("; "), std::string::npos) << "without a remedy: " << error.what();
        return false;
    }
}

}   // namespace

TEST(DamagedFiles, GiveAMeshOrOneLineOfError) {
    for (const auto& [file, bytes] : good_files()) {
        SCOPED_TRACE(file);
        EXPECT_TRUE(read_and_judge(file, bytes));
        int refused = 0, taken = 0;
        for_each_damage(bytes, [&, &file = file](const std::string& damaged) { ++(read_and_judge(file, damaged) ? taken : refused); });
        EXPECT_GT(refused, static_cast<int>(bytes.size())) << "each truncation but the last few";
        EXPECT_GT(taken, 0);
        if (HasFailure()) return;
    }
}

// A file cut off anywhere before its last face must be refused: half a mesh is not a mesh. (An OBJ or ASCII STL cut off at the end of a
// line is a complete file of another mesh, which no reader can notice.)
TEST(DamagedFiles, TruncationIsNotSilent) {
    for (const auto& [file, bytes] : good_files()) {
        if (file.ends_with(".obj") || file == "ascii.stl") continue;
        for (std::size_t end = 0; end + 8 < bytes.size(); ++end)
            EXPECT_FALSE(read_and_judge(file, bytes.substr(0, end))) << file << " " << end;
    }
}

// Each limit of the readers is named in the message about input beyond it.
TEST(DamagedFiles, LimitsAreNamed) {
    const auto refusal = [](const std::string& file, const std::string& text) {
        try {
            parse_mesh(text, file);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string("accepted");
    };
    std::string polygon = "f";
    std::string points;
    for (int i = 1; i <= 32769; ++i) {
        points += "v " + std::to_string(i) + " " + std::to_string(i % 7) + " 0\n";
        polygon += " " + std::to_string(i);
    }
    EXPECT_NE(refusal("m.obj", points + polygon).find("m.obj:32770: polygon of 32769 corners (limit 32768)"), std::string::npos);
    EXPECT_NE(refusal("m.obj", "v 1.1e100 0 0\n").find("m.obj:1: coordinate out of the supported range (1e100)"), std::string::npos);
    EXPECT_NE(refusal("m.ply", "ply\nformat ascii 1.0\nelement vertex 2147483648\n").find("from 0 to 2147483647"), std::string::npos);
}
