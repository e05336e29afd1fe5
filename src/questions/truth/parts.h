/// @file
/// The parts of the chapter "truth", which `meshfolio verify` writes too.
#pragma once

#include "questions/bench/curvature_bench.h"
#include "questions/bench/estimators.h"

namespace meshfolio::truth {

inline constexpr report::Words words("truth");

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
GroundTruth ground_truth(std::uint64_t seed, bool quick, const Progress& progress);

std::vector<report::Check> ground_truth_checks(const GroundTruth& truth);

report::Section ground_truth_section(const GroundTruth& truth);

// Tables and plots: one row an estimator.
report::Table overview(const GroundTruth& truth);
report::Table error_table(const GroundTruth& truth, MeshKind kind);
report::Plot convergence_plot(const GroundTruth& truth, MeshKind kind, Quantity quantity);

/// Errors on the finest meshes and orders of every estimator on every surface, for files.
report::Table finest_table(const GroundTruth& truth);
/// Lists every estimate on every mesh with all measured values, for files.
report::Table ground_truth_table(const GroundTruth& truth);

}   // namespace meshfolio::truth
