#include "geometry/curvature/curvature.h"
#include "geometry/operators/uniform_laplacian.h"
#include "geometry/spectrum/spectral_reconstruction.h"
#include "questions/reproductions/study.h"

namespace meshfolio::reproductions {

namespace {

/// ½‖Lx‖ at every vertex, without a sign; NaN where there is no mass.
Vector half_norms(const LaplaceBeltrami& laplacian, const Positions& X) {
    const Positions centred = X.rowwise() - X.colwise().mean();   // rows of C sum to 0; near 0 less is lost
    const Positions CX = laplacian.C * centred;
    const Vector M = summed_at_first(laplacian.copies, laplacian.M);
    Vector values(X.rows());
    for (Eigen::Index v = 0; v < X.rows(); ++v) values[v] = M[v] > 0 ? 0.5 * CX.row(v).norm() / M[v] : std::nan("");
    spread(laplacian.copies, values);
    return values;
}

/// (2π − Σθ)/A at every vertex, as if there were no boundary.
Vector deficit_over_area(const TriangleMesh& mesh, const Vector& areas) {
    const CornerValues angles = corner_angles(mesh);
    Vector values = Vector::Constant(mesh.X.rows(), 2 * pi);
    for (Eigen::Index t = 0; t < mesh.F.rows(); ++t)
        for (int k = 0; k < 3; ++k) values[mesh.F(t, k)] -= angles(t, k);
    for (Eigen::Index v = 0; v < values.size(); ++v) values[v] = areas[v] > 0 ? values[v] / areas[v] : std::nan("");
    return values;
}

/// Estimates the field at the positions X of its mesh; leaves its summary empty.
void estimate(ExperimentField& e, const Positions& X) {
    const double h = e.mesh->mean_edge;
    const MeshTopology& topology = e.mesh->used->topology();
    const TriangleMesh surface = moved_to(e.mesh->mesh(), X);
    if (e.colour == ExperimentColour::gauss) {
        const Vector areas = vertex_areas(surface, e.area);
        e.inside = h * h * gaussian_curvature(surface, topology, areas);
        e.drawn = h * h * deficit_over_area(surface, areas);
    } else if (e.colour == ExperimentColour::h_uniform) {
        e.inside = uniform_mean_curvature(surface, topology) / h;
        e.drawn = half_norms(uniform_operator(surface, topology), surface.X) / h;
    } else {
        const LaplaceBeltrami laplacian = laplace_operator(surface, e.kind, e.area);
        e.inside = h * operator_mean_curvature(surface, topology, e.kind, laplacian);
        e.drawn = h * half_norms(laplacian, surface.X);
    }
    for (Eigen::Index v = 0; v < e.inside.size(); ++v)
        if (std::isfinite(e.inside[v])) e.drawn[v] = e.inside[v];   // with its sign
        else if (std::isfinite(e.drawn[v])) e.largest_boundary = std::fmax(e.largest_boundary, std::abs(e.drawn[v]));
}

}   // namespace

Vector colours_of(const ExperimentMesh& mesh, ExperimentColour colour, const Positions& X) {
    if (colour == ExperimentColour::none) return {};
    if (colour == ExperimentColour::distance) return (X - mesh.mesh().X).rowwise().norm() * mesh.percent();
    ExperimentField field{{&mesh}, colour};
    estimate(field, X);
    return field.drawn;
}

Done<ExperimentField> curvature_experiment(const MeshLibrary& library, const Experiment& experiment, const QuestionSettings& settings) {
    Done<ExperimentField> done;
    done.meshes = experiment_meshes(library, experiment, settings);
    for (const ExperimentMesh& mesh : done.meshes)
        for (const ExperimentColour colour : experiment.colours)
            for (const OperatorKind kind : experiment.operators)
                for (const AreaForm area : experiment.areas) {
                    const bool first_kind = kind == experiment.operators.front(), first_area = area == experiment.areas.front();
                    if (colour != ExperimentColour::h_cotan && !first_kind) continue;   // neither depends on the operator
                    if (colour == ExperimentColour::h_uniform && !first_area) continue;
                    ExperimentField& field = done.results.emplace_back(ExperimentField{{&mesh, kind, area}, colour});
                    estimate(field, mesh.mesh().X);
                    field.summary = summary_of(field.inside);
                    const ValueSummary& s = field.summary;
                    field.positive = s.count > 0 ? double((field.inside.array() > 0).count()) / s.count : std::nan("");
                    field.largest_inside = s.count > 0 ? std::max(std::abs(s.minimum), std::abs(s.maximum)) : std::nan("");
                }
    return done;
}

Done<RebuiltMesh> reconstruction_experiment(const MeshLibrary& library, const Experiment& experiment, const QuestionSettings& settings) {
    Done<RebuiltMesh> done;
    done.meshes = experiment_meshes(library, experiment, settings);
    for (const ExperimentMesh& original : done.meshes)
        for (const OperatorKind kind : experiment.operators)
            for (const AreaForm area : experiment.areas) {
                const TriangleMesh& mesh = original.mesh();
                const LaplaceBeltrami laplacian = laplace_operator(mesh, kind, area);
                const Spectrum spectrum = smallest_eigenpairs(laplacian, experiment.k.back());
                const auto modes = static_cast<int>(spectrum.eigenvalues.size());
                for (const int k : each_once(each_of(experiment.k, [&](int asked) { return std::min(asked, modes); }))) {
                    RebuiltMesh rebuilt{{&original, kind, area}, k, reconstruct(spectrum, laplacian.M, mesh.X, k)};
                    rebuilt.difference = compare_meshes(mesh, moved_to(mesh, rebuilt.X));
                    rebuilt.mass_rms = std::sqrt(laplacian.M.dot((mesh.X - rebuilt.X).rowwise().squaredNorm()) / laplacian.M.sum());
                    rebuilt.residual = spectrum.residuals.head(k).maxCoeff();
                    done.results.push_back(std::move(rebuilt));
                }
            }
    return done;
}

}   // namespace meshfolio::reproductions
