/// @file
/// How each eigenmode fades, how far apart the two schemes are, and what a given smoothness costs.
#pragma once

#include "questions/bench/smoothing_study.h"
#include "questions/modes/costs.h"

namespace meshfolio::modes {

/// Damping by some steps of one scheme, on coordinates that contain each mode with coefficient 1.
struct ModeDamping {
    SmoothingScheme scheme = SmoothingScheme::explicit_euler;
    double lambda = 0;   // [length²]
    int steps = 0;
    Vector measured;   // factor of each coefficient, with its sign

    /// (1 − λμ)ᵗ or (1 + λμ)⁻ᵗ.
    double law(double mu) const;
    /// Largest |measured − law|, over the largest of the laws and 1: what the others leave by rounding.
    double deviation(const Vector& eigenvalues) const;
};

/// Explicit against implicit at equal λ and t. Distances are area-weighted rms values over the box diagonal.
struct SchemeGap {
    double lambda = 0;   // [length²]
    int steps = 0;
    double motion = 0;      // of the implicit run
    double measured = 0;    // between the two results; NaN where the explicit run blew up
    double predicted = 0;   // from the spectral measure of the input

    /// Of the motion of the implicit run.
    double share() const { return measured / motion; }
};

/// A way that was run.
struct TriedWay {
    std::size_t target = 0;
    SmoothingWay way;
    double energy = 0;     // measured, of the input
    double rounding = 0;   // what the rounding of coordinates and weights may do to that, relative
    double seconds = 0;
};

struct ModeStudy {
    SmoothingSubject subject;
    Vector eigenvalues;   // of the modes measured, ascending [1/length²]
    bool all = false;     // every one of the mesh; else the lowest and the top
    std::vector<ModeDamping> dampings;
    SpectralMeasure measure;
    double rounding = 0;           // of stored coordinates, over the box diagonal
    std::vector<SchemeGap> gaps;   // step by step, of each the same counts of iterations
    FactorOperations factor;
    double explicit_step = 0, implicit_step = 0;             // multiply–adds
    std::vector<SmoothingTarget> targets;                    // those of the table
    std::vector<SmoothingTarget> curve;                      // finer, energies descending
    std::vector<std::optional<SmoothingTarget>> crossings;   // of each implicit way with the explicit one
    std::vector<TriedWay> tried;

    const std::string& name() const { return subject.name(); }
    /// Is the gap far enough above the rounding of coordinates to be compared with its prediction?
    bool seen(const SchemeGap& gap) const { return gap.measured > 1e8 * rounding; }
    /// Is this implicit way cheaper than the explicit one at no energy, or at every energy?
    bool cheaper_nowhere(std::size_t which) const { return !crossings[which]; }
    bool cheaper_everywhere(std::size_t which) const { return crossings[which] && crossings[which]->energy >= curve.front().energy; }
};
/// The Lanczos steps of the spectral measure, for each coordinate.
int lanczos_steps(const QuestionSettings& settings);

/// Gaps at the steps and iterations of the settings, else at three shares of the limit and three counts.
ModeStudy mode_study(SharedMesh source, const QuestionSettings& settings);

using ModeStudies = std::vector<ModeStudy>;

/// Dampings of one scheme in a study: first those of the explicit one, then of the implicit one.
inline constexpr int damped_steps = 3;

/// No coefficient may be farther than this from its law, over the largest.
inline constexpr double law_tolerance = 1e-9;

}   // namespace meshfolio::modes
