/// @file
/// How far the cotangent estimate of H is from that of a degree-3 jet: an indicator of its error where no closed form is known.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "questions/bench/cotangent_study.h"

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

/// What the indicator is worth, where the truth is known.
struct IndicatorTrial {
    std::string mesh;   // "jittered torus"
    int vertices = 0;
    double indicated = 0;   // √(Σ A (H_cotan − H_jet)² / Σ A H²)
    double actual = 0;      // the same with the closed form in place of the jet
    double found = 0;       // of the tenth of the vertices with the largest errors, the share that is in the tenth indicated
};
/// On the finest regular and jittered known surfaces, and on random points of an ellipsoid.
std::vector<IndicatorTrial> indicator_trials(const QuestionSettings& settings);

}   // namespace meshfolio::q3_cotangent
