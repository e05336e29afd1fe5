/// @file
/// What a run may vary. Defaults are those of data/report.toml.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace meshfolio {

/// The settings of one question; empty lists mean the question's own choice.
struct QuestionSettings {
    std::vector<std::string> meshes;   // paths as in the settings file; empty: the question's roles
    std::filesystem::path base;        // folder of the settings file
    std::vector<int> k;                // modes (q4)
    std::vector<double> lambda;        // raw steps [length²]
    std::vector<int> iterations;
    std::vector<double> noise;   // σ as a fraction of the bounding-box diagonal (q7)
    std::uint64_t seed = 1;
    bool quick = false;                 // small settings for a first look
    std::string colormap = "viridis";   // for unsigned quantities
};

}   // namespace meshfolio
