/// @file
/// Paragraphs of question 4's discussion; empty where there is nothing to say.
#pragma once

#include "questions/spectral_uses.h"
#include "report/text.h"

namespace meshfolio {

report::Text cost_of_large_k(const SpectralStudy& study, const SpectralUses& uses);
report::Text thin_parts(const SpectralStudy& study, const LimbStudy& limbs);
report::Text what_bands_do(const SpectralStudy& study, const BandStudy& bands);
report::Text low_pass_without_modes(const SpectralStudy& study, const SpectralUses& uses);
report::Text cost_of_mistakes(const SpectralStudy& study, const MistakeStudy& mistakes);

}   // namespace meshfolio
