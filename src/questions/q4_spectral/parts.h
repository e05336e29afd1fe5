/// @file
/// The parts of question 4.
#pragma once

#include "geometry/measures/hausdorff.h"
#include "questions/bench/spectral_uses.h"

namespace meshfolio::q4_spectral {

inline constexpr report::Words words("q4");
extern const LabOffer lab;

/// Errors below this share of the box diagonal are rounding and count as 0.
inline constexpr double rounding = 1e-9;
/// Likewise: errors whose smallest k is marked.
inline constexpr std::array target_shares{0.1, 0.01, 0.001};

/// One mesh: its reconstructions, and why its thin parts suffer.
struct Subject {
    SpectralStudy study;
    LimbStudy limbs;
    std::vector<HausdorffDistance> hausdorff = {};   // one a reconstruction
    bool chosen_k = true;                            // by the question, not by the settings

    const std::string& name() const { return study.name(); }
};
using Subjects = std::vector<Subject>;
Subject subject_of(SharedMesh mesh, const QuestionSettings& settings);

/// The reconstructions that the answer is about: the first two k, the largest that leaves an error, and the largest.
std::vector<const Reconstruction*> told_reconstructions(const SpectralStudy& study);
/// The modes that are drawn, counted from 1: the first that is not constant on every component, and the last ones of k = 5, 15 and 60.
std::vector<int> drawn_modes(const SpectralStudy& study);
/// The share of the area that is off by more than seen_error.
double share_seen(const SpectralStudy& study, const Reconstruction& r);
bool is_exact(const SpectralStudy& study, int k);
/// The largest k that leaves an error; null: all are exact.
const Reconstruction* last_erring(const SpectralStudy& study);
/// How far the eigenvalues are from Weyl's law at most, relative: over the upper half of the modes that the mesh resolves with four mean
/// edges a wave. NaN where fewer than ten are left.
double distance_from_weyl(const SpectralStudy& study);

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

report::Table error_table(const Subject& subject);
/// The error for every k, with the coefficients that it is made of.
report::Plot error_plot(const SpectralStudy& study);
/// The eigenvalues beside Weyl's law.
report::Plot spectrum_plot(const SpectralStudy& study);
report::Table limb_table(const SpectralStudy& study, const LimbStudy& limbs);

/// What the words say of one of the meshes. What holds for all is told with the first.
report::Facts facts_of(const Subjects& subjects, std::size_t which);

}   // namespace meshfolio::q4_spectral
