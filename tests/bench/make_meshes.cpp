// make_meshes MESH FOLDER LEVEL…: FOLDER/<level>.ply for each level, the mesh subdivided so often, as every peer can read it
// (binary, float coordinates). Prints the number of triangles of each.
#include <cstdio>
#include <cstring>
#include <exception>
#include <fstream>

#include "bench/bench_meshes.h"

namespace {

template <class T> void append(std::string& bytes, const T& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); }

std::string float_ply(const bench::BenchMesh& mesh) {
    std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.positions.size()) +
                        "\nproperty float x\nproperty float y\nproperty float z\nelement face " + std::to_string(mesh.triangles.size()) +
                        "\nproperty list uchar int vertex_indices\nend_header\n";
    for (const glm::dvec3& p : mesh.positions) append(bytes, glm::vec3(p));
    for (const glm::ivec3& t : mesh.triangles) {
        append(bytes, std::uint8_t{3});
        append(bytes, t);
    }
    return bytes;
}

void write(const std::string& path, const std::string& bytes) {
    std::ofstream file(path, std::ios::binary);
    file << bytes;
    if (!file.flush()) throw std::runtime_error("cannot write " + path);
}

}   // namespace

int main(int count, char** arguments) try {
    if (count < 4) throw std::invalid_argument("usage: make_meshes MESH FOLDER LEVEL…");
    bench::BenchMesh mesh = bench::read_bench_mesh(arguments[1]);
    int reached = 0;
    for (int i = 3; i < count; ++i) {
        const int level = std::stoi(arguments[i]);
        if (level < reached && level != -1) throw std::invalid_argument("make_meshes: levels must ascend, after -1");
        for (; reached < level; ++reached) mesh = bench::subdivided(mesh);
        const bench::BenchMesh written = level == -1 ? bench::quartered(mesh) : mesh;
        write(std::string(arguments[2]) + "/" + std::to_string(level) + ".ply", float_ply(written));
        std::printf("%zu\n", written.triangles.size());
    }
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
