// The cotangent matrix of any triangles at any finite places: finite, symmetric, every row adds up to nothing beside its entries.
#include <cmath>

#include "fuzz/fuzz_input.h"
#include "geometry/operators/cotangent_laplacian.h"

namespace {

using namespace meshfolio;

TriangleMesh mesh_of(fuzzing::Bytes input) {
    TriangleMesh mesh;
    const int vertices = 3 + input.take<std::uint8_t>() % 30, faces = 1 + input.take<std::uint8_t>() % 60;
    const int exponent = input.take<std::int8_t>() / 3;   // scales from 1e-12 to 1e12
    mesh.X.resize(vertices, 3);
    for (Eigen::Index i = 0; i < mesh.X.size(); ++i) mesh.X.data()[i] = std::ldexp(input.take<std::int16_t>(), exponent);
    mesh.F.resize(faces, 3);
    for (Eigen::Index i = 0; i < mesh.F.size(); ++i) mesh.F.data()[i] = input.take<std::uint8_t>() % vertices;
    return mesh;
}

}   // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using fuzzing::require;
    const TriangleMesh mesh = mesh_of({bytes, size});
    const LaplaceBeltrami operators = laplace_beltrami(mesh);
    require(operators.M.allFinite() && operators.M.minCoeff() >= 0, "areas are finite and not negative");
    const Eigen::MatrixXd C = operators.C;
    require(C.allFinite(), "C is finite");
    require(C == C.transpose(), "C is symmetric");
    const double sum = C.rowwise().sum().cwiseAbs().maxCoeff(), size_of_entries = C.cwiseAbs().rowwise().sum().maxCoeff();
    require(sum <= 1e-12 * size_of_entries, "rows of C add up to 0");
    return 0;
}
