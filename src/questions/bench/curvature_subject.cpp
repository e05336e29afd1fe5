#include "questions/bench/curvature_subject.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/operators/uniform_laplacian.h"
#include "mesh/triangle_measures.h"
#include "questions/bench/known_surfaces.h"

namespace meshfolio {

namespace {

/// Vertices farther than this from the common plane, in box diagonals, make a mesh curved.
constexpr double flat_within = 1e-6;

}   // namespace

bool CurvatureSubject::inside(int vertex) const {
    const auto v = static_cast<std::size_t>(vertex);
    return topology().neighbours.size(vertex) > 0 && !topology().on_boundary[v] && !topology().nonmanifold[v];
}

CurvatureSubject curvature_subject(std::shared_ptr<const LibraryMesh> source) {
    CurvatureSubject subject;
    subject.source = std::move(source);
    subject.diagonal = bounding_box(subject.mesh()).diagonal();
    subject.mean_edge = mean_edge_length(subject.mesh());
    for (int i = 0; i < subject.mesh().vertex_count(); ++i) subject.interior += subject.inside(i) ? 1 : 0;
    subject.plane_normal = common_plane_normal(subject.mesh());
    // About the centre, so that far-away coordinates cost no digits.
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
    if (!((P * normal).cwiseAbs().maxCoeff() <= flat_within)) return std::nullopt;
    // A thin strip lies near many planes; only one that its triangles lie in makes it flat.
    const Positions normals = face_normals(mesh);
    for (Eigen::Index t = 0; t < normals.rows(); ++t) {
        const bool has_area = normals.row(t).squaredNorm() > 0;
        if (has_area && std::abs(normals.row(t).dot(normal)) < 0.99) return std::nullopt;
    }
    return normal;
}

double largest_magnitude(const Vector& values) {
    return largest_magnitude(values, [](int) { return true; });
}

double roughness(const Vector& values, const MeshTopology& topology) {
    const auto ninth_decile = [](std::vector<double>& sizes) {
        if (sizes.empty()) return 0.0;
        const auto at = sizes.begin() + static_cast<std::ptrdiff_t>(9 * (sizes.size() - 1) / 10);
        std::ranges::nth_element(sizes, at);
        return *at;
    };
    std::vector<double> jumps, sizes;
    for (const Edge& edge : topology.edges)
        if (const double jump = values[edge.a] - values[edge.b]; std::isfinite(jump)) jumps.push_back(std::abs(jump));
    for (const double value : values)
        if (std::isfinite(value)) sizes.push_back(std::abs(value));
    const double size = ninth_decile(sizes);
    return size > 0 ? ninth_decile(jumps) / size : 0;
}

double rank_correlation(const Vector& a, const Vector& b) {
    std::vector<int> both;
    for (int i = 0; i < a.size(); ++i)
        if (std::isfinite(a[i]) && std::isfinite(b[i])) both.push_back(i);
    const auto n = static_cast<Eigen::Index>(both.size());
    // Ranks about their mean, ties sharing theirs.
    const auto ranks_of = [&](const Vector& values) {
        std::vector<int> order = both;
        std::ranges::stable_sort(order, {}, [&](int i) { return values[i]; });
        Vector of_vertex = Vector::Zero(values.size()), ranks(n);
        for (std::size_t from = 0, to = 0; from < order.size(); from = to) {
            while (to < order.size() && values[order[to]] == values[order[from]]) ++to;
            for (std::size_t i = from; i < to; ++i) of_vertex[order[i]] = 0.5 * double(from + to) - 0.5 * double(n);
        }
        for (Eigen::Index i = 0; i < n; ++i) ranks[i] = of_vertex[both[static_cast<std::size_t>(i)]];
        return ranks;
    };
    const Vector ra = ranks_of(a), rb = ranks_of(b);
    const double size = ra.norm() * rb.norm();
    return size > 0 ? ra.dot(rb) / size : 0;
}

output::Panel relative_panel(const CurvatureSubject& subject, std::string name, std::string label, const Vector& values, double range) {
    TriangleMesh mesh = subject.mesh();
    mesh.X.rowwise() -= bounding_box(mesh).centre().transpose();
    const double radius = mesh.X.rowwise().norm().maxCoeff();
    if (radius > 0) mesh.X /= radius;
    return {std::move(name), std::move(label), std::make_shared<const TriangleMesh>(std::move(mesh)), 100 / range * values};
}

output::ColorRange relative_range(const std::vector<output::Panel>& panels, std::string quantity) {
    return range_for(
        {.colormap = "diverging", .low = -100, .high = 100, .quantity = std::move(quantity), .unit = curvature_words.line("own_range")},
        panels);
}

output::ColorRange range_for(const output::ColorRange& shared, const std::vector<output::Panel>& panels) {
    output::ColorRange range = shared;
    double below = 0, above = 0, finite = 0;
    for (const output::Panel& panel : panels) {
        for (const double v : panel.values) {
            finite += std::isfinite(v) ? 1 : 0;
            below += v < range.low ? 1 : 0;
            above += v > range.high ? 1 : 0;
        }
    }
    range.clipped_below = finite > 0 ? below / finite : 0;
    range.clipped_above = finite > 0 ? above / finite : 0;
    return range;
}

int undefined_vertices(const CurvatureSubject& subject) { return subject.source->prepared->preflight.vertices_in_use - subject.interior; }

std::string undefined_words(int vertices) { return vertices == 0 ? "" : " " + curvature_words.line("undefined", "vertices"_a = vertices); }

output::ColorRange range_from_zero(const std::vector<output::Panel>& panels, std::string colormap, std::string quantity, double floor) {
    output::ColorRange range = output::robust_range(panels, std::move(colormap), std::move(quantity), "", floor);
    range.low = 0;
    return range_for(range, panels);
}

}   // namespace meshfolio
