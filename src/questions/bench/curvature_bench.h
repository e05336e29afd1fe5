/// @file
/// The bench of curvature: errors of every estimator on known surfaces, in every kind of mesh, coarse to fine. Questions 1 and 3, the
/// ground truth and the claims show parts of it.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <map>
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

    /// Returns true from order ½ on: halving the edges four times quarters the error at least.
    bool converges() const { return exact || exponent >= 0.5; }
};
/// Returns "1.98 ± 0.01", "exact", or "–" if too few errors are known.
std::string words_of(const Order& order);

/// The error of one estimator over a refinement.
struct ErrorHistory {
    std::vector<double> mean_edges, errors;   // coarse to fine

    /// Returns the coarsest of the errors that give the order.
    double first() const { return errors[errors.size() > 3 ? errors.size() - 3 : 0]; }
    double last() const { return errors.back(); }
    Order order() const;
};
/// Describes the errors: "falls from 3.1 % to 0.05 % (order 1.98 ± 0.01)", "goes from 14.6 % to …", "grows from … to …".
std::string trend(const ErrorHistory& history);
/// Makes an empty log–log plot of relative L2 errors over the mean edge.
report::Plot error_plot(std::string id, std::string caption, std::string alt);
/// Makes a series for such a plot, in percent.
report::Series error_series(std::string name, const ErrorHistory& history, report::Series::Style style);

/// Distances of cotangent H from the H of the jet and from the truth, over the vertices with both estimates.
struct ErrorIndicator {
    int vertices = 0;
    double indicated = 0;   // √(Σ A (H_cotan − H_jet)² / Σ A H²)
    double actual = 0;      // the same with the closed form in place of the jet
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
/// Measures the errors of all estimators on the mesh.
BenchLevel measured(const BenchMesh& mesh);
/// Measures on random points of the ellipsoid with half axes 1.5, 1 and 0.7, as published; once per library.
BenchLevel reference_level(const MeshLibrary& library, int points, std::uint64_t seed);

/// The measurements on one surface in one kind of mesh, coarse to fine.
struct BenchRun {
    std::string surface, dimensions;
    MeshKind kind = MeshKind::regular;
    std::vector<BenchLevel> levels;

    std::string title() const { return surface + ", " + std::string(name_of(kind)); }
    const BenchLevel& finest() const { return levels.back(); }
    ErrorHistory errors(std::string_view key, Norm norm = &EstimateError::l2) const;
};
using BenchRuns = std::vector<BenchRun>;

/// Measures on every surface in every kind of mesh, one kind after the other; on each mesh once per library.
BenchRuns bench_runs(const MeshLibrary& library, const std::vector<KnownSurface>& surfaces, std::span<const MeshKind> kinds,
                     const std::vector<int>& levels, std::uint64_t seed, const Progress& progress);

/// Returns the runs on meshes of this kind, in order.
std::vector<std::reference_wrapper<const BenchRun>> of_kind(const BenchRuns& runs, MeshKind kind);
/// Returns the run on this surface and kind. @throws std::logic_error if there is none
const BenchRun& run_on(const BenchRuns& runs, std::string_view surface, MeshKind kind);

/// Computes the relative error of barycentric H at a flat regular pentagon, where the L∞ error on the icosphere stalls (twelve vertices).
double pentagon_excess();
/// Checks that the L∞ error of barycentric H on the finest icosphere is pentagon_excess().
report::Check pentagon_check(const BenchRuns& runs);

inline constexpr std::array question_kinds{MeshKind::regular, MeshKind::jittered};
/// Returns the refinement levels of questions 1 and 3, coarse to fine: four, or three for a quick report.
std::vector<int> refinement_levels(bool quick);
/// Measures for questions 1 and 3: sphere, ellipsoid and torus, regular and jittered, up to 10 000 vertices.
BenchRuns question_runs(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress);
/// Plots L2 errors of those runs, one panel per surface, jittered meshes dashed.
/// @param estimators  keys, each with the key of the message that names its curves
report::Plot convergence_plot(std::string id, const report::Words& words, const BenchRuns& runs,
                              std::initializer_list<std::pair<std::string_view, std::string_view>> estimators);

inline constexpr std::array panel_kinds{MeshKind::regular, MeshKind::random, MeshKind::noisy, MeshKind::anisotropic};
/// Measures for the ground-truth panel: all surfaces, four refinements up to 17 000 vertices, or three for a quick report.
BenchRuns panel_runs(const MeshLibrary& library, std::uint64_t seed, bool quick, const Progress& progress);

}   // namespace meshfolio
