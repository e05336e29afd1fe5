/// @file
/// What the laboratory offers: settings worth a click, what the panel of each question opens with, and those at which its report has
/// numbers. The page reads all from its data.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "questions/q7_denoising/study.h"

namespace meshfolio::run {

/// One state of the laboratory.
struct LabSetting {
    std::string scheme = {};   // projection, explicit, implicit, taubin, heat, or denoising: implicit with the noisy mesh's own operator
    double lambda = 0;         // multiples of λ_crit, of the denoising of squared mean edges; 0 for the projection
    int count = 0;             // k of the projection, else the iterations t
    double sigma = 0;          // of the noise on every coordinate, in box diagonals
    std::uint64_t seed = 1;    // of the noise
    bool operator==(const LabSetting&) const = default;
};

struct LabPreset {
    std::string question, words;   // "q5", "just above"
    LabSetting setting;
    bool shows_drift = false;   // lines to where the vertices belong
};

/// The minima of question 7 for each of its measures, at one level of noise.
struct BestDenoising {
    double sigma = 0;   // [box diagonals]
    std::uint64_t seed = 1;
    SearchResult found;   // λ in h̄²

    LabSetting at(const SearchState& state) const { return {"denoising", state.value, state.step, sigma, seed}; }
};

/// The units of the settings of a mesh.
struct LabScale {
    double critical = 0;    // λ_crit [length²]
    int modes = 0;          // that the page has
    bool has_all = false;   // and there are no more
};

/// Settings at which the report of that question has numbers: those of its tables.
std::vector<LabSetting> reported(const std::string& question, const QuestionSettings& settings, const LabScale& scale,
                                 const std::vector<BestDenoising>& denoised);
/// The setting that the panel opens with.
LabSetting start_of(const std::string& question, const QuestionSettings& settings, const LabScale& scale,
                    const std::vector<BestDenoising>& denoised);
/// The presets of the questions that have this mesh, as far as its modes allow.
std::vector<LabPreset> presets_for(const std::map<std::string, QuestionSettings>& questions, const LabScale& scale,
                                   const std::vector<BestDenoising>& denoised);

/// The noise to show: 1 % of the box, else the settings' lowest. Null: none has been tried.
const BestDenoising* shown_noise(const std::vector<BestDenoising>& denoised);

}   // namespace meshfolio::run
