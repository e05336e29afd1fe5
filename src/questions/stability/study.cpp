#include "questions/stability/study.h"
#include "geometry/measures/mesh_error.h"
#include "geometry/operators/uniform_laplacian.h"

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

WatchedRun watched_run(std::string name, const TriangleMesh& mesh, SmoothingOptions options) {
    WatchedRun watched{.name = std::move(name), .lambda = options.lambda, .iterations = options.iterations};
    const Positions normals = face_normals(mesh);
    options.after_step = [&](int iteration, const Positions& X) {
        if (watched.turned_iteration > 0) return true;
        const Positions now = face_normals(moved_to(mesh, X));
        for (int t = 0; t < mesh.face_count() && watched.turned_face < 0; ++t)
            if (now.row(t).dot(normals.row(t)) < 0) watched.turned_face = t, watched.turned_iteration = iteration;
        return true;
    };
    watched.run = smooth(mesh, options);
    watched.inverted = compare_meshes(mesh, moved_to(mesh, watched.run.X)).inverted_faces;
    return watched;
}

}   // namespace

StabilityStudy stability_study(SharedMesh source, const QuestionSettings& settings) {
    StabilityStudy study;
    study.source = std::move(source);
    const TriangleMesh& mesh = study.mesh();
    study.mean_edge = mean_edge_length(mesh);
    const int steps = settings.quick ? 200 : 500;
    const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
    study.limits = {
        operator_limit("cotangent", OperatorKind::cotan, laplacian, mesh, study.mean_edge, steps),
        operator_limit("uniform", OperatorKind::uniform, uniform_operator(mesh, study.topology()), mesh, study.mean_edge, steps)};

    const int vertex = study.cotangent().certificate.top.vertex;
    const OperatorWithMass whole = operator_with_mass(laplacian);
    study.limiting = {vertex, laplacian.M[vertex] / summary_of(whole.M).median,
                      -laplacian.C.coeff(vertex, vertex) / summary_of(whole.A.diagonal()).median, study.topology().on_boundary[vertex] != 0,
                      pi};
    double& smallest = study.limiting.smallest_angle;
    const CornerValues angles = corner_angles(mesh);
    for (int t = 0; t < mesh.face_count(); ++t)
        if ((mesh.F.row(t).array() == vertex).any()) smallest = std::min(smallest, angles.row(t).minCoeff());
    return study;
}

std::shared_ptr<const RebuiltFlow> rebuilt_flow(const Studies& studies, const QuestionSettings& settings, const Progress& progress) {
    const StabilityStudy& study = studies.back();
    progress("rebuilt flow of " + study.name());
    const double critical = study.cotangent().critical();
    RebuiltFlow flow;
    flow.source = study.source;
    SmoothingOptions options{.lambda = 0.5 * critical, .iterations = settings.quick ? 20 : 30, .rebuild = true, .monitor = true};
    flow.fixed = watched_run("rebuilt, fixed λ", study.mesh(), options);
    options.adaptive = flow.share;
    flow.adaptive = watched_run("rebuilt, adaptive λ", study.mesh(), options);
    flow.frozen = watched_run("frozen, fixed λ", study.mesh(), {.lambda = flow.beyond * critical, .iterations = 100, .monitor = true});
    return std::make_shared<RebuiltFlow>(std::move(flow));
}

std::shared_ptr<const Studies> limit_studies(const LibraryMeshes& meshes, const QuestionSettings& settings, const Progress& progress,
                                             report::Section& section) {
    return std::make_shared<Studies>(studies_of(meshes, "limit of explicit smoothing", settings, progress, section, stability_study));
}

}   // namespace meshfolio::stability
