#include "questions/bench/lab_offer.h"

#include <charconv>

#include "questions/bench/smoothing_study.h"
#include "questions/bench/spectral_study.h"

namespace meshfolio {

LabSetting coarse_projection(const QuestionSettings& settings, const LabScale& scale) {
    return {"projection", 0, nearest(mode_counts(settings, scale.modes), 15)};
}

std::vector<double> lab_steps(const QuestionSettings& settings, const std::vector<double>& own_steps, const LabScale& scale) {
    std::vector<double> multiples = steps_of(settings, scale.critical, own_steps);
    for (double& step : multiples) {
        std::array<char, 32> text{};   // without the rounding of the division, so that the page's field is read at a glance
        const auto end = std::to_chars(text.data(), text.data() + text.size(), step / scale.critical, std::chars_format::general, 10).ptr;
        std::from_chars(text.data(), end, step);
    }
    return multiples;
}

}   // namespace meshfolio
