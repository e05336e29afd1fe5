/// @file
/// Tables, plots, figures and checks of question 4 about the uses of the modes.
#pragma once

#include <string>
#include <vector>

#include "questions/question.h"
#include "questions/spectral_uses.h"

namespace meshfolio {

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

std::vector<report::Check> spectral_use_checks(const SpectralStudy& study, const SpectralUses& uses);

}   // namespace meshfolio
