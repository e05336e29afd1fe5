/// @file
/// How far the cotangent estimate of H is from that of a degree-3 jet: an indicator of its error where no closed form is known.
#pragma once

#include "questions/bench/cotangent_study.h"
#include "questions/bench/curvature_bench.h"

namespace meshfolio::q3_cotangent {

/// On a mesh without closed form; over the vertices inside where both estimates exist.
struct Disagreement {
    Vector size;                // n values |H_cotan − H_jet|, NaN elsewhere [1/length]
    double rms = 0;             // over the rms of H_cotan; NaN where that is rounding
    double median = 0;          // over the rms of H_cotan
    double concentration = 0;   // share of Σ size² that the hundredth of the vertices with the largest holds
    int without_jet = 0;        // vertices inside whose two rings do not determine one
};
Disagreement disagreement_with_jet(const CotangentComparison& c);

/// What the indicator is worth on a mesh where the truth is known.
struct IndicatorTrial {
    std::string mesh;   // "jittered torus"
    ErrorIndicator indicator;
};
/// On the finest regular and jittered known surfaces, and on random points of an ellipsoid.
std::vector<IndicatorTrial> indicator_trials(const BenchRuns& runs, const QuestionSettings& settings);

}   // namespace meshfolio::q3_cotangent
