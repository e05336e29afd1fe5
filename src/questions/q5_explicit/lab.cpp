// The panel of question 5 in the live laboratory: explicit steps on both sides of the limit.
#include "questions/bench/lab_offer.h"
#include "questions/q5_explicit/parts.h"

namespace meshfolio::q5_explicit {

const LabOffer lab{
    .role = "cube",
    .presets =
        [](const std::vector<BestDenoising>&) {
            return std::vector<LabPreset>{{words.line("preset.below"), {"explicit", 0.99, 40}},
                                          {words.line("preset.above"), {"explicit", 1.05, 40}},
                                          {words.line("preset.twice"), {"explicit", 2, 5}},
                                          {words.line("preset.taubin"), {"taubin", 0.5, 20}}};
        },
    .reported =
        [](const QuestionSettings& settings, const LabScale& scale, const std::vector<BestDenoising>&) {
            std::vector<LabSetting> all;
            for (const double lambda : lab_steps(settings, own_steps, scale)) all.push_back({"explicit", lambda, iterations_of(settings)});
            return all;
        },
    .start =
        [](const QuestionSettings& settings, const LabScale& scale, const std::vector<BestDenoising>&) {
            return LabSetting{"explicit", nearest(lab_steps(settings, own_steps, scale), 0.5), iterations_of(settings)};
        },
};

}   // namespace meshfolio::q5_explicit
