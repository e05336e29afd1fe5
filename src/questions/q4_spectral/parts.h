/// @file
/// The parts of question 4.
#pragma once

#include "questions/bench/spectral_uses.h"

namespace meshfolio::q4_spectral {

inline constexpr report::Words words("q4");

/// Errors below this share of the box diagonal are rounding and count as 0.
inline constexpr double rounding = 1e-9;
/// Likewise: errors whose smallest k is told.
inline constexpr std::array target_shares{0.1, 0.01, 0.001};

/// One mesh: its reconstructions, and why its thin parts suffer.
struct Subject {
    SpectralStudy study;
    LimbStudy limbs;
    double factor_entries = 0;   // of a Cholesky factor of −C + σM
    bool chosen_k = true;        // by the question, not by the settings

    const std::string& name() const { return study.name(); }
};
Subject subject_of(SharedMesh mesh, const QuestionSettings& settings);

/// The reconstructions that the answer is about: the first two k, the largest that leaves an error, and the largest.
std::vector<const Reconstruction*> told_reconstructions(const SpectralStudy& study);
/// The modes that are drawn, counted from 1: the first four that are not constant on every component, the 10th and the 15th.
std::vector<int> drawn_modes(const SpectralStudy& study);
/// How many of 100 vertices lie nearer to the centroid than the one where the mode is largest.
double remoteness_of_peak(const SpectralStudy& study, int mode);
/// The share of the area that is off by more than seen_error.
double share_seen(const SpectralStudy& study, const Reconstruction& r);
bool is_exact(const SpectralStudy& study, int k);
/// The largest k that leaves an error; null: all are exact.
const Reconstruction* last_erring(const SpectralStudy& study);

inline std::string id_of(const SpectralStudy& study, const std::string& what) { return meshfolio::id_of("q4", study.name(), what); }
/// Converts a length to % of the box diagonal by multiplication.
inline double percent_of(const SpectralStudy& study) { return 100 / study.diagonal; }
/// "1.23 %" of the box diagonal.
inline std::string percent_of_box(const SpectralStudy& study, double length, int digits = 2) {
    return readable_percent(length / study.diagonal, digits);
}

/// The original and the reconstructions that are told.
void add_reconstruction_figure(Answer& answer, const SpectralStudy& study);
/// Shows the reconstructions that the first figure leaves out, if there are any.
void add_further_figure(Answer& answer, const SpectralStudy& study);
/// The modes that are drawn, with their nodal lines, from one view.
void add_eigenfunction_figure(Answer& answer, const SpectralStudy& study);

/// Does a larger k give better reconstructions? In one sentence.
report::Text answer_in_short(const std::vector<Subject>& subjects);
report::Text lead(const std::vector<Subject>& subjects);
/// Which solver was run, and how it is known that no mode is missing.
report::Text solvers(const std::vector<Subject>& subjects);
// The paragraphs of the discussion; empty where there is nothing to say.
report::Text what_is_seen(const Subject& subject);
report::Text better_or_not(const SpectralStudy& study);
report::Text how_fast(const SpectralStudy& study);
report::Text what_modes_look_like(const SpectralStudy& study);
report::Text thin_parts(const SpectralStudy& study, const LimbStudy& limbs);
report::Text the_large_k(const Subject& subject);

}   // namespace meshfolio::q4_spectral
