#include "geometry/spectrum_certificate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "errors.h"
#include "geometry/inertia.h"
#include "geometry/special_values.h"
#include "geometry/vertices_with_mass.h"
#include "mesh/disjoint_sets.h"

namespace meshfolio {

namespace {

void check_sizes(const TriangleMesh& mesh, const LaplaceBeltrami& laplacian, const Spectrum& spectrum) {
    const Eigen::Index n = mesh.X.rows(), k = spectrum.eigenvalues.size();
    if (laplacian.M.size() == n && spectrum.eigenvectors.rows() == n && spectrum.eigenvectors.cols() == k && k > 0) return;
    throw MeshError("certify_spectrum: " + std::to_string(k) + " eigenvalues and " + std::to_string(spectrum.eigenvectors.rows()) + " × " +
                    std::to_string(spectrum.eigenvectors.cols()) + " eigenvectors for a mesh of " + std::to_string(n) + " vertices");
}

/// Components of the triangles in which some vertex has a mass.
int components_with_mass(const TriangleMesh& mesh, const Vector& M) {
    DisjointSets sets;
    sets.reset(mesh.vertex_count());
    for (Eigen::Index t = 0; t < mesh.F.rows(); ++t) {
        sets.join(mesh.F(t, 0), mesh.F(t, 1));
        sets.join(mesh.F(t, 1), mesh.F(t, 2));
    }
    std::vector<char> counted(static_cast<std::size_t>(mesh.vertex_count()), 0);
    int components = 0;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        if (!(M[v] > 0)) continue;
        char& root = counted[static_cast<std::size_t>(sets.find(v))];
        components += root == 0 ? 1 : 0;
        root = 1;
    }
    return components;
}

/// The operator in units where ΣM and its median row are 1, with the spectrum of the whole mesh on its vertices.
struct UnitProblem {
    SparseMatrix A;
    Vector M, mu;
    DenseMatrix Phi;      // ΦᵀMΦ = I
    double mu_unit = 0;   // μ₀ = median A_ii / ΣM [1/length²]
    Vector row_unit;      // of the component of each row, in units of μ₀: all 1 if there is one
};

double median(Vector values) {
    double* const middle = values.data() + values.size() / 2;
    std::nth_element(values.data(), middle, values.data() + values.size());
    return *middle;
}

/// median A_ii / ΣM of the component of each row.
Vector units_of_components(const SparseMatrix& A, const Vector& M) {
    const Components components = components_of(A);
    if (components.count == 1) return Vector::Ones(M.size());
    std::vector<std::vector<double>> diagonal(static_cast<std::size_t>(components.count));
    Vector mass = Vector::Zero(components.count);
    const Vector A_ii = A.diagonal();
    for (Eigen::Index i = 0; i < M.size(); ++i) {
        const int c = components.label[static_cast<std::size_t>(i)];
        diagonal[static_cast<std::size_t>(c)].push_back(A_ii[i]);
        mass[c] += M[i];
    }
    Vector unit(components.count), units(M.size());
    for (int c = 0; c < components.count; ++c) {
        const std::vector<double>& entries = diagonal[static_cast<std::size_t>(c)];
        unit[c] = std::max(0.0, median(Eigen::Map<const Vector>(entries.data(), static_cast<Eigen::Index>(entries.size()))) / mass[c]);
    }
    for (Eigen::Index i = 0; i < M.size(); ++i) units[i] = unit[components.label[static_cast<std::size_t>(i)]];
    return units;
}

UnitProblem unit_problem(const LaplaceBeltrami& laplacian, const Spectrum& spectrum) {
    OperatorWithMass whole = operator_with_mass(laplacian);
    const double total = whole.M.sum(), row = median(whole.A.diagonal()), unit = row > 0 ? row : 1;
    UnitProblem problem{whole.A / unit,
                        whole.M / total,
                        spectrum.eigenvalues * (total / unit),
                        std::sqrt(total) * spectrum.eigenvectors(whole.vertex, Eigen::all),
                        unit / total,
                        {}};
    problem.row_unit = units_of_components(problem.A, problem.M);
    return problem;
}

void measure_residuals(const UnitProblem& problem, SpectrumCertificate& certificate) {
    const double largest_row = problem.A.diagonal().cwiseQuotient(problem.M).maxCoeff();
    double worst = -1;
    for (Eigen::Index j = 0; j < problem.mu.size(); ++j) {
        const Vector MPhi = problem.M.cwiseProduct(problem.Phi.col(j));
        const Vector weight = MPhi.cwiseProduct(problem.Phi.col(j));
        const double own_unit = weight.dot(problem.row_unit) / weight.sum();   // NaN where Φ is not finite
        const double size = std::max({problem.mu[j], 1.0, std::isfinite(own_unit) ? own_unit : 1.0});
        const double ratio = (problem.A * problem.Phi.col(j) - problem.mu[j] * MPhi).norm() / (size * MPhi.norm());
        const double residual = std::isfinite(ratio) ? ratio : infinity;
        const double limit = std::clamp(100 * std::numeric_limits<double>::epsilon() * largest_row / size, 1e-8, 1e-3);
        if (residual / limit <= worst) continue;
        worst = residual / limit;
        certificate.residual = residual;
        certificate.residual_limit = limit;
    }
}

double parseval_gap(const LaplaceBeltrami& laplacian, const Spectrum& spectrum, const Positions& X) {
    const Vector& M = laplacian.M;
    const Eigen::RowVector3d near = X.row(0);
    const DenseMatrix offset = X.rowwise() - near;
    const Eigen::RowVector3d mean = M.transpose() * offset / M.sum();
    DenseMatrix x = offset.rowwise() - mean;
    x /= x.cwiseAbs().maxCoeff();   // squares of the largest and smallest models leave the range of numbers
    const DenseMatrix coefficients = spectrum.eigenvectors.transpose() * (M.asDiagonal() * x);
    const DenseMatrix tail = x - spectrum.eigenvectors * coefficients;
    const double whole = M.dot(x.rowwise().squaredNorm());
    const double gap = std::abs(whole - coefficients.squaredNorm() - M.dot(tail.rowwise().squaredNorm())) / whole;
    return std::isfinite(gap) ? gap : infinity;
}

/// The inertia at the first shift beside `mu` whose pivots can be trusted, or −1.
int counted_beside(const UnitProblem& problem, double mu, double side, double& sigma) {
    for (const double distance : {1e-6, 2e-6, 4e-6}) {
        sigma = mu + side * distance * std::max(mu, 0.1);
        try {
            return inertia_below(problem.A, problem.M, sigma);
        } catch (const SolverError&) {   // a pivot lost in rounding: σ is moved a little
        }
    }
    return -1;
}

/// Eigenvalues nearer than this, relatively, are one cluster: rounding may turn its members about.
constexpr double clear_gap = 1e-5;

double first_of_last_cluster(const Vector& ascending) {
    Eigen::Index i = ascending.size() - 1;
    while (i > 0 && ascending[i] - ascending[i - 1] <= clear_gap * ascending[i]) --i;
    return ascending[i];
}

void count_inertia(const UnitProblem& problem, SpectrumCertificate& certificate) {
    Vector mu = problem.mu;
    if (!mu.allFinite()) return;
    std::sort(mu.begin(), mu.end());
    const auto found_below = [&](double sigma) { return static_cast<int>((mu.array() < sigma).count()); };
    double sigma = 0;
    certificate.pairs = static_cast<int>(mu.size());
    certificate.counted_above = certificate.counted_below = counted_beside(problem, mu[mu.size() - 1], 1, sigma);
    if (certificate.counted_above != mu.size()) certificate.counted_below = counted_beside(problem, first_of_last_cluster(mu), -1, sigma);
    certificate.found_below = found_below(sigma);
    certificate.shift = sigma * problem.mu_unit;
}

double smallest_step_up(const Vector& mu) {
    double step = 0;
    for (Eigen::Index i = 1; i < mu.size(); ++i) step = std::min(step, mu[i] - mu[i - 1]);
    return step < 0 ? step / mu.cwiseAbs().maxCoeff() : 0;
}

}   // namespace

SpectrumCertificate certify_spectrum(const TriangleMesh& mesh, const LaplaceBeltrami& laplacian, const Spectrum& spectrum) {
    check_sizes(mesh, laplacian, spectrum);
    const UnitProblem problem = unit_problem(laplacian, spectrum);
    SpectrumCertificate certificate;
    measure_residuals(problem, certificate);
    const bool finite = spectrum.eigenvectors.allFinite();   // a maximum may pass over a NaN
    certificate.orthonormality_error = finite ? orthonormality_error(spectrum, laplacian.M) : infinity;
    certificate.parseval_gap = parseval_gap(laplacian, spectrum, mesh.X);
    count_inertia(problem, certificate);
    certificate.zero_eigenvalues = static_cast<int>((problem.mu.array().abs() <= 1e-9).count());
    certificate.expected_zeros = std::min(components_with_mass(mesh, laplacian.M), static_cast<int>(problem.mu.size()));
    certificate.smallest_step_up = smallest_step_up(problem.mu);
    return certificate;
}

int eigenvalues_below(const LaplaceBeltrami& laplacian, double sigma) {
    const OperatorWithMass whole = operator_with_mass(laplacian);
    const double area = whole.M.sum();
    return inertia_below(whole.A, whole.M / area, sigma * area);
}

}   // namespace meshfolio
