/// @file
/// One mesh of question 4: its reconstructions, and their figures, tables and plots.
#pragma once

#include "questions/bench/spectral_study.h"
#include "questions/q4_spectral/parts.h"

namespace meshfolio::q4_spectral {

/// Errors below this share of the box diagonal are rounding and count as 0.
inline constexpr double rounding = 1e-9;

/// One mesh: its reconstructions, and the errors of its thin and thick parts.
struct Subject {
    SpectralStudy study;
    LimbStudy limbs = {};
    std::vector<double> hausdorff = {};   // distance to each reconstruction [length]
    bool hausdorff_falls = false;         // for no k certainly above that of the k before
    bool chosen_k = true;                 // by the question, not by the settings

    const std::string& name() const { return study.name(); }
};
/// Rebuilds one mesh from the k of mode_counts() and measures the errors, also on thin and thick parts.
Subject subject_of(SharedMesh mesh, const QuestionSettings& settings);

/// True for the reconstructions of the first two k, of the largest k that leaves an error, and of the largest k: the results show them.
bool is_shown(const SpectralStudy& study, const Reconstruction& r);
/// Returns the modes to draw, counted from 1 and ascending: the first that is not constant on every component, and of the 5th, 15th and
/// 60th those after it that are computed.
std::vector<int> drawn_modes(const SpectralStudy& study);
/// Returns the share of the area with vertices that are off by more than seen_error of the box diagonal.
double share_seen(const SpectralStudy& study, const Reconstruction& r);
/// True if the predicted error of k modes is below `rounding` of the box diagonal.
bool is_exact(const SpectralStudy& study, int k);
/// Returns the reconstruction of the largest k that leaves an error; null if all are exact.
const Reconstruction* last_erring(const SpectralStudy& study);
/// Returns the largest relative distance of the eigenvalues from Weyl's law, over the upper half of the modes that the mesh resolves with
/// four mean edges a wave; NaN if it resolves fewer than 20.
double distance_from_weyl(const SpectralStudy& study);

/// Returns the id of a figure or file of one mesh: "q4_creature_errors".
inline std::string id_of(const SpectralStudy& study, const std::string& what) { return meshfolio::id_of("q4", study.name(), what); }
/// Returns the factor from a length to % of the box diagonal.
inline double percent_of(const SpectralStudy& study) { return 100 / study.diagonal; }
/// Returns a length in % of the box diagonal as text: "1.23 %".
inline std::string percent_of_box(const SpectralStudy& study, double length, int digits = 2) {
    return readable_percent(length / study.diagonal, digits);
}

/// Adds a figure of the original and of the reconstructions that are is_shown(), coloured by their distance in % of the box diagonal.
void add_reconstruction_figure(Answer& answer, const SpectralStudy& study);
/// Adds a figure of drawn_modes() with their nodal lines, from one view.
void add_eigenfunction_figure(Answer& answer, const SpectralStudy& study);

/// Returns a table of the errors of each reconstruction, a row for each k: rms, maximum, Hausdorff, normals, volume, …
report::Table error_table(const Subject& subject);
/// Plots over k the predicted and measured error, the coefficient of each mode, and the power law fitted to the error, in % of the box.
report::Plot error_plot(const SpectralStudy& study);
/// Plots the eigenvalues above 0 and Weyl's law over k.
report::Plot spectrum_plot(const SpectralStudy& study);
/// Returns a table of the errors on thin and thick parts, a row for each k.
report::Table limb_table(const SpectralStudy& study, const LimbStudy& limbs);

}   // namespace meshfolio::q4_spectral
