#include "questions/bench/one_ring.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "geometry/linear/special_values.h"
#include "geometry/operators/triangle_shape.h"
#include "geometry/operators/uniform_laplacian.h"
#include "mesh/samples/sample_shapes.h"
#include "mesh/triangle_measures.h"
#include "questions/bench/bench_mesh.h"

namespace meshfolio {

namespace {

using report::DiagramPoint;

constexpr double ring_jitter = 0.25, sphere_jitter = 0.45;   // the latter for a visible drift
constexpr double no_drift = 1e-9;                            // ‖Δx‖ below this share of the ring's edges is rounding
constexpr std::uint64_t ring_seed = 1;                       // of all diagrams, whatever the seed of the run

DiagramPoint between(DiagramPoint p, DiagramPoint q) { return {(p[0] + q[0]) / 2, (p[1] + q[1]) / 2}; }
double squared_length(DiagramPoint p) { return p[0] * p[0] + p[1] * p[1]; }

/// Returns the circumcentre of the triangle 0, p, q.
DiagramPoint circumcentre(DiagramPoint p, DiagramPoint q) {
    const double d = 2 * (p[0] * q[1] - p[1] * q[0]), pp = squared_length(p), qq = squared_length(q);
    return {(q[1] * pp - p[1] * qq) / d, (p[0] * qq - q[0] * pp) / d};
}

/// Returns the dot products of the two edges at the vertex, at the first corner and at the second corner of triangle t.
std::array<double, 3> corner_dots(const FlatRing& ring, int t) {
    const DiagramPoint p = ring.corners[t], q = ring.corners[t + 1];
    const double pq = p[0] * q[0] + p[1] * q[1];
    return {pq, squared_length(p) - pq, squared_length(q) - pq};
}

/// Returns −cos of the largest angle of all triangles of the ring; 0 if no angle is obtuse.
double most_obtuse(const FlatRing& ring) {
    double most = 0;
    for (int t = 0; t < ring.triangles(); ++t) {
        const DiagramPoint p = ring.corners[t], q = ring.corners[t + 1];
        const double pp = squared_length(p), qq = squared_length(q), third = squared_length({q[0] - p[0], q[1] - p[1]});
        const auto [at_vertex, at_p, at_q] = corner_dots(ring, t);
        most = std::max({most, -at_vertex / std::sqrt(pp * qq), -at_p / std::sqrt(pp * third), -at_q / std::sqrt(qq * third)});
    }
    return most;
}

/// Returns the distance of the mean of the corners from the vertex, in mean edges.
double unevenness(const FlatRing& ring) {
    double x = 0, y = 0, edges = 0;
    for (auto corner = ring.corners.begin(); corner + 1 != ring.corners.end(); ++corner) {
        x += (*corner)[0];
        y += (*corner)[1];
        edges += std::hypot((*corner)[0], (*corner)[1]);
    }
    return std::hypot(x, y) / edges;
}

/// Finds the ring with the largest `measure` among those with this number of obtuse triangles.
SampleRing ring_in_a_plane(int obtuse_triangles, double (*measure)(const FlatRing&)) {
    SampleRing sample{grid_mesh(12, 12, 11, 11), {}};
    for (auto x : sample.mesh.X.rowwise()) x = Eigen::RowVector3d(x[0] - 0.5 * x[1], std::sqrt(0.75) * x[1], 0);   // equal sides
    sample.topology = topology_of(sample.mesh);
    sample.mesh.X =
        jittered(sample.mesh, sample.topology, ring_jitter, ring_seed, [](const Vector3& p) { return Vector3(p.x(), p.y(), 0); });
    double most = -1;   // some of the 100 rings have that number
    for (int v = 0; v < sample.mesh.vertex_count(); ++v) {
        if (sample.topology.on_boundary[v]) continue;
        const FlatRing ring = flat_ring(sample.mesh, sample.topology, v);
        int obtuse = 0;
        for (int t = 0; t < ring.triangles(); ++t) obtuse += is_obtuse(ring, t) ? 1 : 0;
        if (obtuse != obtuse_triangles || measure(ring) <= most) continue;
        most = measure(ring);
        sample.vertex = v;
    }
    return sample;
}

}   // namespace

std::vector<int> ring_in_order(const TriangleMesh& mesh, const MeshTopology& topology, int vertex) {
    std::map<int, int> behind;   // the neighbour after each, counter-clockwise
    for (const int* t = topology.vertex_faces.begin(vertex); t != topology.vertex_faces.end(vertex); ++t)
        for (int k = 0; k < 3; ++k)
            if (mesh.F(*t, k) == vertex) behind[mesh.F(*t, (k + 1) % 3)] = mesh.F(*t, (k + 2) % 3);
    std::vector<int> ring{behind.begin()->first};
    while (ring.size() < behind.size()) ring.push_back(behind.at(ring.back()));
    return ring;
}

double FlatRing::gap() const { return 2 * pi - std::accumulate(angles.begin(), angles.end(), 0.0); }

FlatRing flat_ring(const TriangleMesh& mesh, const MeshTopology& topology, int vertex, double start) {
    const auto point = [&](int v) -> Vector3 { return mesh.X.row(v).transpose(); };
    const auto at = [](double length, double direction) {
        return DiagramPoint{length * std::cos(direction), length * std::sin(direction)};
    };
    std::vector<int> ring = ring_in_order(mesh, topology, vertex);
    ring.push_back(ring.front());
    FlatRing flat;
    double direction = start;
    for (std::size_t t = 0; t < ring.size(); ++t) {
        flat.corners.push_back(at((point(ring[t]) - point(vertex)).norm(), direction));
        if (t + 1 == ring.size()) break;
        flat.angles.push_back(triangle_shape(point(vertex), point(ring[t]), point(ring[t + 1])).angle(0));
        direction += flat.angles.back();
    }
    return flat;
}

bool is_obtuse(const FlatRing& ring, int t) { return std::ranges::min(corner_dots(ring, t)) < 0; }

std::vector<DiagramPoint> cell_in_triangle(const FlatRing& ring, int t, AreaForm form) {
    const DiagramPoint p = ring.corners[t], q = ring.corners[t + 1];
    const DiagramPoint before = between({0, 0}, p), behind = between({0, 0}, q);
    if (form == AreaForm::barycentric) return {{0, 0}, before, {(p[0] + q[0]) / 3, (p[1] + q[1]) / 3}, behind};
    if (form == AreaForm::voronoi || !is_obtuse(ring, t)) return {{0, 0}, before, circumcentre(p, q), behind};
    if (corner_dots(ring, t)[0] < 0) return {{0, 0}, before, between(p, q), behind};   // half of the triangle
    return {{0, 0}, before, behind};                                                   // a quarter
}

std::vector<DiagramPoint> cell_of(const FlatRing& ring, AreaForm form) {
    std::vector<DiagramPoint> cell;
    for (int t = 0; t < ring.triangles(); ++t) {
        const auto part = cell_in_triangle(ring, t, form);
        cell.insert(cell.end(), part.begin() + 1, part.end());
    }
    return cell;
}

double smallest_angle_around(const TriangleMesh& mesh, const MeshTopology& topology, int vertex) {
    double smallest = pi;
    for (const int* t = topology.vertex_faces.begin(vertex); t != topology.vertex_faces.end(vertex); ++t) {
        const TriangleShape shape = triangle_shape(mesh, *t, 1);
        for (std::size_t k = 0; k < 3; ++k) smallest = std::min(smallest, shape.angle(k));
    }
    return smallest;
}

Vector tangential_shares(const TriangleMesh& mesh, const MeshTopology& topology) {
    TriangleMesh centred = mesh;
    centred.X.rowwise() -= bounding_box(mesh).centre().transpose();   // coordinates far from 0 would cost digits
    const Positions drift = uniform_laplacian(topology) * centred.X;
    const Vector edge = mean_squared_ring_edge(centred, topology).cwiseSqrt();
    const Positions normals = vertex_normals(centred);
    Vector shares = Vector::Constant(mesh.vertex_count(), undefined);
    for (int i = 0; i < mesh.vertex_count(); ++i) {
        if (topology.neighbours.size(i) == 0 || topology.on_boundary[i] || topology.nonmanifold[i]) continue;
        const double length = drift.row(i).norm(), along_normal = drift.row(i).dot(normals.row(i));
        shares[i] = length > no_drift * edge[i] ? std::clamp(1 - along_normal * along_normal / (length * length), 0.0, 1.0) : 0;
    }
    return shares;
}

SampleRing ring_on_a_sphere() {
    SampleRing sample{icosphere(0), {}};
    sample.topology = topology_of(sample.mesh);
    sample.mesh.X =
        jittered(sample.mesh, sample.topology, sphere_jitter, ring_seed, [](const Vector3& p) -> Vector3 { return p.normalized(); });
    tangential_shares(sample.mesh, sample.topology).maxCoeff(&sample.vertex);
    return sample;
}

SampleRing obtuse_ring_in_a_plane() { return ring_in_a_plane(1, most_obtuse); }
SampleRing uneven_ring_in_a_plane() { return ring_in_a_plane(0, unevenness); }

}   // namespace meshfolio
