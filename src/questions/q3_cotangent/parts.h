/// @file
/// The parts of question 3.
#pragma once

#include "questions/bench/cotangent_study.h"
#include "questions/bench/curvature_bench.h"

namespace meshfolio::q3_cotangent {

inline constexpr report::Words words("q3");

/// The area form in all figures and their text; later questions use it in the mass matrix.
inline constexpr AreaForm areas_used = AreaForm::barycentric;

using Comparisons = std::vector<CotangentComparison>;

// How far cotangent H is from that of a degree-3 jet: an indicator of its error where no closed form is known.
/// The difference of two estimates on a mesh without closed form, over inner vertices where both exist.
struct Disagreement {
    Vector jet;                 // n values [1/length]
    Vector size;                // n values |H_cotan − H_jet|, NaN elsewhere [1/length]
    double rms = 0;             // over the rms of H_cotan; NaN where that is rounding
    double rms_uniform = 0;     // of |H_uniform − H_jet|, over the same
    double median = 0;          // over the rms of H_cotan
    double concentration = 0;   // share of Σ size² that the hundredth of the vertices with the largest holds
    int without_jet = 0;        // vertices inside whose two rings do not determine one
};
Disagreement disagreement_with_jet(const CotangentComparison& c);
using Disagreements = std::vector<Disagreement>;   // a mesh each

/// What the indicator is worth on a mesh where the truth is known.
struct IndicatorTrial {
    std::string mesh;   // "jittered torus"
    ErrorIndicator indicator;
};
/// Tests the indicator on the finest regular and jittered known surfaces, and on random points of an ellipsoid.
std::vector<IndicatorTrial> indicator_trials(const BenchRuns& runs, const QuestionSettings& settings);

inline bool is_curved(const CotangentComparison& c) { return !c.subject.plane_normal; }
/// The end of the colour range of a mesh, set by its cotangent H.
double cotangent_range(const CotangentComparison& comparison);
/// The curved meshes by both operators, and where uniform H does not fit on the scale of cotangent H, on its own, and beside the jets.
void add_comparison_figure(Answer& answer, const Comparisons& meshes, const Disagreements& with_jets);
/// The flat meshes and the irregular square by both operators, on one scale.
void add_plane_figure(Answer& answer, const Comparisons& meshes, const PlaneTest& plane, const std::string& colormap);
void add_disagreement_figure(Answer& answer, const CotangentComparison& comparison, const Disagreement& disagreement,
                             const std::string& colormap);

/// The opposite angles, the pull of uniform weights, and why that of cotangents vanishes.
report::Diagram weight_diagram();

report::Text answer_of(const BenchRuns& runs);
report::Text lead_of(const BenchRuns& runs, const PlaneTest& plane, const BenchRuns& panel);
void add_discussion(report::Section& section, const Comparisons& meshes, const Disagreements& with_jets, const BenchRuns& runs,
                    const PlaneTest& plane, const BenchRuns& panel);
/// Heads the appendix: boundaries, and the twelve pentagons of the icosphere.
void add_limits(report::Section& section, const Comparisons& meshes, const BenchRuns& runs);

}   // namespace meshfolio::q3_cotangent
