#include "questions/bench/cotangent_study.h"

#include "geometry/curvature/curvature.h"
#include "geometry/operators/cotangent_laplacian.h"
#include "mesh/samples/sample_shapes.h"
#include "questions/bench/estimators.h"

namespace meshfolio {

namespace {

/// Computes n values ½‖Lx‖, boundary included; 0 where a vertex has no area.
Vector half_laplacian_length(const LaplaceBeltrami& laplacian, const Positions& X) {
    const Vector M = summed_at_first(laplacian.copies, laplacian.M);
    Vector length = Vector::Zero(X.rows());
    for (Eigen::Index i = 0; i < X.rows(); ++i) {
        if (!(M[i] > 0)) continue;
        Eigen::RowVector3d pull = Eigen::RowVector3d::Zero();   // Σ C_ij (x_j − x_i): rows sum to 0, so the origin does not matter
        for (SparseMatrix::InnerIterator entry(laplacian.C, i); entry; ++entry) pull += entry.value() * (X.row(entry.row()) - X.row(i));
        length[i] = 0.5 * pull.norm() / M[i];
    }
    spread(laplacian.copies, length);
    return length;
}

/// Computes the root mean square of the finite values; 0 without any.
double rms(const Vector& values) {
    double sum = 0;
    int n = 0;
    for (const double v : values) {
        if (!std::isfinite(v)) continue;
        sum += v * v;
        ++n;
    }
    return n == 0 ? 0 : std::sqrt(sum / n);
}

constexpr double curvature_noise = 1e-9;   // curvature × mean edge that rounding in ½‖Lx‖ leaves on a flat mesh

OperatorVariant variant_of(const CurvatureSubject& s, std::string name, const CotangentOptions& options, const Vector& reference) {
    const LaplaceBeltrami laplacian = laplace_beltrami(s.mesh(), AreaForm::barycentric, options);
    const NegativeWeights negative = negative_weights(laplacian.C, s.topology());
    const Vector length = s.mean_edge * half_laplacian_length(laplacian, s.centred);
    OperatorVariant v;
    v.name = std::move(name);
    v.negative_inside = negative.inside;
    v.negative_boundary = negative.boundary;
    v.smallest_weight = negative.smallest;
    v.inside = largest_magnitude(length, [&](int i) { return s.inside(i); });
    v.boundary = largest_magnitude(length, [&](int i) { return s.topology().on_boundary[i] != 0; });
    const double scale = rms(reference);
    const Vector change = cotangent_mean_curvature(s.mesh(), s.topology(), laplacian) - reference;
    v.change = scale * s.mean_edge > curvature_noise ? rms(change) / scale : std::nan("");
    return v;
}

}   // namespace

CotangentComparison compare_operators(SharedMesh source) {
    CotangentComparison c;
    c.subject = curvature_subject(std::move(source));
    const TriangleMesh& mesh = c.subject.mesh();
    const MeshTopology& topology = c.subject.topology();
    c.uniform = uniform_mean_curvature_scaled(mesh, topology);
    c.cotangent = cotangent_mean_curvature(mesh, topology, laplace_beltrami(mesh));
    c.difference = c.cotangent - c.uniform;
    c.drift = c.subject.mean_edge * largest_magnitude(c.uniform);
    c.precision = c.subject.mean_edge * largest_magnitude(c.cotangent);
    c.rms_uniform = rms(c.uniform);
    c.rms_difference = rms(c.difference);
    c.jump_uniform = rms(differences_along_edges(c.uniform, topology));
    c.jump_cotangent = rms(differences_along_edges(c.cotangent, topology));
    const auto is_defined = c.difference.array().isFinite().eval();
    const auto opposite = is_defined && c.uniform.array() * c.cotangent.array() < 0;
    c.sign_change = is_defined.any() ? double(opposite.count()) / double(is_defined.count()) : 0;
    c.variants = {variant_of(c.subject, curvature_words.line("variant.half_sum"), {}, c.cotangent),
                  variant_of(c.subject, curvature_words.line("variant.opposite_mean"),
                             {.opposite = CotangentOptions::OppositeVertices::mean}, c.cotangent),
                  variant_of(c.subject, curvature_words.line("variant.clamped"), {.clamp_negative = true}, c.cotangent)};
    return c;
}

PlaneTest irregular_plane(std::uint64_t seed) {
    const KnownSurface square{.mesh_at = [](int) { return grid_mesh(24, 24, 1, 1); },
                              .projected = [](const Vector3& p) { return Vector3(p.x(), p.y(), 0); },
                              .normal_at = [](const Vector3&) { return Vector3(0, 0, 1); },
                              .curvature_at = [](const Vector3&) { return CurvaturePair{}; }};
    const BenchMesh b = bench_mesh(square, MeshKind::jittered, 0, seed);
    const auto H = [&](const char* key) -> Vector { return b.mean_edge * estimator(key).estimate(b); };
    PlaneTest test{b.mesh, H("H.uniform"), H("H.barycentric")};
    test.negative_weights = negative_weights(b.C(), b.topology).inside / double(b.topology.edges.size());
    test.uniform = largest_magnitude(test.uniform_H);
    test.cotangent = largest_magnitude(test.cotangent_H);
    test.clamped = largest_magnitude(H("H.clamped"));
    return test;
}

}   // namespace meshfolio
