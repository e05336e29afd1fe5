#include "run/lab/lab_presets.h"

#include <array>
#include <charconv>

namespace meshfolio::run {

namespace {

/// So that the page's field is read at a glance.
double to_four_digits(double x) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), x, std::chars_format::general, 4).ptr;
    std::from_chars(text.data(), end, x);
    return x;
}

}   // namespace

const std::vector<LabPreset>& lab_presets() {
    static const std::vector<LabPreset> presets{
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
        {"q7", "noisy: σ = 1 %", {"explicit", 0.25, 0, 0.01}},
        {"q7", "best t for this noise", {"explicit", 0.25, best_count, 0.01}},
        {"q7", "too long", {"explicit", 0.25, 200, 0.01}},
        {"q7", "drift: what cannot come back", {"explicit", 0.25, best_count, 0.01}, true},
    };
    return presets;
}

LabSetting start_of(const std::string& question, const QuestionSettings& settings, double critical) {
    LabSetting start{"projection", 0.5, 15};
    if (question == "q5") start = {"explicit", 0.5, 10};
    if (question == "q6") start = {"implicit", 2, 1};
    if (question == "q7") start = {"explicit", 0.25, 5, 0.01};
    const std::vector<int>& counts = start.scheme == "projection" ? settings.k : settings.iterations;
    if (!counts.empty()) start.count = counts.front();
    if (!settings.lambda.empty()) start.lambda = to_four_digits(settings.lambda.front() / critical);
    if (!settings.noise.empty()) start.sigma = settings.noise.front();
    start.seed = settings.seed;
    return start;
}

}   // namespace meshfolio::run
