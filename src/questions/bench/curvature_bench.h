/// @file
/// The bench of curvature: every estimator on known surfaces, in every kind of mesh, finer and finer. Questions 1 and 3, the ground truth
/// and the claims are views of it.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "questions/bench/bench_mesh.h"
#include "questions/core/section_tools.h"

namespace meshfolio {

/// Errors relative to the root mean square (L2) and the largest magnitude (L∞) of the truth; where that is 0 everywhere, of √(2H² − K) for
/// H and of 2H² − K for K.
struct EstimateError {
    double l2 = 0, linf = 0;
    int undefined = 0;   // measured vertices without an estimate
};
using Norm = double EstimateError::*;

/// p of error ≈ c·hᵖ: the least-squares slope of log error over log mean edge, over the (up to) three finest meshes. Coarser ones are left
/// out: errors do not follow a power of h there yet. On the panel the intervals of three meshes cover the order that theory predicts in
/// 90 % of the cases, those of four in 74 %.
struct Order {
    double exponent = 0;   // NaN with fewer than two positive errors, or where the finest is rounding
    double margin = 0;     // half the 95 % confidence interval of the slope; NaN with fewer than three
    bool exact = false;    // the finest error is rounding

    /// Below order ½ halving the edges four times halves the error less than twice.
    bool converges() const { return exact || exponent >= 0.5; }
};
/// "1.98 ± 0.01", "exact", or "–" where too few errors are known for one.
std::string words_of(const Order& order);

/// The error of one estimator over a refinement.
struct ErrorHistory {
    std::vector<double> mean_edges, errors;   // coarse to fine

    /// The first error of the meshes that give the order.
    double first() const { return errors[errors.size() > 3 ? errors.size() - 3 : 0]; }
    double last() const { return errors.back(); }
    Order order() const;
};
/// "falls from 3.1 % to 0.05 % (order 1.98 ± 0.01)", "goes from 14.6 % to …", "grows from … to …".
std::string trend(const ErrorHistory& history);
/// An empty log–log plot of relative L2 errors over the mean edge, and a series for it.
report::Plot error_plot(std::string id, std::string caption, std::string alt);
report::Series error_series(std::string name, const ErrorHistory& history, report::Series::Style style);

/// How far cotangent H is from that of the jet, beside how far it is from the truth, over the vertices where both exist.
struct ErrorIndicator {
    int vertices = 0;
    double indicated = 0;   // √(Σ A (H_cotan − H_jet)² / Σ A H²)
    double actual = 0;      // the same with the closed form in place of the jet
    double found = 0;       // of the tenth of the vertices with the largest errors, the share that is in the tenth indicated
};

/// What was measured on one mesh.
struct BenchLevel {
    int vertices = 0, faces = 0, euler = 0;
    double mean_edge = 0;           // [length]
    double smallest_angle = 0;      // [rad]
    double negative_weights = 0;    // share of the edges
    double euler_from_angles = 0;   // Σ deficit / 2π
    ErrorIndicator indicator = {};
    std::map<std::string_view, EstimateError> errors = {};   // by the keys of estimators()

    const EstimateError& error(std::string_view key) const { return errors.at(key); }
};
BenchLevel measured(const BenchMesh& mesh);
/// Measures on random points of the ellipsoid with half axes 1.5, 1 and 0.7, as others have done.
BenchLevel reference_level(int points, std::uint64_t seed);

/// One surface in one kind of mesh, coarse to fine.
struct BenchRun {
    std::string surface, dimensions;
    MeshKind kind = MeshKind::regular;
    std::vector<BenchLevel> levels;

    std::string title() const { return surface + ", " + std::string(name_of(kind)); }
    const BenchLevel& finest() const { return levels.back(); }
    ErrorHistory errors(std::string_view key, Norm norm = &EstimateError::l2) const;
};
using BenchRuns = std::vector<BenchRun>;

/// Every surface in every kind, one kind after the other. What was measured before, by any section, is not measured again.
BenchRuns bench_runs(const std::vector<KnownSurface>& surfaces, std::span<const MeshKind> kinds, const std::vector<int>& levels,
                     std::uint64_t seed, const Progress& progress);

std::vector<std::reference_wrapper<const BenchRun>> of_kind(const BenchRuns& runs, MeshKind kind);
/// @throws std::logic_error if there is none
const BenchRun& run_on(const BenchRuns& runs, std::string_view surface, MeshKind kind);

/// Relative error of barycentric H at a flat regular pentagon: the L∞ error on the icosphere stalls there, at twelve vertices.
double pentagon_excess();
/// Checks that the error on the finest icosphere is that of the pentagons.
report::Check pentagon_check(const BenchRuns& runs);

/// Runs for questions 1 and 3: sphere, ellipsoid and torus, regular and jittered, up to 10 000 vertices.
inline constexpr std::array question_kinds{MeshKind::regular, MeshKind::jittered};
std::vector<KnownSurface> question_surfaces();
/// L2 errors of two estimators, given with the messages that name their curves: a panel a surface, jittered meshes dashed.
report::Plot convergence_plot(std::string id, const report::Words& words, const BenchRuns& runs,
                              std::initializer_list<std::pair<std::string_view, std::string_view>> estimators);
std::vector<int> refinement_levels(bool quick);   // coarse to fine: four, or three for a quick look
BenchRuns question_runs(const QuestionSettings& settings, const Progress& progress);

/// Runs for the ground-truth panel: all surfaces, four refinements up to 17 000 vertices, quick: three.
inline constexpr std::array panel_kinds{MeshKind::regular, MeshKind::random, MeshKind::noisy, MeshKind::anisotropic};
BenchRuns panel_runs(std::uint64_t seed, bool quick, const Progress& progress);

}   // namespace meshfolio
