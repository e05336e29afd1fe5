#include "mesh/decimation.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <functional>
#include <iterator>
#include <queue>
#include <string>
#include <tuple>

#include "base/at.h"
#include "base/errors.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {

namespace {

/// Weight of the distance to merged vertices, relative to that of the planes; on flat parts it decides alone and spaces vertices evenly.
constexpr double point_weight = 1e-3;
/// Weight of the planes through boundary edges, across the surface.
constexpr double boundary_weight = 10;
/// Cosine of the largest angle by which a collapse may turn a triangle.
constexpr double least_cosine = 0.3;

using Triangle = std::array<int, 3>;

/// A quadratic form on (x, 1): weight · (squared distance of x).
using Quadric = Eigen::Matrix4d;
Quadric distance_to_plane(const Vector3& normal, const Vector3& point, double weight) {
    Eigen::Vector4d h;
    h << normal, -normal.dot(point);
    return weight * h * h.transpose();
}
Quadric distance_to_point(const Vector3& point, double weight) {
    Quadric Q = Quadric::Identity();
    Q.topRightCorner<3, 1>() = -point;
    Q.bottomLeftCorner<1, 3>() = -point.transpose();
    Q(3, 3) = point.squaredNorm();
    return weight * Q;
}

/// The collapse of an edge. It is out of date if an end has changed since.
struct Candidate {
    double cost;
    int a, b;        // a < b
    int version;     // sum of the ends' versions
    Vector3 place;   // of the vertex that is left

    friend bool operator>(const Candidate& p, const Candidate& q) {   // ties by number: one order on every machine
        return std::tie(p.cost, p.a, p.b) > std::tie(q.cost, q.a, q.b);
    }
};

class Decimation {
public:
    explicit Decimation(const TriangleMesh& mesh) : topology_(topology_of(mesh)), X_(mesh.X), boundary_(topology_.on_boundary) {
        const std::size_t n = at(mesh.vertex_count());
        around_.resize(n);
        quadric_.resize(n, Quadric::Zero());
        version_.resize(n);
        for (int t = 0; t < mesh.face_count(); ++t) {
            faces_.push_back({mesh.F(t, 0), mesh.F(t, 1), mesh.F(t, 2)});
            for (const int v : faces_.back()) around_[at(v)].push_back(t);
        }
        for (std::size_t v = 0; v < n; ++v) vertices_ += !around_[v].empty();
        enter_quadrics(mesh);
        for (const Edge& edge : topology_.edges) enter_candidate(edge.a, edge.b);
    }

    void run(int vertices) {
        while (vertices_ > vertices && !queue_.empty()) {
            const Candidate edge = queue_.top();
            queue_.pop();
            const auto [cost, a, b, version, place] = edge;
            const bool is_current = version == version_[at(a)] + version_[at(b)];
            if (is_current && keeps_topology(a, b) && !turns_a_triangle(a, b, place) && !turns_a_triangle(b, a, place)) collapse(edge);
        }
    }

    TriangleMesh result() const {
        std::vector<Triangle> left;
        for (const Triangle& face : faces_)
            if (face[0] >= 0) left.push_back(face);
        TriangleMesh mesh{X_, Faces(static_cast<Eigen::Index>(left.size()), 3)};
        for (std::size_t t = 0; t < left.size(); ++t) mesh.F.row(static_cast<Eigen::Index>(t)) << left[t][0], left[t][1], left[t][2];
        return without_unreferenced_vertices(mesh).mesh;
    }

private:
    const MeshTopology topology_;   // of the mesh as it was
    Positions X_;
    std::vector<char> boundary_;
    std::vector<Triangle> faces_;            // −1: gone
    std::vector<std::vector<int>> around_;   // faces of each vertex
    std::vector<Quadric> quadric_;           // of each vertex
    std::vector<int> version_;               // of each vertex: how often it has changed
    int vertices_ = 0;                       // left
    std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> queue_;

    Vector3 position(int v) const { return X_.row(v); }
    static bool has(const Triangle& face, int v) { return std::find(face.begin(), face.end(), v) != face.end(); }

    /// Adds the plane of each triangle, weighted by its area, to its corners, and the plane through each boundary edge to its ends.
    void enter_quadrics(const TriangleMesh& mesh) {
        const Vector areas = face_areas(mesh);
        const Positions normals = face_normals(mesh);
        for (std::size_t t = 0; t < faces_.size(); ++t) {
            const auto row = static_cast<Eigen::Index>(t);
            const Vector3 normal = normals.row(row);
            for (const int v : faces_[t]) {
                quadric_[at(v)] +=
                    distance_to_plane(normal, position(v), areas[row] / 3) + distance_to_point(position(v), point_weight * areas[row] / 3);
            }
            for (std::size_t k = 0; k < 3; ++k) {
                const int a = faces_[t][k], b = faces_[t][(k + 1) % 3];
                if (faces_with(a, b).size() != 1) continue;
                const Vector3 edge = position(b) - position(a), across = edge.cross(normal).normalized();
                const Quadric wall = distance_to_plane(across, position(a), boundary_weight * edge.squaredNorm());
                quadric_[at(a)] += wall;
                quadric_[at(b)] += wall;
            }
        }
    }

    std::vector<int> faces_with(int a, int b) const {
        std::vector<int> shared;
        for (const int t : around_[at(a)])
            if (has(faces_[at(t)], b)) shared.push_back(t);
        return shared;
    }

    std::vector<int> neighbours(int v) const {
        std::vector<int> ring;
        for (const int t : around_[at(v)]) {
            for (const int w : faces_[at(t)])
                if (w != v) ring.push_back(w);
        }
        std::sort(ring.begin(), ring.end());
        ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
        return ring;
    }

    /// Returns the point at which Q is least, or the end on the boundary if there is one such end.
    Vector3 best_place(int a, int b, const Quadric& Q) const {
        if (boundary_[at(a)] != boundary_[at(b)]) return position(boundary_[at(a)] ? a : b);
        const Vector3 middle = 0.5 * (position(a) + position(b));   // the form is solved about it: places far from 0 keep their digits
        const Eigen::Matrix3d A = Q.topLeftCorner<3, 3>();
        const Vector3 step = A.ldlt().solve(-(A * middle + Q.topRightCorner<3, 1>()));
        const bool is_near = step.allFinite() && step.norm() <= 2 * (position(a) - position(b)).norm();
        return is_near ? Vector3(middle + step) : middle;
    }

    void enter_candidate(int a, int b) {
        if (topology_.nonmanifold[at(a)] || topology_.nonmanifold[at(b)]) return;
        const Quadric Q = quadric_[at(a)] + quadric_[at(b)];
        const Vector3 place = best_place(a, b, Q);
        const Eigen::Vector4d h = place.homogeneous();
        queue_.push({std::max(0.0, h.dot(Q * h)), std::min(a, b), std::max(a, b), version_[at(a)] + version_[at(b)], place});
    }

    /// True if the ends have no common neighbours but the corners opposite the edge (the link condition), and something is left.
    bool keeps_topology(int a, int b) const {
        const std::size_t shared = faces_with(a, b).size();
        if (shared == 0 || (shared == 2 && boundary_[at(a)] && boundary_[at(b)])) return false;
        const std::vector<int> of_a = neighbours(a), of_b = neighbours(b);
        std::vector<int> common;
        std::set_intersection(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(), std::back_inserter(common));
        const std::size_t others = of_a.size() + of_b.size() - common.size() - 2;   // of both, without a and b
        return common.size() == shared && others > shared;
    }

    bool turns_a_triangle(int moved, int gone, const Vector3& place) const {
        for (const int t : around_[at(moved)]) {
            const Triangle& face = faces_[at(t)];
            if (has(face, gone)) continue;
            const auto k = static_cast<std::size_t>(std::find(face.begin(), face.end(), moved) - face.begin());
            const Vector3 p = position(face[(k + 1) % 3]), q = position(face[(k + 2) % 3]);
            const Vector3 before = (p - position(moved)).cross(q - position(moved)), after = (p - place).cross(q - place);
            if (!(after.dot(before) > least_cosine * after.norm() * before.norm())) return true;
        }
        return false;
    }

    /// Replaces b by a and moves a to its place.
    void collapse(const Candidate& edge) {
        const auto [cost, a, b, version, place] = edge;
        for (const int t : faces_with(a, b)) {
            for (const int v : faces_[at(t)]) std::erase(around_[at(v)], t);
            faces_[at(t)] = {-1, -1, -1};
        }
        for (const int t : around_[at(b)]) {
            std::replace(faces_[at(t)].begin(), faces_[at(t)].end(), b, a);
            around_[at(a)].push_back(t);
        }
        around_[at(b)].clear();
        X_.row(a) = place;
        quadric_[at(a)] += quadric_[at(b)];
        boundary_[at(a)] |= boundary_[at(b)];
        --vertices_;
        ++version_[at(a)];
        ++version_[at(b)];
        for (const int v : neighbours(a)) enter_candidate(a, v);   // including edges refused before, which may be allowed now
    }
};

}   // namespace

TriangleMesh decimated(const TriangleMesh& mesh, int vertices) {
    if (vertices < 4) throw MeshError("a mesh cannot be decimated to " + std::to_string(vertices) + " vertices", "ask for at least four");
    // The box is moved to the origin and scaled to 1, because quadrics hold fourth powers of coordinates.
    const Box box = bounding_box(mesh);
    const Eigen::RowVector3d centre = box.centre();
    const double unit = box.diagonal() > 0 ? box.diagonal() : 1;
    Decimation decimation(moved_to(mesh, (mesh.X.rowwise() - centre) / unit));
    decimation.run(vertices);
    TriangleMesh result = decimation.result();
    result.X = (result.X * unit).rowwise() + centre;
    return result;
}

TriangleMesh small_copy(const TriangleMesh& mesh, int vertices) {
    const auto require_few = [&](int remaining) {
        if (remaining / 4 > vertices)
            throw MeshError("cannot be decimated to " + std::to_string(vertices) + " vertices: " + std::to_string(remaining) +
                                " remain, since every component and every boundary keeps some",
                            "take a mesh of fewer components");
    };
    require_few(3 * topology_without_edges(mesh).component_count);   // before the work, if nothing else stands in the way
    TriangleMesh copy = decimated(mesh, vertices);
    require_few(copy.vertex_count());
    return copy;
}

CompactMesh surface_patch(const TriangleMesh& mesh, const MeshTopology& topology, int vertex, int most_vertices) {
    if (vertex < 0 || vertex >= mesh.vertex_count())
        throw MeshError(
            "surface_patch: there is no vertex " + std::to_string(vertex) + ", the mesh has " + std::to_string(mesh.vertex_count()),
            "vertices count from 0");
    if (mesh.vertex_count() <= most_vertices) return {mesh, Eigen::VectorXi::LinSpaced(mesh.vertex_count(), 0, mesh.vertex_count() - 1)};
    std::vector<char> inside(at(mesh.vertex_count()), 0);
    std::vector<int> reached{vertex};
    inside[at(vertex)] = 1;
    for (std::size_t next = 0; next < reached.size() && reached.size() < at(most_vertices); ++next) {
        for (const int* w = topology.neighbours.begin(reached[next]); w != topology.neighbours.end(reached[next]); ++w) {
            if (inside[at(*w)] || reached.size() >= at(most_vertices)) continue;
            inside[at(*w)] = 1;
            reached.push_back(*w);
        }
    }
    std::vector<int> faces;
    for (int t = 0; t < mesh.face_count(); ++t)
        if (inside[at(mesh.F(t, 0))] && inside[at(mesh.F(t, 1))] && inside[at(mesh.F(t, 2))]) faces.push_back(t);
    return without_unreferenced_vertices({mesh.X, mesh.F(faces, Eigen::all)});
}

}   // namespace meshfolio
