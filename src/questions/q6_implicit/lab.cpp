// The panel of question 6 in the live laboratory: implicit steps, beside explicit ones and the exact flow.
#include "questions/bench/lab_offer.h"
#include "questions/q6_implicit/parts.h"

namespace meshfolio::q6_implicit {

const LabOffer lab{
    .role = "fandisk_ns",
    .presets =
        [](const std::vector<BestDenoising>&) {
            return std::vector<LabPreset>{{words.line("preset.moderate"), {"implicit", 2, 1}},
                                          {words.line("preset.explicit"), {"explicit", 2, 6}},
                                          {words.line("preset.large"), {"implicit", 100, 1}},
                                          {words.line("preset.heat"), {"heat", 100, 1}}};
        },
    .reported =
        [](const QuestionSettings& settings, const LabScale& scale, const std::vector<BestDenoising>&) {
            std::vector<LabSetting> all;
            for (const double lambda : lab_steps(settings, own_steps, scale))
                for (const int t : iterations_of(settings)) {
                    all.push_back({"implicit", lambda, t});
                    if (lambda <= 1) all.push_back({"explicit", lambda, t});   // beyond, it blows up
                }
            return all;
        },
    .start =
        [](const QuestionSettings& settings, const LabScale& scale, const std::vector<BestDenoising>&) {
            return LabSetting{"implicit", nearest(lab_steps(settings, own_steps, scale), 5.0), nearest(iterations_of(settings), 10)};
        },
};

}   // namespace meshfolio::q6_implicit
