// six_views MESH: draws the mesh from six sides and prints how far an explicit smoothing step may go.
#include <cstdio>
#include <glm/vec3.hpp>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "draw_mesh.h"
#include "geometry/operators/cotangent_laplacian.h"
#include "geometry/spectrum/stability.h"
#include "mesh/mesh_checks.h"
#include "png/png.h"

int main(int argc, char** argv) try {
    if (argc != 2) throw meshfolio::UsageError("give one mesh", "six_views MESH");
    const meshfolio::TriangleMesh mesh = meshfolio::prepare_mesh(meshfolio::read_mesh(argv[1])).mesh;

    std::vector<glm::dvec3> positions;
    for (const auto& x : mesh.X.rowwise()) positions.emplace_back(x[0], x[1], x[2]);
    std::vector<glm::ivec3> triangles;
    for (const auto& t : mesh.F.rowwise()) triangles.emplace_back(t[0], t[1], t[2]);
    const auto pictures = render::draw_views({positions, triangles}, render::six_views, {.width = 400, .height = 400});
    for (std::size_t i = 0; i < pictures.size(); ++i)
        meshfolio::write_file(std::string(render::six_views[i].name) + ".png", render::encode_png(pictures[i]));

    const auto top = meshfolio::largest_eigenvalue(meshfolio::laplace_beltrami(mesh));
    std::printf("lambda_crit %.12g\n", meshfolio::largest_stable_step(top));
} catch (const meshfolio::Error& error) {
    std::fprintf(stderr, "six_views: %s\n", error.what());
    return static_cast<int>(error.exit_code());
}
