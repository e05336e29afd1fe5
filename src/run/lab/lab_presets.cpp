#include "run/lab/lab_presets.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "questions/bench/spectral_study.h"
#include "questions/q5_explicit/study.h"
#include "questions/q6_implicit/study.h"

namespace meshfolio::run {

namespace {

const std::vector<LabPreset> fixed_presets{
    {"q4", "k = 5", {"projection", 0, 5}},
    {"q4", "k = 15", {"projection", 0, 15}},
    {"q4", "k = 30", {"projection", 0, 30}},
    {"q5", "just below λ_crit", {"explicit", 0.99, 40}},
    {"q5", "just above", {"explicit", 1.05, 40}},
    {"q5", "twice λ_crit", {"explicit", 2, 5}},
    {"q5", "Taubin: smooth, keep the volume", {"taubin", 0.5, 20}},
    {"q6", "moderate", {"implicit", 2, 1}},
    {"q6", "explicit at the same λ", {"explicit", 2, 6}},
    {"q6", "implicit at 100 λ_crit", {"implicit", 100, 1}},
    {"q6", "exact heat flow for that time", {"heat", 100, 1}},
};

/// A multiple of λ_crit without the rounding of the division, so that the page's field is read at a glance.
double to_ten_digits(double x) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), x, std::chars_format::general, 10).ptr;
    std::from_chars(text.data(), end, x);
    return x;
}

std::vector<double> multiples_of(const QuestionSettings& settings, const std::vector<double>& own_steps, double critical) {
    std::vector<double> multiples = steps_of(settings, critical, own_steps);
    for (double& step : multiples) step = to_ten_digits(step / critical);
    return multiples;
}

/// The value nearest to `wish`, on a logarithmic scale or not.
template <class Number>
Number nearest(const std::vector<Number>& values, Number wish) {
    return *std::ranges::min_element(values, {}, [&](Number value) { return value > wish ? value - wish : wish - value; });
}

bool can_be_set(const LabSetting& setting, const LabScale& scale) {
    return setting.scheme == "projection" ? setting.count <= scale.modes : scale.has_all;
}

}   // namespace

const BestDenoising* shown_noise(const std::vector<BestDenoising>& denoised) {
    const auto one_percent = std::ranges::find(denoised, 0.01, &BestDenoising::sigma);
    return one_percent != denoised.end() ? &*one_percent : denoised.empty() ? nullptr : &denoised.front();
}

std::vector<LabSetting> reported(const std::string& question, const QuestionSettings& settings, const LabScale& scale,
                                 const std::vector<BestDenoising>& denoised) {
    std::vector<LabSetting> all;
    if (question == "q4")
        for (const int k : mode_counts(settings, scale.modes)) all.push_back({"projection", 0, k});
    if (question == "q5")
        for (const double lambda : multiples_of(settings, q5_explicit::own_steps, scale.critical))
            all.push_back({"explicit", lambda, q5_explicit::iterations_of(settings)});
    if (question == "q6") {
        for (const double lambda : multiples_of(settings, q6_implicit::own_steps, scale.critical))
            for (const int t : q6_implicit::iterations_of(settings)) {
                all.push_back({"implicit", lambda, t});
                if (lambda <= 1) all.push_back({"explicit", lambda, t});   // beyond, it blows up
            }
    }
    if (question == "q7")
        for (const BestDenoising& best : denoised)
            for (const Measure& measure : measures) all.push_back(best.at(best.found.*measure.best));
    std::erase_if(all, [&](const LabSetting& setting) { return !can_be_set(setting, scale); });
    return all;
}

LabSetting start_of(const std::string& question, const QuestionSettings& settings, const LabScale& scale,
                    const std::vector<BestDenoising>& denoised) {
    const LabSetting coarse{"projection", 0, nearest(mode_counts(settings, scale.modes), 15)};
    if (!scale.has_all) return coarse;
    if (question == "q5")
        return {"explicit", nearest(multiples_of(settings, q5_explicit::own_steps, scale.critical), 0.5),
                q5_explicit::iterations_of(settings)};
    if (question == "q6")
        return {"implicit", nearest(multiples_of(settings, q6_implicit::own_steps, scale.critical), 5.0),
                nearest(q6_implicit::iterations_of(settings), 10)};
    const BestDenoising* noise = shown_noise(denoised);
    return question == "q7" && noise != nullptr ? noise->at(noise->found.by_shape) : coarse;
}

std::vector<LabPreset> presets_for(const std::map<std::string, QuestionSettings>& questions, const LabScale& scale,
                                   const std::vector<BestDenoising>& denoised) {
    std::vector<LabPreset> presets = fixed_presets;
    if (const BestDenoising* noise = shown_noise(denoised)) {
        const LabSetting best = noise->at(noise->found.by_shape);
        LabSetting noisy = best, longer = best;
        noisy.count = 0;
        longer.count *= 4;
        presets.push_back({"q7", "noisy", noisy});
        presets.push_back({"q7", "nearest to the surface", best});
        presets.push_back({"q7", "nearest to the vertices’ places", noise->at(noise->found.by_rms)});
        presets.push_back({"q7", "four times as long", longer});
        presets.push_back({"q7", "what is left along the surface", best, true});
    }
    std::erase_if(presets,
                  [&](const LabPreset& preset) { return !can_be_set(preset.setting, scale) || !questions.contains(preset.question); });
    return presets;
}

}   // namespace meshfolio::run
