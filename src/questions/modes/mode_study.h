/// @file
/// The damping of each eigenmode, and the gap between the two schemes, measured and predicted.
#pragma once

#include "questions/bench/smoothing_study.h"
#include "questions/modes/parts.h"

namespace meshfolio::modes {

/// Returns the factor that some steps leave of a mode: (1 − λμ)ᵗ or (1 + λμ)⁻ᵗ.
double damping_law(SmoothingScheme scheme, double lambda, int steps, double mu);

/// Damping by some steps of one scheme, on coordinates that contain each mode with coefficient 1.
struct ModeDamping {
    SmoothingScheme scheme = SmoothingScheme::explicit_euler;
    double lambda = 0;   // [length²]
    int steps = 0;
    Vector measured;   // factor of each coefficient, with its sign

    double law(double mu) const { return damping_law(scheme, lambda, steps, mu); }
    /// Returns the largest |measured − law|, over the largest of the laws and 1.
    double deviation(const Vector& eigenvalues) const;
};

/// Explicit against implicit at equal λ and t. Distances are area-weighted rms values over the box diagonal.
struct SchemeGap {
    double lambda = 0;   // [length²]
    int steps = 0;
    double motion = 0;      // of the implicit run
    double measured = 0;    // between the two results; NaN if the explicit run blew up
    double predicted = 0;   // from all modes of the input; NaN if they are not known

    double share() const { return measured / motion; }
};

struct ModeStudy {
    SmoothingSubject subject;
    Vector eigenvalues;                  // of the modes measured, ascending [1/length²]
    bool all = false;                    // all modes of the mesh; else the lowest and the top one
    std::vector<ModeDamping> dampings;   // damped_steps explicit ones, then as many implicit ones
    double rounding = 0;                 // of stored coordinates, over the box diagonal
    std::vector<SchemeGap> gaps;         // step by step, each with the same counts of iterations

    const std::string& name() const { return subject.name(); }
    /// True if the gap has a prediction, and is above 1e8 times the rounding of coordinates, so that it can be compared with it.
    bool is_measurable(const SchemeGap& gap) const { return all && gap.measured > 1e8 * rounding; }
};
inline constexpr int damped_steps = 3;          // step sizes of the dampings of one scheme
inline constexpr double law_tolerance = 1e-9;   // largest deviation() that passes

/// Measures dampings, and gaps at the λ and iterations of the settings, else at 0.1, 0.5, 0.9 of λ_crit and 1, 10, 100 iterations.
ModeStudy mode_study(SharedMesh source, const QuestionSettings& settings);

}   // namespace meshfolio::modes
