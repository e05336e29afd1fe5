/// @file
/// Tables, plots, figures and checks of question 4 about the uses of the modes.
#pragma once

#include <string>
#include <vector>

#include "questions/bench/spectral_uses.h"
#include "questions/core/chapter.h"

namespace meshfolio::q4_spectral {

/// The smallest k for 10 %, 1 % and 0.1 % of the box diagonal, predicted and measured. Nothing where none is reached.
void add_threshold_table(report::Section& section, const SpectralStudy& study);
void add_cost_table(report::Section& section, const SpectralStudy& study, const SpectralUses& uses);
void add_limb_table(report::Section& section, const SpectralStudy& study, const LimbStudy& limbs);
void add_low_pass_blocks(report::Section& section, const SpectralStudy& study, const LowPassStudy& low_pass);
void add_band_table(report::Section& section, const SpectralStudy& study, const BandStudy& bands);
void add_mistake_table(report::Section& section, const SpectralStudy& study, const MistakeStudy& mistakes);

/// φ₁ … with their nodal lines, from one view.
void add_eigenfunction_gallery(Answer& answer, const SpectralStudy& study, bool quick);
void add_band_figure(Answer& answer, const SpectralStudy& study, const BandStudy& bands, const std::string& colormap);
void add_mistake_figure(Answer& answer, const SpectralStudy& study, const MistakeStudy& mistakes, const std::string& colormap);

/// What the numbers say. Appends its heading and its paragraphs.
/// @param uses  one for each study
void add_discussion(report::Section& section, const std::vector<SpectralStudy>& studies, const std::vector<SpectralUses>& uses);
// Its paragraphs; empty where there is nothing to say.
report::Text cost_of_large_k(const SpectralStudy& study, const SpectralUses& uses);
report::Text thin_parts(const SpectralStudy& study, const LimbStudy& limbs);
report::Text what_bands_do(const SpectralStudy& study, const BandStudy& bands);
report::Text low_pass_without_modes(const SpectralStudy& study, const SpectralUses& uses);
report::Text cost_of_mistakes(const SpectralStudy& study, const MistakeStudy& mistakes);

std::vector<report::Check> spectral_use_checks(const SpectralStudy& study, const SpectralUses& uses);

}   // namespace meshfolio::q4_spectral
