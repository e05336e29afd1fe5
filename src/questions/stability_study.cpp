#include "questions/stability_study.h"

#include <algorithm>
#include <cmath>

#include "geometry/mesh_error.h"
#include "geometry/uniform_laplacian.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {

namespace {

OperatorLimit operator_limit(std::string name, const LaplaceBeltrami& laplacian, const TriangleMesh& mesh, double mean_edge, int steps) {
    OperatorLimit limit;
    limit.name = std::move(name);
    limit.certificate = stability_certificate(laplacian);
    const LargestEigenvalue& top = limit.certificate.top;
    const Positions start = seeded(mesh.X, top, 1e-3 * mean_edge);
    limit.below = mode_growth(laplacian, top, start, 0.99 * limit.critical(), steps);
    limit.beyond = mode_growth(laplacian, top, start, 1.01 * limit.critical(), steps);
    return limit;
}

LimitingVertex limiting_vertex(const LaplaceBeltrami& laplacian, const TriangleMesh& mesh, int vertex) {
    const OperatorWithMass whole = operator_with_mass(laplacian);
    Vector stiffness = whole.A.diagonal();
    const Eigen::Index middle = stiffness.size() / 2;
    std::nth_element(stiffness.begin(), stiffness.begin() + middle, stiffness.end());
    LimitingVertex limiting{vertex, laplacian.M[vertex] / whole.M.mean(), -laplacian.C.coeff(vertex, vertex) / stiffness[middle], M_PI};
    const CornerValues angles = corner_angles(mesh);
    for (int t = 0; t < mesh.face_count(); ++t) {
        if ((mesh.F.row(t).array() == vertex).any()) limiting.smallest_angle = std::min(limiting.smallest_angle, angles.row(t).minCoeff());
    }
    return limiting;
}

}   // namespace

StabilityStudy stability_study(std::shared_ptr<const LibraryMesh> source, const QuestionSettings& settings) {
    StabilityStudy study;
    study.source = std::move(source);
    study.mean_edge = mean_edge_length(study.mesh());
    study.diagonal = bounding_box(study.mesh()).diagonal();
    const int steps = settings.quick ? 300 : 1000;
    const LaplaceBeltrami laplacian = laplace_beltrami(study.mesh());
    study.cotangent = operator_limit("cotangent", laplacian, study.mesh(), study.mean_edge, steps);
    study.uniform = operator_limit("uniform", uniform_operator(study.source->prepared->topology), study.mesh(), study.mean_edge, steps);
    study.limiting = limiting_vertex(laplacian, study.mesh(), study.cotangent.certificate.top.vertex);
    return study;
}

RebuiltFlow rebuilt_flow(const StabilityStudy& study, const QuestionSettings& settings) {
    RebuiltFlow flow;
    flow.source = study.source;
    flow.lambda = 0.5 * study.cotangent.critical();
    flow.share = 0.95;
    flow.iterations = settings.quick ? 20 : 50;
    SmoothingOptions options;
    options.lambda = flow.lambda;
    options.iterations = flow.iterations;
    options.rebuild = true;
    options.monitor = true;
    flow.fixed = smooth(study.mesh(), options);
    options.adaptive = flow.share;
    flow.adaptive = smooth(study.mesh(), options);
    flow.fixed_inverted = compare_meshes(study.mesh(), moved_to(study.mesh(), flow.fixed.X)).inverted_faces;
    flow.adaptive_inverted = compare_meshes(study.mesh(), moved_to(study.mesh(), flow.adaptive.X)).inverted_faces;
    return flow;
}

double largest_product(const Smoothed& run) {
    double largest = 0;
    for (const StepStability& step : run.steps) {
        if (step.top > largest) largest = step.top;
    }
    return largest;
}

}   // namespace meshfolio
