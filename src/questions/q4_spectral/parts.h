/// @file
/// The parts of question 4.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "base/number_text.h"
#include "geometry/linear/special_values.h"
#include "questions/bench/spectral_uses.h"
#include "questions/core/chapter.h"
#include "questions/core/study_list.h"

namespace meshfolio::q4_spectral {

inline constexpr report::Words words("q4");

/// Of the box diagonal: errors whose smallest k is told.
inline constexpr std::array target_shares{0.1, 0.01, 0.001};

/// A target that is reached.
struct Threshold {
    double share = 0;          // of the box diagonal
    int k = 0;                 // the smallest
    double measured_rms = 0;   // area-weighted, of the mesh rebuilt with that k [length]
};
std::vector<Threshold> thresholds_of(const SpectralStudy& study);

inline std::string id_of(const SpectralStudy& study, const std::string& what) { return meshfolio::id_of("q4", study.name(), what); }
/// Of a length, times this: in % of the box diagonal.
inline double percent_of(const SpectralStudy& study) { return 100 / study.diagonal; }
/// "1.23 %" of the box diagonal.
inline std::string percent_of_box(const SpectralStudy& study, double length, int digits = 3) {
    return readable_percent(length / study.diagonal, digits);
}
/// @param mode  counted from 1
inline double wavelength(const SpectralStudy& study, int mode) { return 2 * pi / std::sqrt(study.spectrum.eigenvalues[mode - 1]); }

// Tables and plots.
report::Table error_table(const SpectralStudy& study);
report::Plot error_plot(const SpectralStudy& study);
report::Table threshold_table(const SpectralStudy& study, const std::vector<Threshold>& thresholds);
report::Table eigenvalue_table(const SpectralStudy& study);
report::Table limb_table(const SpectralStudy& study, const LimbStudy& limbs);
report::Table cost_table(const SpectralStudy& study, double factor_entries);
report::Table band_table(const SpectralStudy& study, const BandStudy& bands);
report::Table filter_table(const SpectralStudy& study, const BandStudy& bands);
report::Table low_pass_table(const SpectralStudy& study, const LowPassStudy& low_pass);
report::Plot low_pass_plot(const SpectralStudy& study, const LowPassStudy& low_pass);
report::Table mistake_table(const SpectralStudy& study, const MistakeStudy& mistakes);

// Figures.
void add_reconstruction_figure(Answer& answer, const SpectralStudy& study);
/// The original against the reconstruction in the middle: coarser ones are blobs, finer ones show nothing.
void add_before_after(Answer& answer, const SpectralStudy& study, const std::string& colormap);
/// φ₁ … with their nodal lines, from one view.
void add_eigenfunction_gallery(Answer& answer, const SpectralStudy& study, bool quick);
void add_band_figure(Answer& answer, const SpectralStudy& study, const BandStudy& bands, const std::string& colormap);
void add_mistake_figure(Answer& answer, const SpectralStudy& study, const MistakeStudy& mistakes, const std::string& colormap);

/// What the numbers say.
/// @param uses  one for each study
void add_discussion(report::Section& section, const std::vector<SpectralStudy>& studies, const std::vector<SpectralUses>& uses);
// Its paragraphs about the uses; empty where there is nothing to say.
report::Text cost_of_large_k(const SpectralStudy& study, const SpectralUses& uses);
report::Text thin_parts(const SpectralStudy& study, const LimbStudy& limbs);
report::Text what_bands_do(const SpectralStudy& study, const BandStudy& bands);
report::Text low_pass_without_modes(const SpectralStudy& study, const SpectralUses& uses);
report::Text cost_of_mistakes(const SpectralStudy& study, const MistakeStudy& mistakes);

}   // namespace meshfolio::q4_spectral
