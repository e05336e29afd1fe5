/// @file
/// What question 5 measures: explicit smoothing with steps below and beyond its limit.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "questions/bench/smoothing_study.h"
#include "questions/core/settings.h"

namespace meshfolio::q5_explicit {

struct UniformLimit {
    double top = 0;        // μ_max of −Δ_uniform
    double critical = 0;   // 2/μ_max
};

struct ExplicitStudy {
    SmoothingSubject subject;
    std::vector<SmoothingRun> runs;             // ascending λ
    std::vector<Amplification> amplification;   // of the top mode, for each run
    UniformLimit uniform;
    int best = -1;   // run recommended; −1: none is stable

    const std::string& name() const { return subject.name(); }
    const SmoothingRun& recommended() const { return runs[static_cast<std::size_t>(best)]; }
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

/// Iterations of the run before less than `share` of the volume is left; −1 when it never comes to that.
int iterations_keeping_volume(const SmoothingRun& run, double share);

}   // namespace meshfolio::q5_explicit
