#include "questions/bench/uniform_curvature_study.h"

#include <utility>

#include "geometry/curvature/curvature.h"
#include "geometry/linear/special_values.h"
#include "geometry/operators/uniform_laplacian.h"

namespace meshfolio {

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

UniformErrors uniform_errors(const SampledSurface& s) {
    UniformErrors e;
    e.vertices = s.mesh.vertex_count();
    e.faces = s.mesh.face_count();
    e.mean_edge = s.mean_edge;
    e.smallest_angle = s.smallest_angle;
    e.mean_length = uniform_mean_curvature(s.mesh, s.topology).mean();
    e.H = relative_error(uniform_mean_curvature_scaled(s.mesh, s.topology), s.H, s.areas);
    const Positions uniform = uniform_laplacian(s.topology) * s.mesh.X;
    const Vector along_normal = -0.5 * uniform.cwiseProduct(s.normals).rowwise().sum();
    e.normal_part = relative_error(4 * along_normal.cwiseQuotient(mean_squared_ring_edge(s.mesh, s.topology)), s.H, s.areas);
    const Vector deficit = angle_deficit(s.mesh, s.topology);
    for (std::size_t form = 0; form < area_forms.size(); ++form) {
        const Vector areas = area_forms[form] == AreaForm::barycentric ? s.areas : vertex_areas(s.mesh, area_forms[form]);
        const Vector K = (areas.array() > 0).select(deficit.cwiseQuotient(areas), std::nan(""));   // closed: no boundary to mask
        e.K[form] = relative_error(K, s.K, s.areas);
        e.undefined[form] = summary_of(K).undefined;
    }
    e.euler_from_angles = deficit.sum() / (2 * pi);
    e.euler = e.vertices - static_cast<int>(s.topology.edges.size()) + e.faces;
    return e;
}

std::string area_name(AreaForm form) { return form == AreaForm::voronoi ? "Voronoi" : std::string(name_of(form)); }

ErrorHistory uniform_H(const UniformRefinement& refinement) {
    return refinement.history([](const UniformErrors& level) { return level.H.l2; });
}

ErrorHistory deficit_K(const UniformRefinement& refinement, std::size_t area_form) {
    return refinement.history([area_form](const UniformErrors& level) { return level.K[area_form].l2; });
}

JitterFactors jitter_factors(const std::vector<UniformRefinement>& refinements, bool gaussian) {
    const auto error = [&](const UniformRefinement& r) { return gaussian ? deficit_K(r).last() : uniform_H(r).last(); };
    JitterFactors factors;
    for (const UniformRefinement& jittered : refinements) {
        if (jittered.triangulation != Triangulation::jittered) continue;
        const double factor = error(jittered) / error(refinement_on(refinements, jittered.surface.name, Triangulation::regular));
        factors.least = std::min(factors.least, factor);
        factors.most = std::max(factors.most, factor);
    }
    return factors;
}

std::vector<AngleSum> angle_sums(const std::vector<MeshCurvature>& meshes, const std::vector<UniformRefinement>& refinements) {
    std::vector<AngleSum> sums;
    for (const MeshCurvature& c : meshes) {
        const Preflight& p = c.subject.source->prepared->preflight;
        sums.push_back({c.subject.name(), p.vertices_in_use, p.triangles, p.euler_characteristic, c.euler_from_angles(),
                        p.manifold() && p.zero_area_faces == 0});
    }
    for (const UniformRefinement& r : refinements) {
        const UniformErrors& e = r.finest();
        sums.push_back({r.title(), e.vertices, e.faces, e.euler, e.euler_from_angles, true});
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

}   // namespace meshfolio
