#include "mesh/mesh_checks.h"

#include <tuple>
#include <utility>

#include "base/at.h"
#include "base/errors.h"
#include "base/parallel.h"
#include "mesh/io/polygon_list.h"
#include "mesh/orientation.h"
#include "mesh/point_table.h"
#include "mesh/triangle_kind.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {

namespace {

void check_coordinates(const LoadedMesh& loaded) {
    const TriangleMesh& mesh = loaded.mesh;
    const auto good_point = [&](int v) { return (mesh.X.row(v).array().abs() <= largest_coordinate).all(); };   // false for NaN
    const auto good_triangle = [&](int t) { return mesh.F.row(t).minCoeff() >= 0 && mesh.F.row(t).maxCoeff() < mesh.vertex_count(); };
    if (all_of_range(mesh.vertex_count(), good_point) && all_of_range(mesh.face_count(), good_triangle)) return;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        for (int axis = 0; axis < 3; ++axis) {
            if (!std::isfinite(mesh.X(v, axis)))
                throw InputError({loaded.file, 0}, "vertex " + std::to_string(v) + " is not finite", "every coordinate must be a number");
            check_range(mesh.X(v, axis), loaded.file, 0);
        }
    }
    for (const int v : mesh.F.reshaped()) {
        if (v < 0 || v >= mesh.vertex_count())
            throw InputError({loaded.file, 0},
                             "vertex index " + std::to_string(v) + " with " + std::to_string(mesh.vertex_count()) + " vertices",
                             "indices count from 0");
    }
}

bool names_a_corner_twice(const TriangleMesh& mesh, int t) {
    return mesh.F(t, 0) == mesh.F(t, 1) || mesh.F(t, 1) == mesh.F(t, 2) || mesh.F(t, 2) == mesh.F(t, 0);
}

/// Triangles on the same three corners as another one.
struct FacesOnFaces {
    std::vector<char> repeated;   // m flags: runs the same way round as an earlier one, and is superfluous
    int opposite = 0;             // pairs of opposite orientation: the two sides of a wall without thickness
    int first_opposite = -1;      // the later one of the first pair
};

/// Finds the triangles on the same three corners as another one. @param around  triangles_around(mesh)
FacesOnFaces faces_on_faces(const TriangleMesh& mesh, const Incidence& around) {
    struct Corners {
        int middle, largest;
        bool downwards;   // from the smallest corner to the largest
        int face;
        auto key() const { return std::tie(middle, largest, downwards); }
        bool on(const Corners& o) const { return middle == o.middle && largest == o.largest; }
    };
    FacesOnFaces found{std::vector<char>(at(mesh.face_count()), 0)};
    std::vector<Corners> row;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        row.clear();
        for (const int* t = around.begin(v); t != around.end(v); ++t) {
            std::array<int, 3> corners{mesh.F(*t, 0), mesh.F(*t, 1), mesh.F(*t, 2)};
            std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
            if (corners[0] == v && corners[1] > v && corners[2] > v)
                row.push_back({std::min(corners[1], corners[2]), std::max(corners[1], corners[2]), corners[2] < corners[1], *t});
        }
        std::stable_sort(row.begin(), row.end(), [](const Corners& c, const Corners& d) { return c.key() < d.key(); });
        const Corners* first = nullptr;   // of those that run the same way as the one before
        for (const Corners& c : row) {
            if (first != nullptr && first->key() == c.key()) {
                found.repeated[at(c.face)] = 1;
                continue;
            }
            if (first != nullptr && first->on(c)) {
                const int later = std::max(first->face, c.face);
                if (found.opposite++ == 0 || later < found.first_opposite) found.first_opposite = later;
            }
            first = &c;
        }
    }
    return found;
}

/// Repairs a loaded mesh, counts its parts and defects, and collects the warnings.
class Preparation {
public:
    Preparation(LoadedMesh loaded, Checks checks) : checks_(checks), lines_(std::move(loaded.face_lines)) {
        prepared_.mesh = std::move(loaded.mesh);
        prepared_.warnings = std::move(loaded.warnings);
        prepared_.file = std::move(loaded.file);
        prepared_.attributes = std::move(loaded.attributes);
    }

    PreparedMesh run() {
        drop_faces();
        find_box();
        orient();
        if (checks_ == Checks::all || !topology().oriented_manifold) prepared_.topology = with_edges(std::move(topology()), mesh());
        count_connections();
        warn(counts().vertices - counts().vertices_in_use, "isolated vertex ignored", "isolated vertices ignored");
        if (checks_ == Checks::all) measure();
        count_shapes();
        return std::move(prepared_);
    }

private:
    Preflight& counts() { return prepared_.preflight; }
    TriangleMesh& mesh() { return prepared_.mesh; }
    MeshTopology& topology() { return prepared_.topology; }
    long line_of(int face) const { return face >= 0 && at(face) < lines_.size() ? lines_[at(face)] : 0; }
    void warn(int count, const std::string& one, const std::string& many, long line = 0) {
        if (count > 0) prepared_.warnings.push_back({std::to_string(count) + " " + (count == 1 ? one : many), line});
    }

    /// Drops degenerate and repeated faces, and finds the topology without edges.
    void drop_faces() {
        const bool some_degenerate = !all_of_range(mesh().face_count(), [&](int t) { return !names_a_corner_twice(mesh(), t); });
        if (!some_degenerate) topology() = topology_without_edges(mesh());
        if (!some_degenerate && topology().oriented_manifold && mesh().face_count() > 0) return;   // no triangle is there twice
        const FacesOnFaces found = faces_on_faces(mesh(), some_degenerate ? triangles_around(mesh()) : topology().vertex_faces);
        const long opposite_line = line_of(found.first_opposite);
        std::vector<long>& face_lines = prepared_.attributes.face_lines;
        long degenerate_line = 0, repeated_line = 0;
        int kept = 0;
        for (int t = 0; t < mesh().face_count(); ++t) {
            if (names_a_corner_twice(mesh(), t)) {
                if (counts().dropped_degenerate_faces++ == 0) degenerate_line = line_of(t);
            } else if (found.repeated[at(t)] != 0) {
                if (counts().dropped_duplicate_faces++ == 0) repeated_line = line_of(t);
            } else {
                mesh().F.row(kept) = mesh().F.row(t).eval();
                if (at(t) < lines_.size()) lines_[at(kept)] = lines_[at(t)];
                if (at(t) < face_lines.size()) face_lines[at(kept)] = face_lines[at(t)];
                ++kept;
            }
        }
        mesh().F.conservativeResize(kept, 3);
        counts().opposite_faces = found.opposite;
        warn(counts().dropped_degenerate_faces, "degenerate face (a corner named twice) ignored",
             "degenerate faces (a corner named twice) ignored", degenerate_line);
        warn(counts().dropped_duplicate_faces, "duplicate face ignored", "duplicate faces ignored", repeated_line);
        if (kept == 0)
            throw InputError({prepared_.file, degenerate_line}, "no triangles left: all are degenerate", "the export may be damaged");
        warn(found.opposite, "face lies on another of opposite orientation; both are kept",
             "faces lie on others of opposite orientation; both of each are kept", opposite_line);
        if (counts().dropped_degenerate_faces + counts().dropped_duplicate_faces > 0) topology() = topology_without_edges(mesh());
    }

    void find_box() {
        Eigen::Array3d low = Eigen::Array3d::Constant(HUGE_VAL), high = -low;
        for (int v = 0; v < mesh().vertex_count(); ++v) {
            if (topology().vertex_faces.size(v) == 0) continue;
            const Eigen::Array3d x = mesh().X.row(v).transpose();
            ++counts().vertices_in_use, low = low.min(x), high = high.max(x);
        }
        counts().vertices = mesh().vertex_count();
        counts().box_low = low, counts().box_high = high;
        if (counts().box_low == counts().box_high)
            throw InputError({prepared_.file, 0}, "all vertices coincide (the bounding box is a point)",
                             "the export may have lost the coordinates");
    }

    void orient() {
        const Orientation orientation = consistent_orientation(mesh(), topology());
        for_each_index(mesh().face_count(), [&](int t) {
            if (orientation.flip[at(t)] != 0) std::swap(mesh().F(t, 1), mesh().F(t, 2));
        });
        if (orientation.disagreeing_faces > 0) topology() = topology_without_edges(mesh());   // may be an oriented manifold now
        counts().flipped_faces = orientation.disagreeing_faces;
        counts().inside_out_components = orientation.inside_out_components + orientation.filled_cavities;
        counts().orientable = orientation.unorientable_components == 0;
        warn(orientation.disagreeing_faces, "face turned to agree with its neighbours", "faces turned to agree with their neighbours",
             line_of(orientation.first_disagreeing));
        warn(orientation.inside_out_components, "closed component was inside out (negative volume), reoriented",
             "closed components were inside out (negative volume), reoriented", line_of(orientation.first_inside_out));
        warn(orientation.filled_cavities, "closed component within a body pointed outwards (positive volume), reoriented as a cavity",
             "closed components within bodies pointed outwards (positive volume), reoriented as cavities",
             line_of(orientation.first_filled_cavity));
        warn(orientation.shells_of_unknown_depth, "closed component left as oriented; the nesting takes too long to find",
             "closed components left as oriented; their nesting takes too long to find");
        warn(orientation.unorientable_components, "component has no consistent orientation; the sign of mean curvature means nothing there",
             "components have no consistent orientation; the sign of mean curvature means nothing there",
             line_of(orientation.first_unorientable));
    }

    void count_connections() {
        counts().triangles = mesh().face_count();
        counts().components = topology().component_count;
        if (topology().edges.empty()) return;   // an oriented manifold
        counts().edges = static_cast<int>(topology().edges.size());
        counts().boundary_edges = topology().boundary_edge_count();
        counts().boundary_loops = counts().boundary_edges > 0 ? static_cast<int>(boundary_loops(mesh(), topology().edges).size()) : 0;
        counts().nonmanifold_edges = topology().nonmanifold_edge_count();
        counts().nonmanifold_vertices = topology().nonmanifold_vertex_count();
        if (!topology().oriented_manifold) warn_of_nonmanifold();
    }

    void warn_of_nonmanifold() {
        const std::vector<Edge>& edges = topology().edges;
        std::vector<char> explained(at(mesh().vertex_count()), 0);   // by a non-manifold edge
        for (const Edge& e : edges)
            if (e.faces > 2) explained[at(e.a)] = explained[at(e.b)] = 1;
        const auto edge = std::find_if(edges.begin(), edges.end(), [](const Edge& e) { return e.faces > 2; });
        if (edge != edges.end()) {
            const std::string first = " (first: " + std::to_string(edge->faces) + " faces on vertices " + std::to_string(edge->a) +
                                      " and " + std::to_string(edge->b) + ", counted from 0); curvature is undefined there";
            warn(counts().nonmanifold_edges, "non-manifold edge" + first, "non-manifold edges" + first);
        }
        int fans = 0;
        int first_vertex = -1;
        for (int v = 0; v < mesh().vertex_count(); ++v) {
            if (topology().nonmanifold[at(v)] == 0 || explained[at(v)] != 0) continue;
            if (fans++ == 0) first_vertex = v;
        }
        const std::string first = " (first: " + std::to_string(first_vertex) + ", counted from 0), where sheets meet in a point only";
        warn(fans, "non-manifold vertex" + first, "non-manifold vertices" + first);
    }

    void measure() {
        Preflight& p = counts();
        PointTable points(at(p.vertices_in_use));
        for (int v = 0; v < mesh().vertex_count(); ++v)
            if (topology().vertex_faces.size(v) > 0) points.number_of({mesh().X(v, 0), mesh().X(v, 1), mesh().X(v, 2)});
        p.duplicated_positions = p.vertices_in_use - static_cast<int>(points.points().size());
        p.euler_characteristic = p.vertices_in_use - p.edges + p.triangles;
        const int handles = 2 - p.euler_characteristic - p.boundary_loops;
        if (p.components == 1 && p.manifold() && p.orientable) p.genus = handles / 2;
        p.area = surface_area(mesh());
        p.unbalanced_edges = edges_out_of_balance(mesh(), topology());
        if (p.encloses_volume()) p.volume = signed_volume(mesh(), Box{p.box_low, p.box_high}.centre());
        p.mean_edge = mean_edge_length(mesh(), topology().edges);
    }

    void count_shapes() {
        std::vector<TriangleKind> kinds(at(mesh().face_count()));
        for_each_index(mesh().face_count(), [&](int t) { kinds[at(t)] = kind_of(mesh(), t); });
        counts().needle_faces = static_cast<int>(std::ranges::count(kinds, TriangleKind::needle));
        counts().zero_area_faces = static_cast<int>(std::ranges::count(kinds, TriangleKind::zero_area));
        const auto first = std::ranges::find(kinds, TriangleKind::zero_area) - kinds.begin();
        warn(counts().zero_area_faces, "face of no area kept; it contributes no stiffness",
             "faces of no area kept; they contribute no stiffness", line_of(static_cast<int>(first)));
    }

    Checks checks_;
    std::vector<long> lines_;   // of each triangle; may be empty
    PreparedMesh prepared_;
};

}   // namespace

PreparedMesh prepare_mesh(LoadedMesh loaded, Checks checks) {
    check_coordinates(loaded);
    return Preparation(std::move(loaded), checks).run();
}

}   // namespace meshfolio
