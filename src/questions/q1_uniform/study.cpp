#include "questions/q1_uniform/parts.h"

#include "geometry/curvature/curvature.h"
#include "geometry/measures/mesh_laws.h"
#include "geometry/operators/cotangent_laplacian.h"
#include "geometry/operators/uniform_laplacian.h"
#include "geometry/operators/vertex_areas.h"
#include "questions/bench/one_ring.h"

namespace meshfolio::q1_uniform {

namespace {

constexpr double deficit_rounding = 1e-12;   // [rad]

/// Returns the 98th over the 2nd percentile of the magnitudes; 0 unless all values have one sign.
double spread_of(const Vector& values) {
    const std::vector<double> sorted = sorted_finite(values);
    if (sorted.empty() || !(sorted.front() * sorted.back() > 0)) return 0;
    const double low = sorted[sorted.size() / 50], high = sorted[sorted.size() - 1 - sorted.size() / 50];
    return std::max(high / low, low / high);
}

}   // namespace

MeshCurvature curvature_of(SharedMesh source) {
    MeshCurvature c;
    c.subject = curvature_subject(std::move(source));
    const TriangleMesh& mesh = c.subject.mesh();
    const MeshTopology& topology = c.subject.topology();
    c.length = uniform_mean_curvature(mesh, topology);
    c.H = uniform_mean_curvature_scaled(mesh, topology);
    c.areas = vertex_areas(mesh, AreaForm::barycentric);
    c.K = gaussian_curvature(mesh, topology, c.areas);
    c.cotangent = cotangent_mean_curvature(mesh, topology, laplace_beltrami(mesh));
    c.deficit = angle_deficit(mesh, topology);
    return c;
}

Contrast contrast(const Vector& values, const Vector& by) {
    std::vector<int> order = where_finite(values, by);
    if (order.size() < 8) return {undefined, undefined};
    std::ranges::stable_sort(order, {}, [&](int i) { return by[i]; });
    const auto median = [&](auto first, auto last) {
        std::vector<double> chosen;
        for (auto i = first; i != last; ++i) chosen.push_back(values[*i]);
        std::ranges::sort(chosen);
        return chosen[chosen.size() / 2];
    };
    const auto quarter = static_cast<std::ptrdiff_t>(order.size() / 4);
    return {median(order.begin(), order.begin() + quarter), median(order.end() - quarter, order.end())};
}

TangentialPart tangential_part(const MeshCurvature& c) {
    const CurvatureSubject& s = c.subject;
    const Vector along = s.uniform.cwiseProduct(vertex_normals(s.mesh())).rowwise().sum();   // Δx · n
    const Vector scale = mean_squared_ring_edge(s.mesh(), s.topology());
    TangentialPart part;
    part.shares = tangential_shares(s.mesh(), s.topology());
    double whole = 0, normal = 0, truth = 0, gap = 0, normal_gap = 0;
    for (int i = 0; i < s.mesh().vertex_count(); ++i) {
        if (!std::isfinite(c.H[i]) || !std::isfinite(c.cotangent[i])) continue;
        whole += s.uniform.row(i).squaredNorm();
        normal += along[i] * along[i];
        truth += c.cotangent[i] * c.cotangent[i];
        gap += std::pow(c.H[i] - c.cotangent[i], 2);
        normal_gap += std::pow(-2 * along[i] / scale[i] - c.cotangent[i], 2);
    }
    if (whole > 0) part.share = 1 - normal / whole;
    part.gap = std::sqrt(gap / truth);
    part.normal_gap = std::sqrt(normal_gap / truth);
    part.length = contrast(part.shares, c.length.cwiseAbs());
    return part;
}

FlatParts flat_parts(const MeshCurvature& c) {
    const auto within = [](const Vector& values) { return flat_within * diverging_range(values); };
    const double K = within(c.K), H = within(c.cotangent), length = within(c.length);
    const Vector shares = tangential_shares(c.subject.mesh(), c.subject.topology());
    FlatParts flat;
    std::vector<double> drift;
    int defined = 0, coloured = 0;
    for (int i = 0; i < c.K.size(); ++i) {
        if (!std::isfinite(c.K[i]) || !std::isfinite(c.cotangent[i])) continue;
        ++defined;
        if (std::abs(c.K[i]) > K || std::abs(c.cotangent[i]) > H) continue;
        drift.push_back(shares[i]);
        coloured += std::abs(c.length[i]) > length ? 1 : 0;
    }
    if (drift.empty()) return flat;
    flat.vertices = static_cast<int>(drift.size());
    flat.share = double(flat.vertices) / defined;
    flat.coloured = double(coloured) / flat.vertices;
    std::ranges::sort(drift);
    flat.drift = drift[drift.size() / 2];
    return flat;
}

Picture picture_of(const MeshCurvature& c) {
    return {rank_correlation(c.length, c.cotangent), spread_of(c.length), spread_of(c.cotangent)};
}

bool looks_alike_from_all_sides(const MeshCurvature& c) { return c.subject.plane_normal || picture_of(c).is_even(); }

SignsOfK signs_of_K(const MeshCurvature& c) {
    const Vector K = (c.deficit.array().abs() > deficit_rounding).select(c.K, 0 * c.K);   // NaN stays NaN
    return {signs_by_distance(c.subject, K), 1 - share_beyond(c.K, white_within * diverging_range(c.K))};
}

IrregularVertices irregular_vertices(const MeshCurvature& c) {
    const ValueSummary K = summary_of(c.K);
    if (K.count == 0 || !(K.minimum * K.maximum > 0)) return {};
    const CurvatureSubject& s = c.subject;
    const Vector with_voronoi = gaussian_curvature(s.mesh(), s.topology(), vertex_areas(s.mesh(), AreaForm::voronoi));
    IrregularVertices found;
    const auto off = [](double k, double median) { return std::isfinite(k) ? std::abs(k / median - 1) : INFINITY; };
    const double voronoi_median = summary_of(with_voronoi).median;
    for (int i = 0; i < c.K.size(); ++i) {
        if (!std::isfinite(c.K[i])) continue;
        const bool irregular = s.topology().neighbours.size(i) != 6;
        double& most = irregular ? found.off : found.off_elsewhere;
        most = std::max(most, off(c.K[i], K.median));
        if (!irregular) continue;
        found.vertices.push_back(i);
        found.off_with_voronoi = std::max(found.off_with_voronoi, off(with_voronoi[i], voronoi_median));
    }
    return 20 * found.vertices.size() <= static_cast<std::size_t>(K.count) ? found : IrregularVertices{};
}

AngleSums angle_sums(const Meshes& meshes, const BenchRuns& runs) {
    AngleSums sums;
    for (const MeshCurvature& c : meshes) {
        const Preflight& p = c.subject.preflight();
        sums.push_back({c.name(), p.vertices_in_use, p.triangles, p.euler_characteristic, total_deficit(c.deficit) / (2 * pi),
                        p.manifold() && p.zero_area_faces == 0});
    }
    for (const BenchRun& run : runs) {
        const BenchLevel& level = run.finest();
        sums.push_back({run.title(), level.vertices, level.faces, level.euler, level.euler_from_angles, true});
    }
    return sums;
}

FlatMesh flat_mesh(const MeshCurvature& c) {
    const CurvatureSubject& s = c.subject;
    const auto inside = [&](int i) { return s.inside(i); };
    const auto boundary = [&](int i) { return s.topology().on_boundary[i] != 0; };
    const Vector lengths = 0.5 / s.mean_edge * s.uniform.rowwise().norm();
    FlatMesh f;
    f.curvature = &c;
    f.normal_part = largest_magnitude(s.uniform * *s.plane_normal / s.mean_edge, inside);
    f.drift = largest_magnitude(lengths, inside);
    f.deficit = largest_magnitude(c.deficit, inside);
    f.boundary_length = largest_magnitude(lengths, boundary);
    for (int i = 0; i < c.deficit.size(); ++i) {
        if (!boundary(i)) continue;
        ++f.boundary_vertices;
        f.turning += c.deficit[i] / (2 * pi);
    }
    return f;
}

}   // namespace meshfolio::q1_uniform
