/// @file
/// The ground-truth panel: every estimator of curvature on every surface with a closed form, on every kind of mesh, finer and finer.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "questions/bench/ground_truth_meshes.h"
#include "questions/core/chapter.h"

namespace meshfolio {

enum class Quantity { H, K };

inline std::string symbol(Quantity quantity) { return quantity == Quantity::H ? "H" : "K"; }

/// The estimators of H and of K, in the order of all tables.
struct Estimator {
    std::string key;                                                   // "mixed", for looking up
    std::string words;                                                 // "cotangent.mixed", its message
    std::string name() const { return curvature_words.line(words); }   // "cotangent ½‖Δx‖, mixed"
};
const std::vector<Estimator>& estimators_of(Quantity quantity);

/// Errors relative to the root mean square (L2) and the largest magnitude (L∞) of the truth. Where the truth is 0 everywhere, √(2H² − K)
/// stands for H and 2H² − K for K, of which the principal curvatures say the same.
struct EstimateError {
    double l2 = 0, linf = 0;
    int undefined = 0;   // measured vertices without an estimate
};

struct PanelLevel {
    int vertices = 0;
    double mean_edge = 0;              // [length]
    std::vector<EstimateError> H, K;   // by estimator
};
PanelLevel panel_level(const TruthMesh& truth);

/// One surface in one kind of mesh, coarse to fine.
struct PanelRun {
    std::string surface, dimensions;
    MeshKind kind = MeshKind::regular;
    std::vector<PanelLevel> levels;

    const EstimateError& error(Quantity quantity, std::size_t estimator, std::size_t level) const {
        return (quantity == Quantity::H ? levels[level].H : levels[level].K)[estimator];
    }
    const EstimateError& finest(Quantity quantity, std::size_t estimator) const { return error(quantity, estimator, levels.size() - 1); }
};

/// Least-squares slope of log error over log mean edge.
struct FittedOrder {
    double order = 0;            // NaN with fewer than two positive errors, or where the finest is rounding
    double standard_error = 0;   // NaN with fewer than three
};
FittedOrder order_with_error(const std::vector<double>& mean_edges, const std::vector<double>& errors);

struct GroundTruth {
    std::vector<PanelRun> runs;   // by kind, then by surface
    PanelLevel reference;         // 10 000 random points on the ellipsoid with half axes 1.5, 1 and 0.7, measured elsewhere too
    std::uint64_t seed = 1;
    bool quick = false;

    const PanelRun& run(const std::string& surface, MeshKind kind) const;
    EstimateError finest(const std::string& surface, MeshKind kind, Quantity quantity, const std::string& key) const;
    /// Over all levels.
    FittedOrder order(const PanelRun& run, Quantity quantity, std::size_t estimator,
                      double EstimateError::*norm = &EstimateError::l2) const;
    FittedOrder order(const std::string& surface, MeshKind kind, Quantity quantity, const std::string& key) const;
};

/// Four refinements of up to 17 000 vertices, or three for a quick look.
GroundTruth ground_truth(std::uint64_t seed, bool quick, const Progress& progress);

/// The panel of this run: worked out by the first section that asks, shared with those that cite it.
std::shared_ptr<const GroundTruth> shared_ground_truth(const QuestionSettings& settings, const Progress& progress);

/// Position of an estimator in estimators_of. @throws std::logic_error for an unknown key
std::size_t estimator_index(Quantity quantity, const std::string& key);

/// "1.98 ± 0.01", or "exact" where there is none for the error being rounding.
std::string words_of(const FittedOrder& order);

/// "27.6 % (order 0.03 ± 0.01)": L2 on the finest mesh, and its order.
std::string error_and_order(const GroundTruth& truth, const std::string& surface, MeshKind kind, Quantity quantity, const std::string& key);

/// What must come out, as named checks.
std::vector<report::Check> ground_truth_checks(const GroundTruth& truth);

}   // namespace meshfolio
