/// @file
/// What question 6 measures: implicit beside explicit smoothing over a grid of steps and iterations, and what both cost.
#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "questions/bench/smoothing_study.h"
#include "questions/core/settings.h"

namespace meshfolio::q6_implicit {

/// One cell of the grid λ × iterations, both schemes.
struct SmoothingCell {
    double lambda = 0;
    int iterations = 0;
    Positions implicit_X, explicit_X;   // explicit_X is empty once the explicit run has blown up
    double implicit_energy = 0, explicit_energy = 0;
    int explicit_blow_up = 0;   // iteration; 0: none
    double volume_ratio = 0;    // of the implicit result; NaN when open
    double kept = 1;            // of the size: the least share that the implicit run left of any component until here
    int inverted_faces = 0;     // of the implicit result
    int fewer_steps = 0;        // of a larger λ and the same λt; 0: none are in the grid
    double apart = NAN;         // the implicit result from theirs, over the distance moved

    bool collapsed() const { return implicit_energy < 1e-12; }   // to a point
    bool has_explicit() const { return explicit_X.size() > 0; }
    double time() const { return lambda * iterations; }   // λt [length²]
};

/// What a result costs: its factorisation and implicit steps, and the explicit steps at half of λ_crit that reach the same energy.
struct SmoothingCost {
    SmoothingCell cell;
    bool recommended = false;
    int explicit_steps = 0;                                    // 0: more than the limit tried
    double step = 0;                                           // an implicit one, over an explicit one [operations]
    double factorisation = 0;                                  // over one implicit step; 0: conjugate gradients need none
    double implicit_operations = 0, explicit_operations = 0;   // multiply–adds
    double roughness = NAN, explicit_roughness = NAN;          // median angle between neighbouring faces [°]

    bool reached() const { return explicit_steps > 0; }
    /// Of the operations, explicit over implicit; NaN where one is not known.
    double ratio() const { return reached() && implicit_operations > 0 ? explicit_operations / implicit_operations : NAN; }
};

/// How far apart the two schemes end after t steps, over the distance moved.
struct SchemeGap {
    int iterations = 0;
    double share = 0;
};

struct ImplicitStudy {
    SmoothingSubject subject;
    double roughness = 0;   // median angle between neighbouring faces of the input [°]
    std::vector<double> lambdas;
    std::vector<int> iterations;
    std::vector<SmoothingCell> grid;                          // λ by λ, iterations ascending
    std::vector<SmoothingRun> implicit_runs, explicit_runs;   // one a λ
    double worst_damping = 0;                                 // largest relative deviation from (1 + λμ)^−t
    int damped_modes = 0;                                     // modes that went into it
    double huge_step_energy = 0;                              // after one implicit step at a million times the explicit limit, of input
    std::optional<SmoothingCell> recommended;                 // as many steps as keep the size; none: one already goes too far
    std::vector<SmoothingCost> costs;                         // of the recommended cell, and of one far beyond the explicit limit

    const std::string& name() const { return subject.name(); }
    bool is_closed() const { return subject.source->prepared->preflight.closed(); }
    const SmoothingCell& cell(std::size_t lambda, std::size_t t) const { return grid[lambda * iterations.size() + t]; }
    /// Index of the largest λ that is within the explicit limit.
    std::optional<std::size_t> within_limit() const;
    /// At that λ, as long as something is left to smooth.
    std::vector<SchemeGap> gaps() const;
    /// Index of the smallest λ whose explicit run blew up.
    std::optional<std::size_t> first_blown() const;
    /// Index of the iteration count that is looked at where one must do: the middle one.
    std::size_t middle_iteration() const { return iterations.size() / 2; }
    const SmoothingCell& middle_cell(std::size_t lambda) const { return cell(lambda, middle_iteration()); }
    /// The most smoothing that leaves 95 % of the size: of each λ as many steps as do; among those within 1 % of the least energy the one
    /// with the fewest steps. Null: none.
    const SmoothingCell* good() const { return recommended ? &*recommended : nullptr; }
    /// Of the cells that leave less the one nearest to half of the size: what too much looks like. Null: none, or only points.
    const SmoothingCell* too_much() const;
};

/// With the steps of the settings, else three in units of the explicit limit: within it, a little beyond, far beyond.
ImplicitStudy implicit_study(std::shared_ptr<const LibraryMesh> source, const QuestionSettings& settings);

}   // namespace meshfolio::q6_implicit
