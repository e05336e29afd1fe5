#include "questions/operators/study.h"

#include "geometry/operators/intrinsic_delaunay.h"
#include "questions/bench/cotangent_study.h"
#include "questions/bench/estimators.h"

namespace meshfolio::operators {

namespace {

constexpr int compared_eigenvalues = 10;
constexpr int known_eigenvalues = 8;   // l = 1 three times, l = 2 five times

/// Scales a dimensionless spectrum to fit `reference` by least squares.
Vector brought_to_scale(Vector eigenvalues, const Vector& reference) {
    const Eigen::Index common = std::min(eigenvalues.size(), reference.size());
    if (common == 0) return eigenvalues;
    const double factor = eigenvalues.head(common).dot(reference.head(common)) / eigenvalues.head(common).squaredNorm();
    return factor * eigenvalues;
}

/// Returns the largest relative change of the eigenvalues; a dimensionless spectrum is scaled to fit.
double spectrum_change(const LaboratoryOperator& laboratory_operator, const Vector& eigenvalues, const Vector& reference) {
    return largest_relative_change(is_dimensionless(laboratory_operator.kind) ? brought_to_scale(eigenvalues, reference) : eigenvalues,
                                   reference);
}

/// Returns √(Σ (f − g)²/Σ g²) over the vertices where both are finite; NaN if the rms of g is rounding beside `scale`.
double relative_difference(const Vector& f, const Vector& g, double scale) {
    const std::vector<int> both = where_finite(f, g);
    const double rms = std::sqrt(g(both).squaredNorm() / static_cast<double>(both.size()));
    return rms > 1e-9 * scale ? relative_error(f, g, Vector::Ones(f.size())) : std::nan("");
}

/// Meshes with more vertices get no spectra, which would take too long.
constexpr int largest_spectrum = 20000, largest_spectrum_quick = 3000;

}   // namespace

std::string LaboratoryOperator::title() const {
    const std::string name(operator_entry(kind).title);
    return area == AreaForm::barycentric ? name : name + ", " + area_name(area) + " areas";
}

std::string LaboratoryOperator::id() const {
    std::string id(operator_entry(kind).name);
    std::replace(id.begin(), id.end(), '-', '_');
    return area == AreaForm::barycentric ? id : id + "_" + std::string(name_of(area));
}

const std::vector<LaboratoryOperator>& laboratory_operators() {
    static const std::vector<LaboratoryOperator> all = [] {
        std::vector<LaboratoryOperator> operators;
        for (const OperatorEntry& entry : operator_list()) operators.push_back({entry.kind});
        operators.push_back({OperatorKind::cotan, AreaForm::voronoi});
        operators.push_back({OperatorKind::cotan, AreaForm::mixed});
        return operators;
    }();
    return all;
}

const OperatorTrial& LaboratoryMesh::trial(OperatorKind kind) const {
    return *std::ranges::find(trials, kind, [](const OperatorTrial& t) { return t.made_by.kind; });
}

LaboratoryMesh laboratory_mesh(SharedMesh source, const QuestionSettings& settings) {
    LaboratoryMesh lab;
    lab.subject = curvature_subject(std::move(source));
    const TriangleMesh& mesh = lab.subject.mesh();
    const MeshTopology& topology = lab.subject.topology();
    lab.flips = intrinsic_delaunay(intrinsic_triangles(mesh)).flips;
    lab.oriented_manifold = topology.oriented_manifold;
    const bool with_spectra = mesh.vertex_count() <= (settings.quick ? largest_spectrum_quick : largest_spectrum);
    Vector reference;
    for (const LaboratoryOperator& laboratory_operator : laboratory_operators()) {
        const LaplaceBeltrami laplacian = laboratory_operator.of(mesh);
        OperatorTrial trial{laboratory_operator};
        trial.scores = operator_scores(laplacian, topology, assembly_of(laboratory_operator.kind));
        trial.H = operator_mean_curvature(mesh, topology, laboratory_operator.kind, laplacian);
        Vector eigenvalues;
        if (with_spectra) eigenvalues = smallest_nonzero_eigenvalues(laplacian, topology, compared_eigenvalues);
        const bool first = lab.trials.empty();
        if (first) reference = eigenvalues;
        const OperatorTrial& standard = first ? trial : lab.trials.front();
        trial.critical_ratio = is_dimensionless(laboratory_operator.kind) ? std::nan("") : trial.scores.critical / standard.scores.critical;
        trial.spectrum_shift = spectrum_change(laboratory_operator, eigenvalues, reference);
        trial.H_change = relative_difference(trial.H, standard.H, 1 / lab.subject.diagonal);
        lab.trials.push_back(std::move(trial));
    }
    return lab;
}

std::vector<KnownTrial> known_trials(const QuestionSettings& settings) {
    const PlaneTest flat = irregular_plane(settings.seed);
    const TriangleMesh& plane = flat.mesh;
    const MeshTopology plane_topology = topology_of(plane);
    const double edge = mean_edge_length(plane);
    const int level = settings.quick ? 3 : 4;
    const auto jittered_on = [&](const char* surface) {
        return bench_mesh(known_surface(surface), MeshKind::jittered, level, settings.seed);
    };
    const std::array surfaces{jittered_on("sphere"), jittered_on("ellipsoid")};
    Vector truth(known_eigenvalues);
    truth << Vector::Constant(3, 2), Vector::Constant(5, 6);

    std::vector<KnownTrial> trials;
    for (const LaboratoryOperator& laboratory_operator : laboratory_operators()) {
        KnownTrial trial{laboratory_operator};
        // A dimensionless operator becomes a curvature by the edges of every ring, as in question 3.
        trial.plane = is_dimensionless(laboratory_operator.kind)
                          ? flat.uniform
                          : edge * linear_precision(laboratory_operator.of(plane), plane, plane_topology);
        for (std::size_t s = 0; s < surfaces.size(); ++s) {
            const BenchMesh& surface = surfaces[s];
            const LaplaceBeltrami laplacian = laboratory_operator.of(surface.mesh);
            trial.H_error[s] = relative_error(operator_mean_curvature(surface.mesh, surface.topology, laboratory_operator.kind, laplacian),
                                              surface.H, surface.areas);
            if (s > 0) continue;
            const Vector eigenvalues = smallest_nonzero_eigenvalues(laplacian, surface.topology, known_eigenvalues);
            trial.eigenvalue_error = spectrum_change(laboratory_operator, eigenvalues, truth);
        }
        trials.push_back(trial);
    }
    return trials;
}

}   // namespace meshfolio::operators
