#include "questions/stability/study.h"

#include "geometry/measures/mesh_error.h"
#include "geometry/operators/uniform_laplacian.h"
#include "questions/bench/smoothing_study.h"

namespace meshfolio::stability {

namespace {

OperatorLimit operator_limit(std::string name, OperatorKind kind, const LaplaceBeltrami& laplacian, const TriangleMesh& mesh,
                             double mean_edge, int steps) {
    OperatorLimit limit;
    limit.name = std::move(name);
    limit.certificate = stability_certificate(laplacian, {.assembly = assembly_of(kind)});
    const LargestEigenvalue& top = limit.certificate.top;
    const Positions centred = mesh.X.rowwise() - bounding_box(mesh).centre().transpose();   // far away the seed would be lost in rounding
    const Positions start = seeded(centred, top, 1e-3 * mean_edge);
    limit.below = mode_growth(laplacian, top, start, 0.99 * limit.critical(), steps);
    limit.beyond = mode_growth(laplacian, top, start, 1.01 * limit.critical(), steps);
    return limit;
}

/// The first triangle whose normal has turned by more than 90° from that given; −1 without any.
int first_turned(const TriangleMesh& mesh, const Positions& normals) {
    const Positions now = face_normals(mesh);
    for (int t = 0; t < mesh.face_count(); ++t)
        if (now.row(t).dot(normals.row(t)) < 0) return t;
    return -1;
}

WatchedRun watched_run(const TriangleMesh& mesh, SmoothingOptions options) {
    WatchedRun watched{.run = {}, .lambda = options.lambda, .iterations = options.iterations};
    const Positions normals = face_normals(mesh);
    options.after_step = [&](int iteration, const Positions& X) {
        if (watched.turned_iteration > 0) return true;
        watched.turned_face = first_turned(moved_to(mesh, X), normals);
        if (watched.turned_face >= 0) watched.turned_iteration = iteration;
        return true;
    };
    watched.run = smooth(mesh, options);
    watched.inverted = compare_meshes(mesh, moved_to(mesh, watched.run.X)).inverted_faces;
    return watched;
}

LimitingVertex limiting_vertex(const LaplaceBeltrami& laplacian, const LibraryMesh& source, int vertex) {
    const TriangleMesh& mesh = source.mesh();
    const OperatorWithMass whole = operator_with_mass(laplacian);
    LimitingVertex limiting{vertex, laplacian.M[vertex] / summary_of(whole.M).median,
                            -laplacian.C.coeff(vertex, vertex) / summary_of(whole.A.diagonal()).median,
                            source.topology().on_boundary[vertex] != 0, pi};
    const CornerValues angles = corner_angles(mesh);
    for (int t = 0; t < mesh.face_count(); ++t)
        if ((mesh.F.row(t).array() == vertex).any()) limiting.smallest_angle = std::min(limiting.smallest_angle, angles.row(t).minCoeff());
    return limiting;
}

}   // namespace

StabilityStudy stability_study(SharedMesh source, const QuestionSettings& settings) {
    StabilityStudy study;
    study.source = std::move(source);
    study.mean_edge = mean_edge_length(study.mesh());
    study.diagonal = bounding_box(study.mesh()).diagonal();
    const int steps = settings.quick ? 200 : 500;
    const LaplaceBeltrami laplacian = laplace_beltrami(study.mesh());
    study.cotangent = operator_limit("cotangent", OperatorKind::cotan, laplacian, study.mesh(), study.mean_edge, steps);
    study.uniform = operator_limit("uniform", OperatorKind::uniform, uniform_operator(study.mesh(), study.topology()), study.mesh(),
                                   study.mean_edge, steps);
    study.limiting = limiting_vertex(laplacian, *study.source, study.cotangent.certificate.top.vertex);
    return study;
}

RebuiltFlow rebuilt_flow(const StabilityStudy& study, const QuestionSettings& settings) {
    RebuiltFlow flow;
    flow.source = study.source;
    flow.lambda = 0.5 * study.cotangent.critical();
    flow.share = 0.95;
    flow.iterations = settings.quick ? 20 : 30;
    flow.beyond = 2;   // the top mode triples in each step
    SmoothingOptions options{.lambda = flow.lambda, .iterations = flow.iterations, .rebuild = true, .monitor = true};
    flow.fixed = watched_run(study.mesh(), options);
    options.adaptive = flow.share;
    flow.adaptive = watched_run(study.mesh(), options);
    flow.frozen = watched_run(study.mesh(), {.lambda = flow.beyond * study.cotangent.critical(), .iterations = 100, .monitor = true});
    return flow;
}

}   // namespace meshfolio::stability
