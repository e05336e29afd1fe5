/// @file
/// The measurements of question 5: explicit smoothing with steps below and beyond its limit.
#pragma once

#include "questions/bench/smoothing_study.h"

namespace meshfolio::q5_explicit {

/// The run with the largest step that changes the sign of no mode, else with the largest stable step; steps that leave less than 95 % of
/// the size after one iteration do not count. It has as many iterations as leave 95 %, at most ten times those of the study's runs.
struct Recommendation {
    std::size_t run = 0;   // index of the run of the study with this step
    SmoothingRun stopped;
    bool all_kept = false;                              // 95 % would be left after more iterations too
    double roughness_before = 0, roughness_after = 0;   // median angle between neighbouring faces [°]
    double on_features = 0, on_boundary = 0;            // rms motion of these vertices, over that of the others; 0: there are none
    int folded_before = 0, folded_after = 0;            // faces that turned over and face away from those around them

    double time() const { return stopped.lambda * stopped.iterations; }   // λt [length²]
};

/// States of one run; fewer frames than times if the mesh blew up before.
struct Strip {
    std::size_t run = 0;   // of the study
    std::vector<int> times;
    std::vector<Positions> frames;

    /// Returns the state after t iterations; null if it is not kept.
    const Positions* at(int t) const;
};

struct ExplicitStudy {
    SmoothingSubject subject;
    std::vector<SmoothingRun> runs;              // ascending λ
    std::vector<Amplification> amplification;    // of the top mode, for each run
    double uniform_top = 0;                      // μ_max of −Δ_uniform
    std::vector<int> peaks;                      // vertices where the top mode is largest, to a thousandth
    std::optional<Recommendation> recommended;   // none: no step tried is stable
    std::optional<Strip> near, far;              // of the first step beyond the limit; of the largest step if it exceeds 1.5 λ_crit

    const std::string& name() const { return subject.name(); }
    double critical_in_edges() const { return in_edges(subject.critical); }
    /// Converts an area, such as λ or λt, to squared mean edges.
    double in_edges(double area) const { return area / (subject.mean_edge * subject.mean_edge); }
    double uniform_critical() const { return 2 / uniform_top; }
    bool stable(std::size_t run) const { return runs[run].lambda <= subject.critical; }
    /// Returns the index of the first run beyond the limit; the number of runs if there is none.
    std::size_t first_beyond() const;
};

/// Default steps, in multiples of the limit: two without overshoot, one with overshoot but stable, one just beyond, one far beyond.
inline const std::vector<double> own_steps{0.05, 0.5, 0.95, 1.05, 2.0};
/// Returns the number of iterations of every run: the last of the settings, else 50 (quick: 20).
int iterations_of(const QuestionSettings& settings);

/// Smooths the mesh with every step of the settings, else of own_steps, and finds the recommended run.
ExplicitStudy explicit_study(SharedMesh source, const QuestionSettings& settings);

/// True if a step of λ changes the sign of no mode: λμ_max ≤ 1, half the limit.
bool keeps_signs(const SmoothingSubject& subject, double lambda);

/// Returns the share of the vertices with a mean angle between the faces at their edges that is more than 1° larger at X than in the input.
double share_rougher(const SmoothingSubject& subject, const Positions& X);

/// True if the run with the largest step blows up at one of the peaks, and the top mode is more than half of its motion.
bool ends_by_top_mode(const ExplicitStudy& study);

/// True if triangle t faces away from the other triangles at its vertices. @param normals  unit, one a triangle
bool is_folded(const TriangleMesh& mesh, const MeshTopology& topology, const Positions& normals, int t);

/// Returns the distance between the barycentres of X and of the input, over the box diagonal.
double barycentre_drift(const SmoothingSubject& subject, const Positions& X);

/// Returns λ over λ_crit of the runs that `run_of` chooses (null: none), as text; empty if they differ or there are none.
template <class RunOf> std::string common_limits(const std::vector<ExplicitStudy>& studies, const RunOf& run_of) {
    Names limits;
    for (const ExplicitStudy& study : studies)
        if (const SmoothingRun* run = run_of(study)) limits.push_back(in_limits(study.subject, run->lambda));
    limits = each_once(std::move(limits));
    return limits.size() == 1 ? limits.front() : "";
}

}   // namespace meshfolio::q5_explicit
