#include "questions/q1_uniform/study.h"

#include <utility>

#include "geometry/curvature/curvature.h"
#include "geometry/linear/special_values.h"
#include "geometry/operators/cotangent_laplacian.h"
#include "geometry/operators/uniform_laplacian.h"
#include "geometry/operators/vertex_areas.h"
#include "mesh/triangle_measures.h"

namespace meshfolio::q1_uniform {

double MeshCurvature::euler_from_angles() const { return deficit.sum() / (2 * pi); }

MeshCurvature curvature_of(std::shared_ptr<const LibraryMesh> source) {
    MeshCurvature c;
    c.subject = curvature_subject(std::move(source));
    const TriangleMesh& mesh = c.subject.mesh();
    const MeshTopology& topology = c.subject.topology();
    c.length = uniform_mean_curvature(mesh, topology);
    c.H = uniform_mean_curvature_scaled(mesh, topology);
    c.areas = vertex_areas(mesh, AreaForm::barycentric);
    c.K = gaussian_curvature(mesh, topology, c.areas);
    c.deficit = angle_deficit(mesh, topology);
    return c;
}

TangentialPart tangential_part(const MeshCurvature& c) {
    const CurvatureSubject& s = c.subject;
    const Vector along = s.uniform.cwiseProduct(vertex_normals(s.mesh())).rowwise().sum();   // Δx · n
    const Vector scale = mean_squared_ring_edge(s.mesh(), s.topology());
    const Vector cotangent = cotangent_mean_curvature(s.mesh(), s.topology(), laplace_beltrami(s.mesh()));
    double whole = 0, normal = 0, truth = 0, gap = 0, normal_gap = 0;
    for (int i = 0; i < s.mesh().vertex_count(); ++i) {
        if (!std::isfinite(c.H[i]) || !std::isfinite(cotangent[i])) continue;
        whole += s.uniform.row(i).squaredNorm();
        normal += along[i] * along[i];
        truth += cotangent[i] * cotangent[i];
        gap += std::pow(c.H[i] - cotangent[i], 2);
        normal_gap += std::pow(-2 * along[i] / scale[i] - cotangent[i], 2);
    }
    return {1 - normal / whole, std::sqrt(gap / truth), std::sqrt(normal_gap / truth)};
}

JitterFactors jitter_factors(const BenchRuns& runs, std::string_view estimator) {
    JitterFactors factors;
    for (const BenchRun& jittered : of_kind(runs, MeshKind::jittered)) {
        const BenchRun& regular = run_on(runs, jittered.surface, MeshKind::regular);
        const double factor = jittered.finest().error(estimator).l2 / regular.finest().error(estimator).l2;
        factors.least = std::min(factors.least, factor);
        factors.most = std::max(factors.most, factor);
    }
    return factors;
}

std::vector<AngleSum> angle_sums(const std::vector<MeshCurvature>& meshes, const BenchRuns& runs) {
    std::vector<AngleSum> sums;
    for (const MeshCurvature& c : meshes) {
        const Preflight& p = c.subject.source->prepared->preflight;
        sums.push_back({c.subject.name(), p.vertices_in_use, p.triangles, p.euler_characteristic, c.euler_from_angles(),
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
    const auto boundary = [&](int i) { return s.topology().on_boundary[static_cast<std::size_t>(i)] != 0; };
    const Vector lengths = 0.5 / s.mean_edge * s.uniform.rowwise().norm();
    FlatMesh f;
    f.curvature = &c;
    f.normal_part = largest_magnitude(s.uniform * *s.plane_normal / s.mean_edge, inside);
    f.drift = largest_magnitude(lengths, inside);
    f.deficit = largest_magnitude(c.deficit, inside);
    f.boundary_length = largest_magnitude(lengths, boundary);
    f.largest_turning = largest_magnitude(c.deficit, boundary);
    for (int i = 0; i < c.deficit.size(); ++i) {
        if (!boundary(i)) continue;
        ++f.boundary_vertices;
        f.turning += c.deficit[i] / (2 * pi);
        // π − Σθ is stored there; the interior formula would have 2π − Σθ.
        if (c.areas[i] > 0) f.boundary_K = std::max(f.boundary_K, std::abs(c.deficit[i] + pi) / c.areas[i] * s.diagonal * s.diagonal);
    }
    return f;
}

}   // namespace meshfolio::q1_uniform
