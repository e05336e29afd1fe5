/// @file
/// What the laboratory offers: settings worth a click, and what the panel of each question opens with. The page reads both from its data.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "questions/core/settings.h"

namespace meshfolio::run {

/// One state of the laboratory.
struct LabSetting {
    std::string scheme;       // projection, explicit, implicit, taubin or heat
    double lambda = 0;        // multiples of λ_crit; 0 for the projection
    int count = 0;            // k of the projection, else the iterations t
    double sigma = 0;         // of the noise on every coordinate, in box diagonals
    std::uint64_t seed = 1;   // of the noise
};

/// In place of iterations: as many as come nearest to the clean mesh.
inline constexpr int best_count = -1;

struct LabPreset {
    std::string question, words;   // "q5", "just above"
    LabSetting setting;
    bool shows_drift = false;   // lines to where the vertices belong
};

const std::vector<LabPreset>& lab_presets();

/// The first value of each of the user's own settings, else the question's choice. Raw steps are taken in multiples of `critical`
/// [length²], the λ_crit of the mesh in the laboratory, to four digits.
LabSetting start_of(const std::string& question, const QuestionSettings& settings, double critical);

}   // namespace meshfolio::run
