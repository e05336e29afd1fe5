#include "geometry/spectrum/spectrum_certificate.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

#include "base/at.h"
#include "base/errors.h"
#include "geometry/linear/special_values.h"
#include "geometry/operators/triangle_shape.h"
#include "geometry/operators/vertices_with_mass.h"
#include "mesh/disjoint_sets.h"

namespace meshfolio {
namespace {

/// Returns the number of components of the triangles, or of those with an area, with mass at some vertex.
int components_with_mass(const TriangleMesh& mesh, const Vector& M, bool with_area) {
    DisjointSets sets(mesh.vertex_count());
    const double scale = unit_scale(mesh);
    for (Eigen::Index t = 0; t < mesh.F.rows(); ++t) {
        if (with_area && triangle_shape(mesh, t, scale).degenerate()) continue;
        sets.join(mesh.F(t, 0), mesh.F(t, 1));
        sets.join(mesh.F(t, 1), mesh.F(t, 2));
    }
    std::set<int> roots;
    for (int v = 0; v < mesh.vertex_count(); ++v)
        if (M[v] > 0) roots.insert(sets.find(v));
    return static_cast<int>(roots.size());
}

double median(Vector values) {
    double* const middle = values.data() + values.size() / 2;
    std::nth_element(values.data(), middle, values.data() + values.size());
    return *middle;
}

/// Returns a power of 4 near a positive number: its root is exact, too.
double power_of_four_near(double value) { return value > 0 ? std::ldexp(1.0, 2 * (std::ilogb(value) / 2)) : 1; }

/// Returns median A_ii / ΣM of the component of each row.
Vector units_of_components(const SparseMatrix& A, const Vector& M) {
    const Components components = components_of(A);
    std::vector<std::vector<double>> diagonal(at(components.count));
    Vector mass = Vector::Zero(components.count);
    const Vector A_ii = A.diagonal();
    for (Eigen::Index i = 0; i < M.size(); ++i) {
        const int c = components.label[std::size_t(i)];
        diagonal[at(c)].push_back(A_ii[i]);
        mass[c] += M[i];
    }
    Vector unit(components.count), units(M.size());
    for (int c = 0; c < components.count; ++c) {
        const std::vector<double>& entries = diagonal[at(c)];
        unit[c] = std::max(0.0, median(Eigen::Map<const Vector>(entries.data(), std::ssize(entries))) / mass[c]);
    }
    for (Eigen::Index i = 0; i < M.size(); ++i) units[i] = unit[components.label[std::size_t(i)]];
    return units;
}

/// Eigenvalues below this times their unit count as 0.
constexpr double zero_below = 1e-9;

/// The operator times powers of two, which is exact, that bring ΣM and its median row near 1; with the spectrum on its vertices.
struct UnitProblem {
    SparseMatrix A;
    Vector M, mu;
    DenseMatrix Phi;
    DenseMatrix gram;   // ΦᵀMΦ, I where they are orthonormal
    double unit = 0;    // of eigenvalues, a power of two [1/length²]
    double mu0 = 0;     // median A_ii / ΣM
    Vector row_mu0;     // of the component of each row
    InertiaAt inertia_at;

    UnitProblem(const LaplaceBeltrami& laplacian, const Spectrum& spectrum, InertiaAt count) : inertia_at(std::move(count)) {
        const OperatorWithMass whole = operator_with_mass(laplacian);
        const double total = power_of_four_near(whole.M.sum()), row = power_of_four_near(median(whole.A.diagonal()));
        unit = row / total;
        A = whole.A / row;
        M = whole.M / total;
        mu = spectrum.eigenvalues / unit;
        Phi = std::sqrt(total) * spectrum.eigenvectors(whole.vertex, Eigen::all);
        gram = Phi.transpose() * (M.asDiagonal() * Phi);
        const double middle = median(A.diagonal());
        mu0 = (middle > 0 ? middle : 1) / M.sum();
        row_mu0 = units_of_components(A, M);
    }

    /// Returns μ₀ of the components on which pair j lives, weighted by its share on each.
    double own_unit(Eigen::Index j) const {
        const Vector weight = M.cwiseProduct(Phi.col(j).cwiseAbs2());
        const double own = weight.dot(row_mu0) / weight.sum();   // NaN where Φ is not finite
        return std::isfinite(own) ? own : mu0;
    }
    double largest_row() const { return A.diagonal().cwiseQuotient(M).maxCoeff(); }   // max A_ii / M_ii
    /// Returns the magnitude up to which eigenvalues may be rounding of the largest row.
    double rounding() const { return 1e3 * epsilon * largest_row(); }
};

/// ‖Aφ − μMφ‖_{M⁻¹} for each pair.
struct Residuals {
    Vector computed, bound;   // the result; a bound that includes the rounding of its computation

    explicit Residuals(const UnitProblem& problem) : computed(problem.mu.size()), bound(problem.mu.size()) {
        constexpr double u = epsilon / 2;
        const SparseMatrix sizes = problem.A.cwiseAbs();
        Vector roundings(problem.M.size());   // of row i: a product and a sum for each entry, and some more
        for (int i = 0; i < sizes.cols(); ++i) roundings[i] = sizes.outerIndexPtr()[i + 1] - sizes.outerIndexPtr()[i] + 6;
        const Vector root = problem.M.cwiseSqrt();
        tbb::parallel_for(Eigen::Index{0}, problem.mu.size(), [&](Eigen::Index j) {
            const Vector phi = problem.Phi.col(j), MPhi = problem.M.cwiseProduct(phi);
            Vector r = problem.A.selfadjointView<Eigen::Lower>() * phi;
            r -= problem.mu[j] * MPhi;
            Vector size = sizes.selfadjointView<Eigen::Lower>() * phi.cwiseAbs();
            size += std::abs(problem.mu[j]) * MPhi.cwiseAbs();
            computed[j] = r.cwiseQuotient(root).norm();
            bound[j] = (r.cwiseAbs() + u * roundings.cwiseProduct(size)).cwiseQuotient(root).norm();
        });
    }
};

void measure_residuals(const UnitProblem& problem, const Residuals& residuals, SpectrumCertificate& certificate) {
    const double largest_row = problem.largest_row();
    double worst = -1;
    for (Eigen::Index j = 0; j < problem.mu.size(); ++j) {
        const double unit = problem.own_unit(j), size = problem.mu[j] > zero_below * unit ? problem.mu[j] : std::max(problem.mu0, unit);
        const double ratio = residuals.computed[j] / (size * std::sqrt(problem.M.dot(problem.Phi.col(j).cwiseAbs2())));
        const double residual = std::isfinite(ratio) ? ratio : infinity;
        const double rounding = 100 * epsilon * largest_row / size;
        const double limit = std::clamp(rounding, 1e-8, 1e-6);
        if (residual / limit <= worst) continue;
        worst = residual / limit;
        certificate.residual = residual;
        certificate.residual_limit = limit;
        certificate.residual_rounding = rounding;
    }
}

double parseval_gap(const LaplaceBeltrami& laplacian, const Spectrum& spectrum, const Positions& X) {
    const Vector& M = laplacian.M;
    const Eigen::RowVector3d near = X.row(0);
    const DenseMatrix offset = X.rowwise() - near;
    const Eigen::RowVector3d mean = M.transpose() * offset / M.sum();
    DenseMatrix x = offset.rowwise() - mean;
    x /= x.cwiseAbs().maxCoeff();   // squares of the largest and smallest models would overflow
    const DenseMatrix coefficients = spectrum.eigenvectors.transpose() * (M.asDiagonal() * x);
    const DenseMatrix tail = x - spectrum.eigenvectors * coefficients;
    const double whole = M.dot(x.rowwise().squaredNorm());
    const double gap = std::abs(whole - coefficients.squaredNorm() - M.dot(tail.rowwise().squaredNorm())) / whole;
    return std::isfinite(gap) ? gap : infinity;
}

/// Eigenvalues nearer than this, relatively, are one cluster: rounding may mix their vectors.
constexpr double cluster_gap = 1e-5;

/// The pairs in the form of the proof, θ ascending.
class FoundValues {
public:
    FoundValues(const UnitProblem& problem, const Residuals& residuals)
        : theta_(problem.mu), rho_squared_(residuals.bound.size()), least_size_(0.1 * problem.mu0) {
        std::vector<Eigen::Index> order(static_cast<std::size_t>(theta_.size()));
        std::iota(order.begin(), order.end(), Eigen::Index{0});
        std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) { return problem.mu[a] < problem.mu[b]; });
        theta_ = problem.mu(order);
        rho_squared_ = residuals.bound(order).cwiseAbs2();
        const auto k = static_cast<double>(theta_.size()), n = static_cast<double>(problem.M.size());
        const DenseMatrix F = problem.gram - DenseMatrix::Identity(theta_.size(), theta_.size());
        const double rounding = epsilon / 2 * (n + 4) * problem.gram.cwiseAbs().maxCoeff();
        eta_ = F.norm() + k * rounding;
    }

    const Vector& theta() const { return theta_; }
    Eigen::Index count() const { return theta_.size(); }
    double last() const { return theta_[count() - 1]; }
    int below(double sigma) const { return static_cast<int>((theta_.array() < sigma).count()); }
    double residual(int j) const { return std::sqrt(rho_squared_[j]); }
    /// Returns the unit of distances between eigenvalues near μ.
    double size(double mu) const { return std::max(mu, least_size_); }

    /// Returns u: at least f eigenvalues are ≤ u.
    double upper_bound(int f) const {
        if (f == 0) return -infinity;
        if (!(eta_ < 0.5)) return infinity;
        const double rho = std::sqrt(rho_squared_.head(f).sum());
        const double largest = theta_[f - 1] + eta_ * theta_.head(f).cwiseAbs().maxCoeff() + (1 + eta_) * rho;
        const double u = largest / (largest > 0 ? 1 - eta_ : 1 + eta_);
        return u + 16 * epsilon * std::abs(u);
    }
    /// Returns the smaller of the distances of σ from u and from the next value found.
    double gap_at(double sigma) const {
        const int f = below(sigma);
        return std::min(sigma - upper_bound(f), f < count() ? theta_[f] - sigma : infinity);
    }
    /// Returns a lower bound of the distance from σ of the eigenvalues that the values found approximate within their residuals.
    double distance_from(double sigma) const {
        return ((theta_.array() - sigma).abs() - rho_squared_.array().sqrt() / std::sqrt(1 - std::min(eta_, 0.5))).minCoeff();
    }
    /// Returns the index of the first value of the last cluster.
    int first_of_last_cluster() const {
        Eigen::Index i = count() - 1;
        while (i > 0 && theta_[i] - theta_[i - 1] <= cluster_gap * theta_[i]) --i;
        return static_cast<int>(i);
    }

private:
    Vector theta_, rho_squared_;
    double eta_ = 0, least_size_;
};

std::optional<Inertia> inertia_beside(const UnitProblem& problem, double sigma, double gap) {
    return inertia_between(problem.A, problem.M, sigma - gap, sigma + gap, problem.inertia_at);
}

/// Counts eigenvalues below a σ above the last value found: where the solver knows a gap, else ever nearer until no more are counted than
/// were found.
std::optional<Inertia> count_above_last(const UnitProblem& problem, const FoundValues& found, double hint) {
    const double last = found.last();
    if (hint > last) return inertia_beside(problem, hint, 0.9 * (hint - last));
    std::optional<Inertia> inertia;
    const double spacing = found.size(last) / static_cast<double>(found.count());   // by Weyl's law
    for (const double share : {0.3, 0.01, 3e-4}) {
        inertia = inertia_beside(problem, last + 0.5 * share * spacing, 0.45 * share * spacing);
        if (!inertia || inertia->below <= found.count()) break;
    }
    return inertia;
}

/// Counts eigenvalues below a σ just below the last cluster found, as near as rounding permits: eigenvalues between would be missed.
std::optional<Inertia> count_below_last_cluster(const UnitProblem& problem, const FoundValues& found, double delta) {
    const int f = found.first_of_last_cluster();
    const double first = found.theta()[f], size = found.size(first), u = found.upper_bound(f);
    const double width = std::min(std::clamp(100 * (delta + found.residual(f)), 2e-6 * size, 1e-3 * size), first - u);
    if (!(width > 0)) return {};
    return inertia_between(problem.A, problem.M, first - width, first, problem.inertia_at);
}

void count_inertia(const UnitProblem& problem, const Residuals& residuals, double hint, SpectrumCertificate& certificate) {
    certificate.pairs = static_cast<int>(problem.mu.size());
    if (!problem.mu.allFinite()) return;
    const FoundValues found(problem, residuals);
    auto inertia = count_above_last(problem, found, hint / problem.unit);
    if (inertia && inertia->below > found.count()) {
        if (const auto before = count_below_last_cluster(problem, found, inertia->delta)) inertia = before;
    }
    if (!inertia) return;
    const double gap = std::max(0.0, found.gap_at(inertia->sigma));   // 0 where it is not a number
    certificate.shift = inertia->sigma * problem.unit;
    certificate.delta = inertia->delta * problem.unit;
    certificate.delta_is_measured = inertia->measured;
    certificate.gap = gap * problem.unit;
    certificate.counted_below = inertia->below;
    certificate.found_below = found.below(inertia->sigma);
    const bool beyond_all = certificate.found_below == certificate.pairs;
    const Proof agree = agreement(*inertia, found.theta());
    if (agree == Proof::proved && inertia->delta < gap) certificate.complete = Proof::proved;
    // More above the last value found are no contradiction: they may be larger.
    const bool clear = inertia->delta < found.distance_from(inertia->sigma), more_beyond = beyond_all && inertia->below > certificate.pairs;
    if (agree == Proof::refuted && clear && !more_beyond) certificate.complete = Proof::refuted;
}

/// True if rounding explains that other than the expected number of eigenvalues were found to be at most their limit: a mode with a
/// Rayleigh quotient within rounding may have eigenvalue 0, whatever was found for it.
bool zeros_hidden(const UnitProblem& problem, const Vector& limit, int found, int expected) {
    if (found == expected) return false;
    const double rounding = problem.rounding();
    int perhaps_zero = 0;
    bool all_found_may_be = true;
    for (Eigen::Index j = 0; j < problem.mu.size(); ++j) {
        const Vector phi = problem.Phi.col(j);
        const Vector force = problem.A.selfadjointView<Eigen::Lower>() * phi;
        const bool perhaps = std::abs(phi.dot(force)) <= rounding * problem.M.dot(phi.cwiseAbs2());
        perhaps_zero += perhaps ? 1 : 0;
        if (std::abs(problem.mu[j]) <= limit[j] && !perhaps) all_found_may_be = false;
    }
    return found < expected ? perhaps_zero >= expected : all_found_may_be;
}

void count_zeros(const UnitProblem& problem, const TriangleMesh& mesh, const Vector& M, SpectrumCertificate& certificate) {
    Vector limit(problem.mu.size());
    for (Eigen::Index j = 0; j < limit.size(); ++j) limit[j] = zero_below * problem.own_unit(j);
    const auto zeros = [&] { return static_cast<int>((problem.mu.array().abs() <= limit.array()).count()); };
    certificate.zero_eigenvalues = zeros();
    // Triangles without area join nothing under cotangents, but they do under weights that ignore lengths, and flips may give them area.
    certificate.components =
        std::clamp(certificate.zero_eigenvalues, components_with_mass(mesh, M, false), components_with_mass(mesh, M, true));
    certificate.expected_zeros = std::min(certificate.components, static_cast<int>(problem.mu.size()));
    if (certificate.zero_eigenvalues > certificate.expected_zeros) {   // some as small on a mesh a million times as long as wide are none
        limit = limit.cwiseMin(problem.rounding());
        certificate.zero_eigenvalues = std::max(certificate.expected_zeros, zeros());
    }
    certificate.zeros_undecided = zeros_hidden(problem, limit, certificate.zero_eigenvalues, certificate.expected_zeros);
}

}   // namespace

SpectrumCertificate certify_spectrum(const TriangleMesh& mesh, const LaplaceBeltrami& laplacian, const Spectrum& spectrum,
                                     const InertiaAt& inertia_at) {
    const Eigen::Index n = mesh.X.rows(), k = spectrum.eigenvalues.size();
    const DenseMatrix& Phi = spectrum.eigenvectors;
    if (laplacian.M.size() != n || Phi.rows() != n || Phi.cols() != k || k == 0)
        throw MeshError("certify_spectrum: " + std::to_string(k) + " eigenvalues and " + std::to_string(Phi.rows()) + " × " +
                            std::to_string(Phi.cols()) + " eigenvectors for a mesh of " + std::to_string(n) + " vertices",
                        "certify a spectrum of this mesh, not empty");
    const UnitProblem problem(laplacian, spectrum, inertia_at);
    const Residuals residuals(problem);
    SpectrumCertificate certificate;
    measure_residuals(problem, residuals, certificate);
    const bool finite = problem.gram.allFinite();   // a maximum may pass over a NaN
    certificate.orthonormality_error = finite ? (problem.gram - DenseMatrix::Identity(k, k)).cwiseAbs().maxCoeff() : infinity;
    certificate.parseval_gap = parseval_gap(laplacian, spectrum, mesh.X);
    count_inertia(problem, residuals, spectrum.gap_middle, certificate);
    count_zeros(problem, mesh, laplacian.M, certificate);
    const Vector& mu = problem.mu;
    double step = 0;
    for (Eigen::Index i = 1; i < k; ++i) step = std::min(step, mu[i] - mu[i - 1]);
    certificate.smallest_step_up = step < 0 ? step / mu.cwiseAbs().maxCoeff() : 0;
    return certificate;
}

Proof SpectrumCertificate::verdict() const {
    const bool within = (residual <= residual_limit || residual_undecided()) && orthonormality_error <= orthonormality_limit &&
                        parseval_gap <= parseval_limit && (zero_eigenvalues == expected_zeros || zeros_undecided) &&
                        smallest_step_up >= -step_down_limit;
    if (!within) return Proof::refuted;
    const bool open = residual_undecided() || zeros_undecided;
    return complete == Proof::proved && open ? Proof::undecided : complete;
}

Inertia eigenvalues_below(const LaplaceBeltrami& laplacian, double sigma) {
    const OperatorWithMass whole = operator_with_mass(laplacian);
    const double total = power_of_four_near(whole.M.sum());
    const Inertia inertia = inertia_at(whole.A, whole.M / total, sigma * total);
    return {sigma, inertia.below, inertia.delta / total};
}

Proof agreement(const Inertia& inertia, const Vector& values) {
    const double nearest = (values.array() - inertia.sigma).abs().minCoeff();
    if (!(inertia.delta < nearest)) return Proof::undecided;
    return inertia.below == (values.array() < inertia.sigma).count() ? Proof::proved : Proof::refuted;
}

}   // namespace meshfolio
