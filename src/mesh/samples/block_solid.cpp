#include "mesh/samples/block_solid.h"

#include <utility>

#include "base/at.h"

namespace meshfolio {

namespace {

using Index3 = std::array<int, 3>;

/// The cells of all blocks along one axis.
struct Axis {
    std::vector<int> block;      // of each cell
    std::vector<double> place;   // block coordinate of each node, one more than cells
};

Axis axis_of(const std::vector<int>& divisions) {
    Axis axis;
    for (int b = 0; b < static_cast<int>(divisions.size()); ++b) {
        const int n = divisions[at(b)];
        for (int i = 0; i < n; ++i) {
            axis.block.push_back(b);
            axis.place.push_back(b + static_cast<double>(i) / n);
        }
    }
    axis.place.push_back(static_cast<double>(divisions.size()));
    return axis;
}

class SurfaceBuilder {
public:
    SurfaceBuilder(const BlockDivisions& divisions, const std::function<bool(int, int, int)>& filled)
        : axes_{axis_of(divisions[0]), axis_of(divisions[1]), axis_of(divisions[2])}, filled_(filled) {
        vertex_.assign(axes_[0].place.size() * axes_[1].place.size() * axes_[2].place.size(), -1);
    }

    BlockSurface build() {
        for (int k = 0; k < cells(2); ++k)
            for (int j = 0; j < cells(1); ++j)
                for (int i = 0; i < cells(0); ++i) add_open_sides({i, j, k});
        surface_.X = Eigen::Map<const Positions>(coordinates_.data(), static_cast<Eigen::Index>(coordinates_.size() / 3), 3);
        return std::move(surface_);
    }

private:
    int cells(int axis) const { return static_cast<int>(axes_[at(axis)].block.size()); }

    bool is_filled(const Index3& cell) const {
        Index3 block;
        for (int a = 0; a < 3; ++a) {
            if (cell[at(a)] < 0 || cell[at(a)] >= cells(a)) return false;
            block[at(a)] = axes_[at(a)].block[at(cell[at(a)])];
        }
        return filled_(block[0], block[1], block[2]);
    }

    void add_open_sides(const Index3& cell) {
        if (!is_filled(cell)) return;
        for (int a = 0; a < 3; ++a) {
            for (const int side : {0, 1}) {
                Index3 beyond = cell;
                beyond[at(a)] += side == 0 ? -1 : 1;
                if (!is_filled(beyond)) add_side(cell, a, side);
            }
        }
    }

    /// Adds the lower (0) or upper (1) side of a cell across axis a. Corners are in the order (0,0) (1,0) (1,1) (0,1) of the two following
    /// axes, turned round on the lower side.
    void add_side(const Index3& cell, int a, int side) {
        int u = (a + 1) % 3, v = (a + 2) % 3;
        if (side == 0) std::swap(u, v);
        Index3 corner = cell;
        corner[at(a)] += side;
        std::array<int, 4> quad;
        for (int c = 0; c < 4; ++c) {
            Index3 node = corner;
            node[at(u)] += c == 1 || c == 2;
            node[at(v)] += c >= 2;
            quad[at(c)] = vertex_at(node);
        }
        surface_.quads.push_back(quad);
        surface_.cell.push_back({cell[at(u)], cell[at(v)]});
    }

    int vertex_at(const Index3& node) {
        const std::size_t slot = (at(node[2]) * axes_[1].place.size() + at(node[1])) * axes_[0].place.size() + at(node[0]);
        if (vertex_[slot] < 0) {
            vertex_[slot] = static_cast<int>(coordinates_.size() / 3);
            for (int a = 0; a < 3; ++a) coordinates_.push_back(axes_[at(a)].place[at(node[at(a)])]);
        }
        return vertex_[slot];
    }

    std::array<Axis, 3> axes_;
    const std::function<bool(int, int, int)>& filled_;
    std::vector<int> vertex_;   // of each node; −1: not on the surface (so far)
    std::vector<double> coordinates_;
    BlockSurface surface_;
};

}   // namespace

BlockSurface surface_of_blocks(const BlockDivisions& divisions, const std::function<bool(int, int, int)>& filled) {
    return SurfaceBuilder(divisions, filled).build();
}

TriangleMesh triangulated(const BlockSurface& surface, const std::function<bool(const BlockSurface&, int q)>& first_diagonal) {
    TriangleMesh mesh;
    mesh.X = surface.X;
    mesh.F.resize(2 * static_cast<Eigen::Index>(surface.quads.size()), 3);
    for (int q = 0; q < static_cast<int>(surface.quads.size()); ++q) {
        const auto [a, b, c, d] = surface.quads[at(q)];
        if (first_diagonal(surface, q)) mesh.F.middleRows<2>(2 * Eigen::Index{q}) << a, b, c, a, c, d;
        else mesh.F.middleRows<2>(2 * Eigen::Index{q}) << a, b, d, b, c, d;
    }
    return mesh;
}

}   // namespace meshfolio
