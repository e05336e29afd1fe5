#include "mesh/io/mesh_files.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <limits>
#include <random>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "mesh/io/rejections.h"
#include "mesh/small_meshes.h"
#include "temporary_folder.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

/// Returns positions of all magnitudes, with bits that only exact decimals keep.
TriangleMesh awkward_mesh() {
    TriangleMesh mesh = torus(9, 7);
    std::mt19937_64 bits(1);
    for (double& x : mesh.X.reshaped()) x = std::ldexp(static_cast<double>(bits()) - 9e18, static_cast<int>(bits() % 300) - 150);
    mesh.X.row(0) << 0.1, -0.0, 5e-324;
    mesh.X.row(1) << 1e100, -1e100, std::numeric_limits<double>::min();
    return mesh;
}

bool same_bits(const Positions& A, const Positions& B) {
    return A.rows() == B.rows() && std::memcmp(A.data(), B.data(), sizeof(double) * static_cast<std::size_t>(A.size())) == 0;
}

}   // namespace

TEST(MeshFiles, WrittenMeshesReadBackBitForBit) {
    const TriangleMesh mesh = awkward_mesh();
    for (const char* file : {"a.obj", "a.off", "a.ply", "A.PLY"}) {
        const LoadedMesh loaded = parse_mesh(encode_mesh(mesh, file), file);
        EXPECT_TRUE(same_bits(loaded.mesh.X, mesh.X)) << file;
        EXPECT_EQ(loaded.mesh.F, mesh.F) << file;
        EXPECT_TRUE(loaded.warnings.empty()) << file;
        EXPECT_EQ(loaded.file, file);
        EXPECT_EQ(encode_mesh(loaded.mesh, file), encode_mesh(mesh, file));
    }
}

TEST(MeshFiles, AWrittenFileReadsBack) {
    const testing_tools::TemporaryFolder folder;
    const auto path = folder.path() / "through.ply";
    write_mesh(path, awkward_mesh());
    EXPECT_TRUE(same_bits(read_mesh(path).mesh.X, awkward_mesh().X));
    std::filesystem::remove(path);
    EXPECT_THROW(read_mesh(path), InputError);
    EXPECT_THROW(write_mesh("/nowhere/at/all.obj", tetrahedron()), OutputError);
}

TEST(MeshFiles, WritesOnlyMeshesThatItCanRead) {
    EXPECT_THROW(encode_mesh(tetrahedron(), "a.fbx"), UsageError);
    EXPECT_THROW(encode_mesh(tetrahedron(), "a.obj.gz"), UsageError);
    EXPECT_THROW(encode_mesh(tetrahedron(), "a"), UsageError);
    TriangleMesh mesh = tetrahedron();
    mesh.X(2, 1) = std::nan("");
    EXPECT_THROW(encode_mesh(mesh, "a.obj"), MeshError);
    mesh = tetrahedron();
    mesh.X(1, 2) = -1.01e100;
    EXPECT_THROW(encode_mesh(mesh, "a.obj"), MeshError) << "it could not be read again";
    mesh.X(1, 2) = 1e39;
    EXPECT_THROW(encode_mesh(mesh, "a.stl"), MeshError) << "no float is that large";
}

// STL keeps every bit of floats; vertices come in the order of the triangles.
TEST(MeshFiles, StlHoldsTheSameTriangles) {
    TriangleMesh mesh = torus(9, 7);
    mesh.X = mesh.X.cast<float>().cast<double>();
    const LoadedMesh loaded = parse_mesh(encode_mesh(mesh, "a.stl"), "a.stl");
    EXPECT_TRUE(loaded.warnings.empty());
    ASSERT_EQ(loaded.mesh.vertex_count(), mesh.vertex_count());
    for (int t = 0; t < mesh.face_count(); ++t) {
        for (int k = 0; k < 3; ++k) EXPECT_EQ(loaded.mesh.X.row(loaded.mesh.F(t, k)), mesh.X.row(mesh.F(t, k)));
    }
    EXPECT_EQ(encode_mesh(loaded.mesh, "a.stl"), encode_mesh(mesh, "a.stl"));
    EXPECT_EQ(encode_mesh(mesh, "a.stl").size(), 84U + 50U * static_cast<unsigned>(mesh.face_count()));
}

TEST(MeshFiles, TheFormatOfStandardInputIsFoundByItsContent) {
    for (const char* file : {"m.obj", "m.off", "m.ply", "m.stl"}) {
        const std::string bytes = encode_mesh(tetrahedron(), file);
        EXPECT_EQ(parse_mesh(bytes, standard_input).mesh.X.colwise().sum(), tetrahedron().X.colwise().sum()) << file;
    }
    EXPECT_EQ(encode_mesh(tetrahedron(), "-"), encode_mesh(tetrahedron(), "a.obj"));
    EXPECT_TRUE(refused("", "standard input", "file is empty"));
    EXPECT_TRUE(refused("v 0 0 0\nv 1 x 0\n", "standard input:2", "'x' is not a finite number"));
}

TEST(MeshFiles, RefusesOtherKindsOfFiles) {
    EXPECT_TRUE(refused("", "m.obj", "file is empty"));
    EXPECT_TRUE(refused("v 0 0 0\n", "m.gz", "unknown mesh format ''"));
    EXPECT_TRUE(refused("v 0 0 0\n", "mesh", "unknown mesh format"));
    EXPECT_TRUE(refused("PK\x03\x04 data", "m.obj", "ZIP"));
    EXPECT_TRUE(refused("\x1f\x8b data", "m.stl", "damaged gzip"));
    EXPECT_TRUE(refused("version https://git-lfs.github.com/spec/v1\n", "m.ply", "LFS"));
    EXPECT_TRUE(refused("\xff\xfev\0", "m.obj", "UTF-16"));
    EXPECT_TRUE(refused("\n <!DOCTYPE html><html>", "m.off", "HTML"));
    EXPECT_TRUE(refused("<?xml version=\"1.0\"?>", "m.ply", "XML"));
}

TEST(MeshFiles, RefusesAFormatUnderTheNameOfAnother) {
    for (const char* writer : {"a.obj", "a.off", "a.ply"}) {
        const std::string bytes = encode_mesh(tetrahedron(), writer);
        for (const char* reader : {"b.obj", "b.off", "b.ply", "b.stl"}) {
            if (std::string(writer).substr(1) == std::string(reader).substr(1)) continue;
            EXPECT_TRUE(refused(bytes, reader, "but the name says")) << writer << " as " << reader;
        }
    }
    EXPECT_TRUE(refused("solid x\nfacet", "b.obj", "looks like STL"));
}

TEST(MeshFiles, MessagesAreOneHarmlessLineForAnyFile) {
    const std::string message = refusal("v 0 0 \x1b[31m\xe2\x80\xae" + std::string(5000, 'x') + "\n", "m.obj");
    EXPECT_EQ(message.find('\x1b'), std::string::npos);
    EXPECT_EQ(message.find("\xe2\x80\xae"), std::string::npos);
    EXPECT_LT(message.size(), 300U);
}
