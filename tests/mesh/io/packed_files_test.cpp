// Meshes packed by gzip are recognised by their content, not by their names.
#include <gtest/gtest.h>
#include <libdeflate.h>

#include "base/gunzipped.h"
#include "mesh/io/glb/glb_bytes.h"
#include "mesh/io/mesh_files.h"
#include "mesh/io/rejections.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

std::string packed(const std::string& bytes, int level = 6) {
    libdeflate_compressor* const compressor = libdeflate_alloc_compressor(level);
    std::string gzip(libdeflate_gzip_compress_bound(compressor, bytes.size()), '\0');
    gzip.resize(libdeflate_gzip_compress(compressor, bytes.data(), bytes.size(), gzip.data(), gzip.size()));
    libdeflate_free_compressor(compressor);
    return gzip;
}

}   // namespace

TEST(PackedFiles, EveryFormatReadsAsThePlainOne) {
    for (const char* file : {"m.obj", "m.off", "m.ply", "m.stl"}) {
        const std::string bytes = encode_mesh(tetrahedron(), file);
        const LoadedMesh plain = parse_mesh(bytes, file);
        for (const std::string& name : {std::string(file), std::string(file) + ".gz", "A." + std::string(file) + ".GZ"}) {
            const LoadedMesh read = parse_mesh(packed(bytes), name);
            EXPECT_EQ(read.mesh.X, plain.mesh.X) << name;
            EXPECT_EQ(read.mesh.F, plain.mesh.F) << name;
            EXPECT_TRUE(is_mesh_file(name));
        }
    }
    const std::string glb = glb_of(glb_text(tetrahedron()), glb_data(tetrahedron()));
    expect_tetrahedron(parse_mesh(packed(glb), "m.glb.gz"));
    EXPECT_EQ(mesh_name("folder.gz/cow.obj.gz"), "cow");
    EXPECT_FALSE(is_mesh_file("notes.txt.gz"));
    EXPECT_TRUE(refused(packed("v"), "m.gz", "unknown mesh format ''"));
}

TEST(PackedFiles, MembersFollowOneAnother) {
    const std::string bytes = encode_mesh(tetrahedron(), "m.off");
    const std::string end = packed(bytes.substr(bytes.size() - 3)), begin = packed(bytes.substr(0, bytes.size() - 3));
    EXPECT_EQ(gunzipped(begin + end, ""), bytes);
    EXPECT_EQ(gunzipped(end + begin, ""), bytes.substr(bytes.size() - 3) + bytes.substr(0, bytes.size() - 3));
    EXPECT_EQ(gunzipped(packed(""), ""), "");
}

TEST(PackedFiles, DamageAndBombsAreRefused) {
    const std::string gzip = packed(encode_mesh(tetrahedron(), "m.obj"));
    for (std::size_t end = 2; end < gzip.size(); ++end) EXPECT_TRUE(refused(gzip.substr(0, end), "m.obj", "damaged gzip")) << end;
    EXPECT_TRUE(refused(gzip + "more", "m.obj", "damaged gzip"));
    for (std::size_t at = 10; at < gzip.size(); ++at) {
        std::string damaged = gzip;
        damaged[at] = static_cast<char>(damaged[at] ^ 1);
        EXPECT_NE(refusal(damaged, "m.obj"), "accepted") << at;
    }
    EXPECT_TRUE(refused(packed(std::string(8 << 20, 'v')), "m.obj", "unpack to more than"));
    EXPECT_TRUE(refused(packed(gzip), "m.obj", "gzip data within gzip data"));
    EXPECT_TRUE(refused(packed("PK\x03\x04"), "m.obj.gz", "ZIP"));
}
