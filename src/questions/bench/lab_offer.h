/// @file
/// The panel of a question in the live laboratory: its mesh, the settings worth a click, and those at which its report has numbers. The
/// page reads all from its data.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/mesh_topology.h"
#include "questions/bench/denoising_search.h"
#include "questions/core/settings.h"

namespace meshfolio {

/// One state of the laboratory.
struct LabSetting {
    std::string scheme = {};   // projection, explicit, implicit, taubin, heat, or denoising: implicit with the noisy mesh's own operator
    double lambda = 0;         // multiples of λ_crit, of the denoising of squared mean edges; 0 for the projection
    int count = 0;             // k of the projection, else the iterations t
    double sigma = 0;          // of the noise on every coordinate, in box diagonals
    std::uint64_t seed = 1;    // of the noise
    bool operator==(const LabSetting&) const = default;
};

/// A setting with the words of its button: "just above".
struct LabPreset {
    std::string words;
    LabSetting setting;
    bool shows_drift = false;    // lines to where the vertices belong
    std::string question = {};   // that offers it
};

/// The minima of the denoising search for each of its measures, at one level of noise.
struct BestDenoising {
    double sigma = 0;   // [box diagonals]
    std::uint64_t seed = 1;
    SearchResult found;   // λ in h̄²

    LabSetting at(const SearchState& state) const { return {"denoising", state.value, state.step, sigma, seed}; }
};

/// The mesh of a laboratory, and the units of its settings.
struct LabScale {
    double critical = 0;    // λ_crit [length²]
    int modes = 0;          // that the page has
    bool has_all = false;   // and there are no more
};

/// The panel that a chapter offers.
struct LabOffer {
    std::string_view role;   // its mesh, one of the chapter's roles
    /// Returns the buttons of the panel. @param denoised  of denoised(); empty for a panel without noise
    std::vector<LabPreset> (*presets)(const std::vector<BestDenoising>& denoised);
    /// Returns the settings at which the chapter's tables have numbers.
    std::vector<LabSetting> (*reported)(const QuestionSettings& settings, const LabScale& scale,
                                        const std::vector<BestDenoising>& denoised);
    /// Returns the setting that the panel opens with if the page has all modes.
    LabSetting (*start)(const QuestionSettings& settings, const LabScale& scale, const std::vector<BestDenoising>& denoised);
    /// Denoises the clean mesh at every level of noise and returns the best results, a level each; null for a panel without noise.
    /// @param mean_edge, diagonal  h̄ of the mesh and diagonal of its box [length]
    std::vector<BestDenoising> (*denoised)(const TriangleMesh& clean, double mean_edge, double diagonal,
                                           const QuestionSettings& settings) = nullptr;
};

/// Returns the projection onto the k of mode_counts() that is nearest to 15.
LabSetting coarse_projection(const QuestionSettings& settings, const LabScale& scale);

/// Returns the steps of the settings over λ_crit, else `own_steps`, which are multiples of λ_crit; ascending, rounded to ten digits for the
/// page.
std::vector<double> lab_steps(const QuestionSettings& settings, const std::vector<double>& own_steps, const LabScale& scale);

/// Returns the value nearest to `wish`, the first of equals. @pre there are values
template <class Number> Number nearest(const std::vector<Number>& values, Number wish) {
    return *std::ranges::min_element(values, {}, [&](Number value) { return value > wish ? value - wish : wish - value; });
}

}   // namespace meshfolio
