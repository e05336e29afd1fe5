/// @file
/// The damping of each eigenmode by both schemes.
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

struct ModeStudy {
    SmoothingSubject subject;
    Vector eigenvalues;                  // of the modes measured, ascending [1/length²]
    bool all = false;                    // all modes of the mesh; else the lowest and the top one
    std::vector<ModeDamping> dampings;   // damped_steps explicit ones, then as many implicit ones

    const std::string& name() const { return subject.name(); }
};
inline constexpr int damped_steps = 3;          // step sizes of the dampings of one scheme
inline constexpr double law_tolerance = 1e-9;   // largest deviation() that passes

/// Measures ten steps of each scheme, below and beyond the explicit limit.
ModeStudy mode_study(SharedMesh source, const QuestionSettings& settings);

}   // namespace meshfolio::modes
