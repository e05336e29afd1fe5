/// @file
/// The parts of question 3.
#pragma once

#include "questions/bench/cotangent_study.h"
#include "questions/bench/curvature_bench.h"

namespace meshfolio::q3_cotangent {

inline constexpr report::Words words("q3");

using Comparisons = std::vector<CotangentComparison>;

/// The difference of cotangent H from H of a degree-3 jet, over inner vertices where both exist: an indicator of the error of cotangent H.
struct Disagreement {
    Vector jet;                 // n values [1/length]
    Vector size;                // n values |H_cotan − H_jet|, NaN elsewhere [1/length]
    double rms = 0;             // over the rms of H_cotan; NaN where that is rounding
    double rms_uniform = 0;     // of |H_uniform − H_jet|, over the rms of H_cotan
    double median = 0;          // over the rms of H_cotan
    double concentration = 0;   // share of Σ size² at the hundredth of the vertices with the largest sizes
    int without_jet = 0;        // vertices inside whose two rings do not determine a jet
};
/// Compares cotangent and uniform H with H of the jets on one mesh.
Disagreement disagreement_with_jet(const CotangentComparison& c);
using Disagreements = std::vector<Disagreement>;   // a mesh each

/// The indicator on a mesh with known curvature.
struct IndicatorTrial {
    std::string mesh;   // "jittered torus"
    ErrorIndicator indicator;
};
/// Returns the indicator on the finest mesh of each run, and last on 10 000 (quick: 2500) random points of an ellipsoid.
std::vector<IndicatorTrial> indicator_trials(const MeshLibrary& library, const BenchRuns& runs, const QuestionSettings& settings);

/// True if the vertices of the mesh do not lie in one plane.
inline bool is_curved(const CotangentComparison& c) { return !c.subject.plane_normal; }
/// Returns the end of the colour range of a mesh: the diverging_range() of cotangent H × mean edge, at least 0.005.
double cotangent_range(const CotangentComparison& comparison);

/// Adds a figure of uniform and cotangent H × mean edge on the curved meshes. If there are at most two, a mesh with uniform H beyond the
/// range at a fifth of its vertices also shows uniform H in a range of its own, and H of the jets.
void add_comparison_figure(Answer& answer, const Comparisons& meshes, const Disagreements& with_jets);
/// Adds a figure of uniform and cotangent |H| × mean edge on the flat meshes and on the irregular square, in one range.
void add_plane_figure(Answer& answer, const Comparisons& meshes, const PlaneTest& plane, const std::string& colormap);
/// Adds a figure of |H_cotan − H_jet| × mean edge on one mesh, and a paragraph with its rms, its median, and the share that the worst
/// vertices have of it.
void add_disagreement(Answer& answer, const CotangentComparison& comparison, const Disagreement& disagreement, const std::string& colormap);
/// Draws the opposite angles of an edge, the pull of uniform weights, and why that of cotangent weights vanishes.
report::Diagram weight_diagram();

/// Returns a table of uniform and cotangent H and their differences, a row for each mesh; for files only.
report::Table difference_table(const Comparisons& meshes);
/// Returns a table with a row for each variant of the cotangent operator on each mesh; for files only.
report::Table variant_table(const Comparisons& meshes);
/// Returns a table of errors on the finest meshes in one norm [%], a row for each run, a column for each estimator with `in_q3`.
/// @param key, name  of the norm, in the id and in the caption: "l2", "L2"
report::Table error_table(const BenchRuns& runs, Norm norm, const std::string& key, const std::string& name);
/// Plots the L2 errors of uniform and of cotangent H over the mean edge, a panel for each surface.
report::Plot error_curves(const BenchRuns& runs);

/// Returns the answer of the section.
report::Text answer_of(const BenchRuns& runs);
/// Returns the first paragraph of the section.
report::Text lead_of(const BenchRuns& runs, const PlaneTest& plane, const BenchRuns& panel);
/// Adds the discussion. @param runs, panel  of questions 1 and 3; on all surfaces
void add_discussion(report::Section& section, const Comparisons& meshes, const Disagreements& with_jets, const BenchRuns& runs,
                    const PlaneTest& plane, const BenchRuns& panel);
/// Adds the head of the appendix: boundaries, and the twelve pentagons of the icosphere.
void add_limits(report::Section& section, const Comparisons& meshes, const BenchRuns& runs);
/// Adds a paragraph, a table and a check of the indicator against the true errors. @param trials  the last is that of random points
void add_trust(report::Section& section, const std::vector<IndicatorTrial>& trials);
void add_checks(report::Section& section, const BenchRuns& runs, const PlaneTest& plane, const Comparisons& meshes);

}   // namespace meshfolio::q3_cotangent
