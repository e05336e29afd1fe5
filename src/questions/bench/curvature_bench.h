/// @file
/// The bench of curvature: errors of every estimator on known surfaces, in every kind of mesh, coarse to fine. Questions 1 and 3, the
/// ground truth and the claims show parts of it.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <span>
#include <vector>

#include "questions/bench/bench_mesh.h"
#include "questions/core/section_tools.h"

namespace meshfolio {

/// Errors relative to the root mean square (L2) and the largest magnitude (L∞) of the truth. If the truth is 0 everywhere, √(2H² − K)
/// takes its place for H and 2H² − K for K.
struct EstimateError {
    double l2 = 0, linf = 0;
    int undefined = 0;   // measured vertices without an estimate
};
using Norm = double EstimateError::*;

/// The order p of error ≈ c·hᵖ: the least-squares slope of log error over log mean edge, over the three finest meshes. Errors of coarser
/// meshes do not follow a power of h yet: on the panel the intervals of three meshes cover the predicted order in 90 % of the cases, those
/// of four in 74 %.
struct Order {
    double exponent = 0;   // NaN with fewer than two positive errors, or if the finest is rounding
    double margin = 0;     // half the 95 % confidence interval of the slope; NaN with fewer than three errors
    bool exact = false;    // the finest error is rounding

    /// Returns true if the error is exact or of order ½ at least: halving the edges four times then quarters it.
    bool converges() const { return exact || exponent >= 0.5; }
};
/// Returns "1.98 ± 0.01", "exact", or "–" if too few errors are known.
std::string words_of(const Order& order);

/// The error of one estimator over a refinement.
struct ErrorHistory {
    std::vector<double> mean_edges, errors;   // coarse to fine

    /// Returns the third error from the end, the coarsest that the order is fitted to; the first of fewer than three.
    double first() const { return errors[errors.size() > 3 ? errors.size() - 3 : 0]; }
    double last() const { return errors.back(); }   // of the finest mesh
    Order order() const;                            // fitted to the three finest meshes
};
/// Describes the errors: "falls from 3.1 % to 0.05 % (order 1.98 ± 0.01)", "goes from 14.6 % to …", "grows from … to …".
std::string trend(const ErrorHistory& history);
/// Makes an empty log–log plot of relative L2 errors over the mean edge.
report::Plot error_plot(std::string id, std::string caption, std::string alt);
/// Makes a series for error_plot(): the errors in percent over the mean edges.
report::Series error_series(std::string name, const ErrorHistory& history, report::Series::Style style);

/// Distances of cotangent H from the H of the jet and from the truth, over the vertices with both estimates.
struct ErrorIndicator {
    int vertices = 0;
    double indicated = 0;   // √(Σ A (H_cotan − H_jet)² / Σ A H²)
    double actual = 0;      // √(Σ A (H_cotan − H)² / Σ A H²)
    double found = 0;       // share of the tenth with the largest errors that is also in the tenth with the largest indications
};

/// The measurements on one mesh.
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
/// Measures the sizes of the mesh, the errors of all estimators, and the error indicator.
BenchLevel measured(const BenchMesh& mesh);
/// Measures all estimators on the hull of `points` random points of the ellipsoid with half axes 1.5, 1 and 0.7, as published; once for
/// each library, number and seed.
BenchLevel reference_level(const MeshLibrary& library, int points, std::uint64_t seed);

/// The measurements on one surface in one kind of mesh, coarse to fine.
struct BenchRun {
    std::string surface, dimensions;
    MeshKind kind = MeshKind::regular;
    std::vector<BenchLevel> levels;

    std::string title() const { return surface + ", " + std::string(name_of(kind)); }
    const BenchLevel& finest() const { return levels.back(); }
    /// Returns the errors of the estimator with this key over the levels, in one norm.
    ErrorHistory errors(std::string_view key, Norm norm = &EstimateError::l2) const;
};
using BenchRuns = std::vector<BenchRun>;

/// Measures all estimators at all `levels` of every surface in every kind of mesh, each mesh once per library. Returns the runs of the
/// first kind on all surfaces, then those of the next kind.
BenchRuns bench_runs(const MeshLibrary& library, const std::vector<KnownSurface>& surfaces, std::span<const MeshKind> kinds,
                     const std::vector<int>& levels, std::uint64_t seed, const Progress& progress);

/// Returns the runs on meshes of this kind, in order.
std::vector<std::reference_wrapper<const BenchRun>> of_kind(const BenchRuns& runs, MeshKind kind);
/// Returns the run on this surface and kind. @throws std::logic_error if there is none
const BenchRun& run_on(const BenchRuns& runs, std::string_view surface, MeshKind kind);

/// Returns 3 cot 54° / (2 sin 72°) − 1 = 0.146, the relative error of barycentric H at a flat regular pentagon. The L∞ error on the
/// icosphere, which has twelve of them, stalls there.
double pentagon_excess();
/// Checks that the L∞ error of barycentric H on the finest regular sphere is pentagon_excess(), to a quarter of the squared mean edge.
report::Check pentagon_check(const BenchRuns& runs);

inline constexpr std::array question_kinds{MeshKind::regular, MeshKind::jittered};
/// Returns the refinement levels of questions 1 and 3, coarse to fine: 2, 3, 4, 5; for a quick report 3, 4, 5.
std::vector<int> refinement_levels(bool quick);
/// Measures all estimators for questions 1 and 3: regular sphere, ellipsoid and torus, then jittered ones, up to 10 000 vertices.
BenchRuns question_runs(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress);
/// Plots the L2 errors of question_runs() over the mean edge, one panel per surface, jittered meshes dashed.
/// @param estimators  keys, each with the key of the message that names its curves
report::Plot convergence_plot(std::string id, const report::Words& words, const BenchRuns& runs,
                              std::initializer_list<std::pair<std::string_view, std::string_view>> estimators);

inline constexpr std::array panel_kinds{MeshKind::regular, MeshKind::random, MeshKind::noisy, MeshKind::anisotropic};
/// Measures all estimators on all known_surfaces() in all panel_kinds, at levels 2 to 5 (quick: 2 to 4), up to 17 000 vertices.
BenchRuns panel_runs(const MeshLibrary& library, std::uint64_t seed, bool quick, const Progress& progress);

}   // namespace meshfolio
