/// @file
/// What question 5 measures: explicit smoothing with steps below and beyond its limit.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "questions/bench/smoothing_study.h"
#include "questions/core/settings.h"

namespace meshfolio::q5_explicit {

struct UniformLimit {
    double top = 0;        // μ_max of −Δ_uniform
    double critical = 0;   // 2/μ_max
};

/// The step to take, and when to stop: the largest in which no mode changes its sign, else the largest stable one, of those that leave 95 %
/// of the size for one iteration at least; and as many iterations as do.
struct Recommendation {
    std::size_t run = 0;   // of the study, with all iterations
    SmoothingRun stopped;
};

struct ExplicitStudy {
    SmoothingSubject subject;
    std::vector<SmoothingRun> runs;             // ascending λ
    std::vector<Amplification> amplification;   // of the top mode, for each run
    UniformLimit uniform;
    std::vector<int> peaks;                      // vertices where the top mode is as large as anywhere, to a thousandth
    std::optional<Recommendation> recommended;   // none: no step tried is stable

    const std::string& name() const { return subject.name(); }
    double critical_in_edges() const { return subject.critical / (subject.mean_edge * subject.mean_edge); }
    bool stable(std::size_t run) const { return runs[run].lambda <= subject.critical; }
};

/// With the steps of the settings, else five in units of the limit: two that never overshoot, one that overshoots but is stable, one
/// just beyond, one far beyond.
ExplicitStudy explicit_study(std::shared_ptr<const LibraryMesh> source, const QuestionSettings& settings);

/// Does a step of λ leave the sign of every mode (λμ_max ≤ 1, half the limit)?
bool keeps_signs(const SmoothingSubject& subject, double lambda);

/// How far the barycentre of `X` is from that of the input, over the box diagonal.
double barycentre_drift(const SmoothingSubject& subject, const Positions& X);

}   // namespace meshfolio::q5_explicit
