#include "questions/bench/mesh_class.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "geometry/linear/special_values.h"
#include "mesh/triangle_measures.h"
#include "questions/core/section_tools.h"

namespace meshfolio {

namespace {

struct EdgeAngle {
    int a, b;
    double degrees;
};

/// Pairs each face at the edge with the one that continues it best, and returns the largest bend: 90° for a fin on a flat sheet [°].
/// Directions away from the edge make the result independent of orientation.
double angle_of_fan(const TriangleMesh& mesh, const Edge& edge, const std::vector<int>& faces) {
    const Vector3 a = mesh.X.row(edge.a), along = (Vector3(mesh.X.row(edge.b)) - a).normalized();
    std::vector<Vector3> away;
    for (const int f : faces) {
        const int opposite = mesh.F.row(f).sum() - edge.a - edge.b;
        const Vector3 d = Vector3(mesh.X.row(opposite)) - a;
        away.push_back(d - d.dot(along) * along);
    }
    double worst = 0;
    for (std::size_t i = 0; i < away.size(); ++i) {
        double best = 180;
        for (std::size_t j = 0; j < away.size(); ++j)
            if (i != j) best = std::min(best, 180 / pi * std::atan2(away[i].cross(away[j]).norm(), -away[i].dot(away[j])));
        worst = std::max(worst, best);
    }
    return worst;
}

/// Computes the angle at every edge with two faces or more, in order; skips edges of triangles without a normal.
std::vector<EdgeAngle> edge_angles(const TriangleMesh& mesh, const MeshTopology& topology) {
    const Positions N = face_normals(mesh);
    const auto has_area = [&](int f) { return !N.row(f).isZero(0); };
    std::vector<EdgeAngle> angles;
    std::vector<int> faces;
    for (const Edge& edge : topology.edges) {
        faces.clear();
        std::set_intersection(topology.vertex_faces.begin(edge.a), topology.vertex_faces.end(edge.a), topology.vertex_faces.begin(edge.b),
                              topology.vertex_faces.end(edge.b), std::back_inserter(faces));
        if (faces.size() < 2 || !std::ranges::all_of(faces, has_area)) continue;
        const Vector3 n = N.row(faces[0]), m = N.row(faces[1]);
        angles.push_back(
            {edge.a, edge.b, faces.size() > 2 ? angle_of_fan(mesh, edge, faces) : 180 / pi * std::atan2(n.cross(m).norm(), n.dot(m))});
    }
    return angles;
}

/// Returns the median, the upper one of two; 0 without values.
double median_of(std::vector<double> values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + values.size() / 2;
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}   // namespace

std::vector<char> feature_vertices(const TriangleMesh& mesh, const MeshTopology& topology) {
    std::vector<char> on_feature(mesh.vertex_count(), 0);
    for (const EdgeAngle& edge : edge_angles(mesh, topology))
        if (edge.degrees > feature_angle) on_feature[edge.a] = on_feature[edge.b] = 1;
    return on_feature;
}

FlaggedMeans flagged_means(const Vector& values, const std::vector<char>& flags) {
    double sums[2] = {0, 0};
    int counts[2] = {0, 0};
    for (Eigen::Index v = 0; v < values.size(); ++v) {
        sums[flags[v] != 0] += values[v];
        ++counts[flags[v] != 0];
    }
    return {sums[1] / counts[1], sums[0] / counts[0], counts[1], counts[0]};
}

int sharpest_vertex(const TriangleMesh& mesh, const MeshTopology& topology) {
    int vertex = mesh.face_count() > 0 ? mesh.F(0, 0) : 0;
    double sharpest = 0;
    for (const EdgeAngle& edge : edge_angles(mesh, topology)) {
        // The choice must not hang on the last bit.
        if (edge.degrees <= sharpest + 1e-6) continue;
        sharpest = edge.degrees;
        vertex = edge.a;
    }
    return vertex;
}

std::string_view title_of(MeshClass kind) {
    static constexpr std::array<std::string_view, 4> titles{"flat", "smooth", "sharp-edged", "rough or coarse"};
    return titles[int(kind)];
}

MeshClass MeshCharacter::kind() const {
    if (largest_angle < 1) return MeshClass::flat;
    if (feature_share < 0.01) return MeshClass::smooth;
    return typical_angle < 10 ? MeshClass::sharp_edged : MeshClass::rough;
}

double median_face_angle(const TriangleMesh& mesh, const MeshTopology& topology) {
    return median_of(each_of(edge_angles(mesh, topology), &EdgeAngle::degrees));
}

Vector vertex_face_angles(const TriangleMesh& mesh, const MeshTopology& topology) {
    Vector sum = Vector::Zero(mesh.vertex_count()), count = sum;
    for (const EdgeAngle& edge : edge_angles(mesh, topology)) {
        for (const int v : {edge.a, edge.b}) {
            sum[v] += edge.degrees;
            count[v] += 1;
        }
    }
    return sum.cwiseQuotient(count);
}

MeshCharacter mesh_character(const TriangleMesh& mesh, const MeshTopology& topology) {
    MeshCharacter character;
    std::vector<double> others;
    for (const EdgeAngle& edge : edge_angles(mesh, topology)) {
        character.largest_angle = std::max(character.largest_angle, edge.degrees);
        if (edge.degrees <= feature_angle) others.push_back(edge.degrees);
    }
    character.typical_angle = median_of(others);
    const std::vector<char> on_feature = feature_vertices(mesh, topology);
    if (!on_feature.empty())
        character.feature_share = static_cast<double>(std::ranges::count(on_feature, 1)) / static_cast<double>(on_feature.size());
    character.open = topology.boundary_edge_count() > 0;
    return character;
}

}   // namespace meshfolio
