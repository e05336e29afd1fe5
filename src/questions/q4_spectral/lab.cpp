// The panel of question 4 in the live laboratory: projections onto the lowest modes.
#include "questions/bench/lab_offer.h"
#include "questions/bench/spectral_study.h"
#include "questions/q4_spectral/parts.h"

namespace meshfolio::q4_spectral {

const LabOffer lab{
    .role = "armadillo",
    .presets =
        [](const std::vector<BestDenoising>&) {
            return std::vector<LabPreset>{
                {"k = 5", {"projection", 0, 5}}, {"k = 15", {"projection", 0, 15}}, {"k = 30", {"projection", 0, 30}}};
        },
    .reported =
        [](const QuestionSettings& settings, const LabScale& scale, const std::vector<BestDenoising>&) {
            std::vector<LabSetting> all;
            for (const int k : mode_counts(settings, scale.modes)) all.push_back({"projection", 0, k});
            return all;
        },
    .start = [](const QuestionSettings& settings, const LabScale& scale,
                const std::vector<BestDenoising>&) { return coarse_projection(settings, scale); },
};

}   // namespace meshfolio::q4_spectral
