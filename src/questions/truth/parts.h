/// @file
/// The parts of the chapter "truth", which `meshfolio verify` writes too.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "questions/bench/ground_truth.h"
#include "report/document.h"

namespace meshfolio::truth {

inline constexpr report::Words words("truth");
inline constexpr std::array quantities{Quantity::H, Quantity::K};

/// How an error behaves: of second order or exact, of less, or not converging.
enum class Behaviour { second, first, none };
Behaviour behaviour_of(const FittedOrder& order);

/// One a surface.
std::vector<const PanelRun*> runs_of(const GroundTruth& truth, MeshKind kind);

/// The whole section, checks included.
report::Section ground_truth_section(const GroundTruth& truth);
/// What the numbers say, in words that follow them.
void add_discussion(report::Section& section, const GroundTruth& truth);
/// Does this estimate of H converge?
bool converges(const GroundTruth& truth, const PanelRun& run, const std::string& estimator);

// Tables and plots: one row an estimator.
report::Table overview(const GroundTruth& truth);
struct Norm {
    double EstimateError::*of;
    std::string key, name;
};
report::Table error_table(const GroundTruth& truth, MeshKind kind, const Norm& norm);
report::Table order_table(const GroundTruth& truth, MeshKind kind, const Norm& norm);
report::Plot convergence_plot(const GroundTruth& truth, MeshKind kind, Quantity quantity);

/// One row an estimate on every mesh, with everything that was measured: for files.
report::Table ground_truth_table(const GroundTruth& truth);

}   // namespace meshfolio::truth
