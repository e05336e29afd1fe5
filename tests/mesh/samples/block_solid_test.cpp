#include "mesh/samples/block_solid.h"

#include <gtest/gtest.h>

#include "mesh/mesh_topology.h"
#include "mesh/samples/euler_characteristic.h"
#include "mesh/triangle_measures.h"

using namespace meshfolio;
using meshfolio::testing::euler_characteristic;

namespace {

TriangleMesh solid(const BlockDivisions& divisions, const std::function<bool(int, int, int)>& filled) {
    return triangulated(surface_of_blocks(divisions, filled), [](const BlockSurface&, int q) { return q % 2 == 0; });
}

}   // namespace

TEST(BlockSolid, EnclosesItsBlocksHoweverTheyAreDivided) {
    for (const BlockDivisions& divisions : {BlockDivisions{{{1, 1}, {1, 1}, {1}}}, BlockDivisions{{{2, 3}, {4, 1}, {5}}}}) {
        const TriangleMesh ell = solid(divisions, [](int i, int j, int) { return i == 0 || j == 0; });
        EXPECT_NEAR(signed_volume(ell), 3, 1e-13);
        EXPECT_NEAR(surface_area(ell), 2 * 3 + 8, 1e-13);
        EXPECT_EQ(topology_of(ell).boundary_edge_count(), 0);
        EXPECT_EQ(topology_of(ell).nonmanifold_edge_count(), 0);
        EXPECT_EQ(euler_characteristic(ell), 2);
    }
}

TEST(BlockSolid, ARingOfBlocksIsATorus) {
    const TriangleMesh ring = solid({{{1, 1, 1}, {1, 1, 1}, {1}}}, [](int i, int j, int) { return !(i == 1 && j == 1); });
    EXPECT_EQ(euler_characteristic(ring), 0);
    EXPECT_NEAR(signed_volume(ring), 8, 1e-14);
}

TEST(BlockSolid, BlocksMeetingAlongAnEdgeAreNotManifold) {
    const TriangleMesh touching = solid({{{1, 1}, {1, 1}, {1}}}, [](int i, int j, int) { return i == j; });
    EXPECT_EQ(topology_of(touching).nonmanifold_edge_count(), 1);
}

TEST(BlockSolid, BothWaysOfCuttingKeepTheSurface) {
    const BlockSurface surface = surface_of_blocks({{{2}, {2}, {2}}}, [](int, int, int) { return true; });
    for (const bool first : {true, false}) {
        const TriangleMesh mesh = triangulated(surface, [&](const BlockSurface&, int) { return first; });
        EXPECT_EQ(mesh.face_count(), 48);
        EXPECT_NEAR(signed_volume(mesh), 1, 1e-15);
        const auto [a, b, c, d] = surface.quads[0];
        EXPECT_EQ((mesh.F.row(0).array() == d).any(), !first) << a << b << c;
    }
}
