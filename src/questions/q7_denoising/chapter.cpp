// Question 7: what Laplacian smoothing can do against noise, measured against the clean mesh.
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "questions/core/study_list.h"
#include "questions/q7_denoising/parts.h"

namespace meshfolio::q7_denoising {

namespace {

using report::check_at_most;
using report::check_near;

void add_checks(report::Section& section, const DenoisingGrid& grid) {
    const report::Fact mesh = "mesh"_a = grid.name();
    const double n = grid.clean->mesh().vertex_count();
    for (const NoisyTrial& trial : grid.trials) {
        // rms of 3n normal numbers has relative standard deviation 1/√(6n); five of them.
        section.checks.push_back(check_near(words.line("check.noise", "percent"_a = plain_text(100 * trial.relative, 3), mesh), 1,
                                            trial.found.noisy.rms / (std::sqrt(3.0) * trial.sigma), 5 / std::sqrt(6 * n)));
        // The nearest point of the surface is no farther than the vertex's own place.
        section.checks.push_back(check_at_most(words.line("check.surface", "percent"_a = plain_text(100 * trial.relative, 3), mesh), 1,
                                               trial.found.by_rms.shape / trial.found.by_rms.rms, 1e-12));
    }
}

/// Where smoothing gains most, and where least, by the distance to the surface.
report::Text best_and_worst(const Grids& grids, const std::vector<std::string>& levels) {
    const std::vector<Case> cases = cases_of(grids);
    const auto gain = [](const Case& c) { return std::fmax(1, c.part.gain(measures[0])); };   // 1 where the noise changes no shape
    const auto best = std::ranges::max_element(cases, {}, gain), worst = std::ranges::min_element(cases, {}, gain);
    if (gain(*best) <= 1) return words.say("finding.none", "low"_a = levels.front(), "high"_a = levels.back());
    report::Facts facts = facts_of(best->whole, best->part);
    facts.push_back(
        "worst"_a =
            best == worst ? "" : words.line(gain(*worst) > 1 ? "finding.less" : "finding.no_gain", facts_of(worst->whole, worst->part)));
    return words.say("finding", facts);
}

}   // namespace

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer;
    report::Section& section = answer.section;
    section = section_of("q7");
    const auto meshes = meshes_for(library, settings, {"cube", "fandisk", "armadillo"}, section);
    add_words(section, words, "method");

    add_words(section, words, "results");
    const auto grids = studies_of(meshes, "denoising", settings, progress, section, denoising_grid);
    add(section, result_table(grids));
    for (const DenoisingGrid& grid : grids) {
        add(section, gain_map(grid));
        add(section, error_plot(grid));
        for (std::size_t i = grid.trials.size() > 2 ? 1 : 0; i < grid.trials.size(); ++i) add_trial_figure(answer, grid, grid.trials[i]);
        add_before_after(answer, grid, settings.colormap);
        add_checks(section, grid);
    }
    add_discussion(section, grids);

    std::vector<std::string> levels, steps;
    for (const NoisyTrial& trial : grids.front().trials) levels.push_back(readable_percent(trial.relative, 2));
    for (const double lambda : grids.front().lambdas) steps.push_back(readable(lambda, 3));
    section.parameters["noise"] = words.line("parameter.noise", "levels"_a = listed(levels));
    section.parameters["λ"] = words.line("parameter.lambda", "steps"_a = listed(steps));
    section.parameters["iterations"] = words.line("parameter.iterations", "last"_a = grids.front().iterations);
    section.parameters["seed"] = std::to_string(settings.seed);
    section.extent = words.line("extent", "levels"_a = listed(levels), "steps"_a = steps.size(), "iterations"_a = grids.front().iterations,
                                "meshes"_a = listed(names_of(grids)));
    section.findings.push_back({best_and_worst(grids, levels), 78});
    return answer;
}

extern const Chapter chapter{
    .id = "q7",
    .code = {{"with_gaussian_noise", "src/mesh/vertex_noise.cpp"},
             {"smooth", "src/geometry/smoothing/laplacian_smoothing.cpp"},
             {"search", "src/questions/bench/denoising_search.cpp"},
             {"shape_rms", "src/geometry/measures/mesh_error.cpp"},
             {"answer", "src/questions/q7_denoising/chapter.cpp"}},
    .answer = answer,
};

}   // namespace meshfolio::q7_denoising
