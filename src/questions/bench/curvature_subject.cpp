#include "questions/bench/curvature_subject.h"

#include <Eigen/Eigenvalues>

#include "geometry/operators/uniform_laplacian.h"
#include "mesh/triangle_kind.h"
#include "questions/bench/bench_mesh.h"

namespace meshfolio {

bool CurvatureSubject::inside(int vertex) const {
    return topology().neighbours.size(vertex) > 0 && !topology().on_boundary[vertex] && !topology().nonmanifold[vertex];
}

bool CurvatureSubject::is_rounding(double length) const {
    // Each coordinate is off by up to half a step, so Δx, a mean of differences, by up to √3 steps.
    return length > 1e-9 * mean_edge && length <= 0.5 * std::sqrt(3) * coordinate_step(mesh());
}

double coordinate_step(const TriangleMesh& mesh) {
    double steps = 1;   // per unit
    for (int decimals = 0; decimals <= 8; ++decimals, steps *= 10) {
        const Positions X = steps * mesh.X;
        if (((X.array() - X.array().round()).abs() <= 1e-15 * X.array().abs() + 1e-9).all()) return 1 / steps;
    }
    return 0;
}

CurvatureSubject curvature_subject(SharedMesh source) {
    CurvatureSubject subject;
    subject.source = std::move(source);
    subject.diagonal = bounding_box(subject.mesh()).diagonal();
    subject.mean_edge = mean_edge_length(subject.mesh());
    for (int i = 0; i < subject.mesh().vertex_count(); ++i) subject.interior += subject.inside(i) ? 1 : 0;
    subject.plane_normal = common_plane_normal(subject.mesh());
    // About the centre, because coordinates far from 0 would cost digits.
    const Eigen::RowVector3d centre = bounding_box(subject.mesh()).centre().transpose();
    subject.centred = subject.mesh().X.rowwise() - centre;
    subject.uniform = uniform_laplacian(subject.topology()) * subject.centred;
    return subject;
}

std::optional<Vector3> common_plane_normal(const TriangleMesh& mesh) {
    const Box box = bounding_box(mesh);
    Positions P = without_unreferenced_vertices(mesh).mesh.X;
    P = (P.rowwise() - box.centre().transpose()) / box.diagonal();
    const Eigen::RowVector3d mean = P.colwise().mean();
    P.rowwise() -= mean;
    const Eigen::Matrix3d covariance = P.transpose() * P;
    const Vector3 normal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors().col(0);
    if (!((P * normal).cwiseAbs().maxCoeff() <= 1e-6)) return std::nullopt;
    // A thin strip lies near many planes, so its triangles must lie in this one. Triangles of a folded sheet look both ways, and the angles
    // at a vertex with a sheet wound round it twice add up to 4π.
    const Positions normals = face_normals(mesh);
    const CornerValues angles = corner_angles(mesh);
    Vector around = Vector::Zero(mesh.vertex_count());
    double side = 0;   // of the first triangle
    for (int t = 0; t < mesh.face_count(); ++t) {
        if (kind_of(mesh, t) == TriangleKind::zero_area) continue;
        const double cosine = normals.row(t).dot(normal);
        if (side == 0) side = cosine > 0 ? 1 : -1;
        if (!(side * cosine > 0.99)) return std::nullopt;
        for (int k = 0; k < 3; ++k)
            if ((around[mesh.F(t, k)] += angles(t, k)) > 3 * pi) return std::nullopt;
    }
    return normal;
}

Vector differences_along_edges(const Vector& values, const MeshTopology& topology) {
    Vector differences(static_cast<Eigen::Index>(topology.edges.size()));
    Eigen::Index e = 0;
    for (const Edge& edge : topology.edges) differences[e++] = values[edge.a] - values[edge.b];
    return differences;
}

double roughness(const Vector& values, const MeshTopology& topology) {
    const auto ninth_decile = [](const Vector& differences) {
        const std::vector<double> sizes = sorted_finite(differences.cwiseAbs());
        return sizes.empty() ? 0.0 : sizes[9 * (sizes.size() - 1) / 10];
    };
    const double size = ninth_decile(values);
    return size > 0 ? ninth_decile(differences_along_edges(values, topology)) / size : 0;
}

double rank_correlation(const Vector& a, const Vector& b) {
    const std::vector<int> both = where_finite(a, b);
    const auto n = static_cast<Eigen::Index>(both.size());
    // Ranks minus their mean; ties share the mean of theirs.
    const auto ranks_of = [&](const Vector& values) {
        std::vector<int> order = both;
        std::ranges::stable_sort(order, {}, [&](int i) { return values[i]; });
        Vector of_vertex = Vector::Zero(values.size()), ranks(n);
        for (std::size_t from = 0, to = 0; from < order.size(); from = to) {
            while (to < order.size() && values[order[to]] == values[order[from]]) ++to;
            for (std::size_t i = from; i < to; ++i) of_vertex[order[i]] = 0.5 * double(from + to) - 0.5 * double(n);
        }
        for (Eigen::Index i = 0; i < n; ++i) ranks[i] = of_vertex[both[i]];
        return ranks;
    };
    const Vector ra = ranks_of(a), rb = ranks_of(b);
    const double size = ra.norm() * rb.norm();
    return size > 0 ? ra.dot(rb) / size : 0;
}

output::Panel unit_ball_panel(const CurvatureSubject& subject, std::string name, std::string label, Vector values) {
    TriangleMesh mesh = subject.mesh();
    mesh.X.rowwise() -= bounding_box(mesh).centre().transpose();
    const double radius = mesh.X.rowwise().norm().maxCoeff();
    if (radius > 0) mesh.X /= radius;
    return {std::move(name), std::move(label), std::make_shared<const TriangleMesh>(std::move(mesh)), std::move(values)};
}

void set_own_range(output::Panel& panel, double end, std::string quantity, std::string unit) {
    panel.range = range_for({"diverging", -end, end, std::move(quantity), std::move(unit)}, {panel});
}

double share_beyond(const Vector& values, double range) {
    int beyond = 0, finite = 0;
    for (const double v : values) {
        finite += std::isfinite(v) ? 1 : 0;
        beyond += std::abs(v) > range ? 1 : 0;
    }
    return finite > 0 ? double(beyond) / finite : 0;
}

SignsByDistance signs_by_distance(const CurvatureSubject& subject, const Vector& values) {
    std::vector<int> order = where_finite(values, values);
    std::ranges::stable_sort(order, {}, [&](int i) { return subject.centred.row(i).squaredNorm(); });
    const auto share = [&](std::size_t first, std::size_t last, auto chosen) {
        const auto begin = order.begin() + first, end = order.begin() + last;
        return first < last ? double(std::count_if(begin, end, [&](int i) { return chosen(values[i]); })) / double(last - first) : 0;
    };
    const auto positive = [&](double v) { return v > 0; };
    const auto negative = [&](double v) { return v < 0; };
    const std::size_t n = order.size();
    return {share(0, n, positive), share(0, n, negative), share(n - n / 5, n, positive), share(0, n / 2, negative)};
}

output::ColorRange range_for(output::ColorRange shared, const std::vector<output::Panel>& panels) {
    output::enter_clipped(shared, output::finite_values(panels));
    return shared;
}

UndefinedVertices undefined_vertices(const CurvatureSubject& subject) {
    UndefinedVertices vertices;
    for (int i = 0; i < subject.mesh().vertex_count(); ++i) {
        const bool isolated = subject.topology().neighbours.size(i) == 0;
        if (isolated || subject.inside(i)) continue;
        (subject.topology().nonmanifold[i] ? vertices.nonmanifold : vertices.boundary) += 1;
    }
    return vertices;
}

std::string undefined_words(const UndefinedVertices& vertices) {
    const auto [boundary, nonmanifold] = vertices;
    if (boundary + nonmanifold == 0) return "";
    const char* key = nonmanifold == 0 ? "undefined.boundary" : boundary == 0 ? "undefined.nonmanifold" : "undefined.both";
    return " " + curvature_words.line(key, "boundary"_a = boundary, "nonmanifold"_a = nonmanifold);
}

double diverging_range(const Vector& values, double floor) {
    output::Panel panel;
    panel.values = values;
    return output::robust_range({panel}, "diverging", "", "", floor).high;
}

output::ColorRange range_from_zero(const std::vector<output::Panel>& panels, std::string colormap, std::string quantity, double floor,
                                   std::string unit) {
    output::ColorRange range = output::robust_range(panels, std::move(colormap), std::move(quantity), std::move(unit), floor);
    range.low = 0;
    return range_for(range, panels);
}

}   // namespace meshfolio
