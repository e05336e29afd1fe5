#include "mesh/mesh_checks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "errors.h"
#include "mesh/orientation.h"
#include "mesh/point_table.h"
#include "mesh/polygon_list.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {

namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

void check_coordinates(const LoadedMesh& loaded) {
    const TriangleMesh& mesh = loaded.mesh;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        for (int axis = 0; axis < 3; ++axis) {
            if (!std::isfinite(mesh.X(v, axis))) {
                throw InputError({loaded.file, 0}, "vertex " + std::to_string(v) + " is not finite", "every coordinate must be a number");
            }
            check_range(mesh.X(v, axis), loaded.file, 0);
        }
    }
    for (const int v : mesh.F.reshaped()) {
        if (v < 0 || v >= mesh.vertex_count()) {
            throw InputError({loaded.file, 0},
                             "vertex index " + std::to_string(v) + " with " + std::to_string(mesh.vertex_count()) + " vertices");
        }
    }
}

bool names_a_corner_twice(const TriangleMesh& mesh, int t) {
    return mesh.F(t, 0) == mesh.F(t, 1) || mesh.F(t, 1) == mesh.F(t, 2) || mesh.F(t, 2) == mesh.F(t, 0);
}

/// m flags: a triangle before has the same three corners, in whatever order. Compares only triangles with equal smallest corner.
std::vector<char> repeated_faces(const TriangleMesh& mesh) {
    struct Corners {
        int middle, largest, face;
        bool operator<(const Corners& o) const { return std::tie(middle, largest, face) < std::tie(o.middle, o.largest, o.face); }
    };
    const Incidence around = triangles_around(mesh);
    std::vector<char> repeated(at(mesh.face_count()), 0);
    std::vector<Corners> row;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        row.clear();
        for (const int* t = around.begin(v); t != around.end(v); ++t) {
            std::array<int, 3> corners{mesh.F(*t, 0), mesh.F(*t, 1), mesh.F(*t, 2)};
            std::sort(corners.begin(), corners.end());
            if (corners[0] == v && corners[1] > v) row.push_back({corners[1], corners[2], *t});
        }
        std::sort(row.begin(), row.end());
        for (std::size_t i = 1; i < row.size(); ++i) {
            if (row[i].middle == row[i - 1].middle && row[i].largest == row[i - 1].largest) repeated[at(row[i].face)] = 1;
        }
    }
    return repeated;
}

enum class FaceShape { sound, needle, zero_area };

/// Needle: smallest angle below 1°. No area: the height is below the rounding of the longest edge.
FaceShape shape_of(const TriangleMesh& mesh, int t) {
    const Vector3 a = mesh.X.row(mesh.F(t, 0));
    const Vector3 u = mesh.X.row(mesh.F(t, 1)).transpose() - a;
    const Vector3 v = mesh.X.row(mesh.F(t, 2)).transpose() - a;
    std::array<double, 3> edge{u.norm(), v.norm(), (v - u).norm()};
    std::sort(edge.begin(), edge.end());
    const Vector3 cross = u.cross(v);
    const double twice_area = std::hypot(cross.x(), cross.y(), cross.z());
    if (!(twice_area > 1e-15 * edge[2] * edge[2])) return FaceShape::zero_area;
    // The smallest angle lies between the two longer edges.
    return twice_area < std::sin(std::numbers::pi / 180) * edge[1] * edge[2] ? FaceShape::needle : FaceShape::sound;
}

/// Takes a loaded mesh through repairs and counts, and keeps what there is to say.
class Preparation {
public:
    explicit Preparation(LoadedMesh loaded) : lines_(std::move(loaded.face_lines)) {
        prepared_.mesh = std::move(loaded.mesh);
        prepared_.warnings = std::move(loaded.warnings);
        prepared_.file = std::move(loaded.file);
    }

    PreparedMesh run() {
        drop_faces();
        const Box box = bounding_box(prepared_.mesh);
        if (box.low == box.high) {
            throw InputError({prepared_.file, 0}, "all vertices coincide (the bounding box is a point)",
                             "the export may have lost the coordinates");
        }
        counts().box_low = box.low;
        counts().box_high = box.high;
        orient();
        prepared_.topology = topology_of(prepared_.mesh);
        count_connections();
        count_positions();
        measure();
        return std::move(prepared_);
    }

private:
    Preflight& counts() { return prepared_.preflight; }
    TriangleMesh& mesh() { return prepared_.mesh; }
    long line_of(int face) const { return face >= 0 && at(face) < lines_.size() ? lines_[at(face)] : 0; }
    void warn_of(int count, const std::string& one, const std::string& many, long line = 0) {
        if (count > 0) prepared_.warnings.push_back({std::to_string(count) + " " + (count == 1 ? one : many), line});
    }

    void drop_faces() {
        const std::vector<char> repeated = repeated_faces(mesh());
        long degenerate_line = 0;
        long repeated_line = 0;
        int kept = 0;
        for (int t = 0; t < mesh().face_count(); ++t) {
            if (names_a_corner_twice(mesh(), t)) {
                if (counts().dropped_degenerate_faces++ == 0) degenerate_line = line_of(t);
            } else if (repeated[at(t)] != 0) {
                if (counts().dropped_duplicate_faces++ == 0) repeated_line = line_of(t);
            } else {
                mesh().F.row(kept) = mesh().F.row(t).eval();
                if (at(t) < lines_.size()) lines_[at(kept)] = lines_[at(t)];
                ++kept;
            }
        }
        mesh().F.conservativeResize(kept, 3);
        warn_of(counts().dropped_degenerate_faces, "degenerate face (a corner named twice) ignored",
                "degenerate faces (a corner named twice) ignored", degenerate_line);
        warn_of(counts().dropped_duplicate_faces, "duplicate face ignored", "duplicate faces ignored", repeated_line);
        if (kept == 0)
            throw InputError({prepared_.file, degenerate_line}, "no triangles left: all are degenerate", "the export may be damaged");
    }

    void orient() {
        const Orientation orientation = consistent_orientation(mesh());
        for (int t = 0; t < mesh().face_count(); ++t) {
            if (orientation.flip[at(t)] != 0) std::swap(mesh().F(t, 1), mesh().F(t, 2));
        }
        counts().flipped_faces = orientation.disagreeing_faces;
        counts().inside_out_components = orientation.inside_out_components;
        counts().orientable = orientation.unorientable_components == 0;
        warn_of(orientation.disagreeing_faces, "face turned to agree with its neighbours", "faces turned to agree with their neighbours",
                line_of(orientation.first_disagreeing));
        warn_of(orientation.inside_out_components, "closed component was inside out (negative volume), reoriented",
                "closed components were inside out (negative volume), reoriented", line_of(orientation.first_inside_out));
        warn_of(orientation.unorientable_components,
                "component has no consistent orientation; the sign of mean curvature means nothing there",
                "components have no consistent orientation; the sign of mean curvature means nothing there",
                line_of(orientation.first_unorientable));
    }

    void count_connections() {
        const MeshTopology& topology = prepared_.topology;
        counts().triangles = mesh().face_count();
        counts().edges = static_cast<int>(topology.edges.size());
        counts().components = topology.component_count;
        counts().boundary_edges = topology.boundary_edge_count();
        counts().boundary_loops = counts().boundary_edges > 0 ? static_cast<int>(boundary_loops(mesh()).size()) : 0;
        counts().nonmanifold_edges = topology.nonmanifold_edge_count();
        counts().nonmanifold_vertices = topology.nonmanifold_vertex_count();
        warn_of_nonmanifold();
    }

    void warn_of_nonmanifold() {
        const MeshTopology& topology = prepared_.topology;
        std::vector<char> explained(at(mesh().vertex_count()), 0);   // by a non-manifold edge
        for (const Edge& e : topology.edges) {
            if (e.faces > 2) explained[at(e.a)] = explained[at(e.b)] = 1;
        }
        const auto edge = std::find_if(topology.edges.begin(), topology.edges.end(), [](const Edge& e) { return e.faces > 2; });
        if (edge != topology.edges.end()) {
            const std::string first = " (first: " + std::to_string(edge->faces) + " faces on vertices " + std::to_string(edge->a) +
                                      " and " + std::to_string(edge->b) + ", counted from 0); curvature is undefined there";
            warn_of(counts().nonmanifold_edges, "non-manifold edge" + first, "non-manifold edges" + first);
        }
        int fans = 0;
        int first_vertex = -1;
        for (int v = 0; v < mesh().vertex_count(); ++v) {
            if (topology.nonmanifold[at(v)] == 0 || explained[at(v)] != 0) continue;
            if (fans++ == 0) first_vertex = v;
        }
        const std::string first = " (first: " + std::to_string(first_vertex) + ", counted from 0), where sheets meet in a point only";
        warn_of(fans, "non-manifold vertex" + first, "non-manifold vertices" + first);
    }

    void count_positions() {
        counts().vertices = mesh().vertex_count();
        PointTable positions(at(mesh().vertex_count()));
        for (int v = 0; v < mesh().vertex_count(); ++v) {
            if (prepared_.topology.vertex_faces.size(v) == 0) continue;
            ++counts().vertices_in_use;
            positions.number_of({mesh().X(v, 0), mesh().X(v, 1), mesh().X(v, 2)});
        }
        counts().duplicated_positions = counts().vertices_in_use - static_cast<int>(positions.points().size());
        warn_of(counts().vertices - counts().vertices_in_use, "isolated vertex ignored", "isolated vertices ignored");
        Preflight& p = counts();
        p.euler_characteristic = p.vertices_in_use - p.edges + p.triangles;
        const int handles = 2 - p.euler_characteristic - p.boundary_loops;
        if (p.components == 1 && p.manifold() && p.orientable) p.genus = handles / 2;
    }

    void measure() {
        counts().area = surface_area(mesh());
        counts().volume = signed_volume(mesh());
        double sum = 0;
        for (const Edge& e : prepared_.topology.edges) sum += (mesh().X.row(e.b) - mesh().X.row(e.a)).norm();
        counts().mean_edge = sum / static_cast<double>(counts().edges);
        int first_flat = -1;
        for (int t = 0; t < mesh().face_count(); ++t) {
            const FaceShape shape = shape_of(mesh(), t);
            if (shape == FaceShape::zero_area && counts().zero_area_faces++ == 0) first_flat = t;
            if (shape == FaceShape::needle) ++counts().needle_faces;
        }
        warn_of(counts().zero_area_faces, "face of no area kept; its cotangents are floored",
                "faces of no area kept; their cotangents are floored", line_of(first_flat));
    }

    std::vector<long> lines_;   // of each triangle; may be empty
    PreparedMesh prepared_;
};

}   // namespace

PreparedMesh prepare_mesh(LoadedMesh loaded) {
    check_coordinates(loaded);
    return Preparation(std::move(loaded)).run();
}

}   // namespace meshfolio
