#include "questions/reproductions/parts.h"

#include "geometry/curvature/curvature.h"
#include "geometry/operators/uniform_laplacian.h"
#include "geometry/spectrum/spectral_reconstruction.h"

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

/// The field estimated on this surface, without its summary.
ExperimentField estimate(const TriangleMesh& surface, const MeshTopology& topology, ExperimentField e, double h) {
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
        if (std::isfinite(e.inside[v]))
            e.drawn[v] = e.inside[v];   // with its sign
        else if (std::isfinite(e.drawn[v]))
            e.largest_boundary = std::fmax(e.largest_boundary, std::abs(e.drawn[v]));
    return e;
}

ExperimentField field_of(const ExperimentMesh& mesh, ExperimentField field) {
    field = estimate(mesh.mesh(), mesh.used->topology(), std::move(field), mesh.mean_edge);
    field.summary = summary_of(field.inside);
    const int count = field.summary.count;
    field.positive = count > 0 ? double((field.inside.array() > 0).count()) / count : std::nan("");
    field.largest_inside = count > 0 ? std::max(std::abs(field.summary.minimum), std::abs(field.summary.maximum)) : std::nan("");
    return field;
}

/// √(Σ M |x − y|²/ΣM).
double mass_rms_of(const Vector& M, const Positions& X, const Positions& Y) {
    return std::sqrt(M.dot((X - Y).rowwise().squaredNorm()) / M.sum());
}

}   // namespace

Vector colours_of(const ExperimentMesh& mesh, ExperimentColour colour, const Positions& X) {
    if (colour == ExperimentColour::none) return {};
    if (colour == ExperimentColour::distance) return (X - mesh.mesh().X).rowwise().norm() * (100 / mesh.diagonal);
    return estimate(moved_to(mesh.mesh(), X), mesh.used->topology(), {.colour = colour}, mesh.mean_edge).drawn;
}

CurvatureExperiment curvature_experiment(const MeshLibrary& library, const Experiment& experiment, const QuestionSettings& settings) {
    CurvatureExperiment result;
    result.meshes = experiment_meshes(library, experiment, settings);
    for (std::size_t m = 0; m < result.meshes.size(); ++m)
        for (const ExperimentColour colour : experiment.colours)
            for (const OperatorKind kind : experiment.operators)
                for (const AreaForm area : experiment.areas) {
                    const bool first_kind = kind == experiment.operators.front(), first_area = area == experiment.areas.front();
                    if (colour != ExperimentColour::h_cotan && !first_kind) continue;   // neither depends on the operator
                    if (colour == ExperimentColour::h_uniform && !first_area) continue;
                    result.fields.push_back(field_of(result.meshes[m], {.mesh = m, .colour = colour, .kind = kind, .area = area}));
                }
    return result;
}

ReconstructionExperiment reconstruction_experiment(const MeshLibrary& library, const Experiment& experiment,
                                                   const QuestionSettings& settings) {
    ReconstructionExperiment result;
    result.meshes = experiment_meshes(library, experiment, settings);
    for (std::size_t m = 0; m < result.meshes.size(); ++m) {
        const TriangleMesh& mesh = result.meshes[m].mesh();
        for (const OperatorKind kind : experiment.operators)
            for (const AreaForm area : experiment.areas) {
                const LaplaceBeltrami laplacian = laplace_operator(mesh, kind, area);
                const Spectrum spectrum = smallest_eigenpairs(laplacian, experiment.k.back());
                std::vector<int> counts;
                for (const int k : experiment.k) counts.push_back(std::min(k, static_cast<int>(spectrum.eigenvalues.size())));
                for (const int k : each_once(counts)) {
                    RebuiltMesh rebuilt{m, kind, area, k, reconstruct(spectrum, laplacian.M, mesh.X, k), {}, 0, 0};
                    rebuilt.difference = compare_meshes(mesh, moved_to(mesh, rebuilt.X));
                    rebuilt.mass_rms = mass_rms_of(laplacian.M, mesh.X, rebuilt.X);
                    rebuilt.residual = spectrum.residuals.head(k).maxCoeff();
                    result.rebuilt.push_back(std::move(rebuilt));
                }
            }
    }
    return result;
}

}   // namespace meshfolio::reproductions
