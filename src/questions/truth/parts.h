/// @file
/// The parts of the chapter "truth", which `meshfolio verify` writes too.
#pragma once

#include "questions/bench/curvature_bench.h"
#include "questions/bench/estimators.h"

namespace meshfolio::truth {

inline constexpr report::Words words("truth");

/// The errors of all estimators on all surfaces.
struct GroundTruth {
    BenchRuns runs;         // of the panel
    BenchLevel reference;   // on 10 000 random points of an ellipsoid
    std::uint64_t seed = 1;
    bool quick = false;

    const BenchRun& run(std::string_view surface, MeshKind kind) const { return run_on(runs, surface, kind); }
    ErrorHistory errors(std::string_view surface, MeshKind kind, std::string_view estimator) const {
        return run(surface, kind).errors(estimator);
    }
};
/// Measures all estimators on panel_runs() and on 10 000 random points. @param quick  three refinements instead of four
GroundTruth ground_truth(const MeshLibrary& library, std::uint64_t seed, bool quick, const Progress& progress);

/// Returns the checks of orders and errors that theory predicts or another program has found.
std::vector<report::Check> ground_truth_checks(const GroundTruth& truth);
/// Returns the section "truth" with its answer, tables, plots and checks.
report::Section ground_truth_section(const GroundTruth& truth);

/// Returns a table with a row for each estimator and a column for each kind of mesh: a sign for the order on each surface (● second, ◐
/// less, ○ none), and the largest error on a finest mesh.
report::Table overview(const GroundTruth& truth);
/// Returns a table of the L2 errors [%] on the finest meshes of a kind, a row for each estimator and a column for each surface.
report::Table error_table(const GroundTruth& truth, MeshKind kind);
/// Plots the L2 errors of seven estimators of H, or six of K, on the ellipsoid over the mean edge, for meshes of one kind.
report::Plot convergence_plot(const GroundTruth& truth, MeshKind kind, Quantity quantity);

/// Returns a table for files with a row for each estimator on each surface and kind: L2 error on the finest mesh, order and its margin.
report::Table finest_table(const GroundTruth& truth);
/// Returns a table for files with a row for each estimator on each mesh: vertices, errors, undefined vertices, orders.
report::Table ground_truth_table(const GroundTruth& truth);

}   // namespace meshfolio::truth
