// Question 7: what Laplacian smoothing can do against noise, measured against the clean mesh.
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "questions/core/study_list.h"
#include "questions/core/value_lists.h"
#include "questions/q7_denoising/parts.h"

namespace meshfolio::q7_denoising {

namespace {

using report::check_at_most;
using report::check_near;

void add_checks(report::Section& section, const DenoisingStudy& study) {
    const report::Fact mesh = "mesh"_a = study.name();
    const double n = study.clean->mesh().vertex_count();
    const std::vector<double> backwards(study.without_noise.rbegin(), study.without_noise.rend());
    section.checks.push_back(check_at_most(words.line("check.without_noise", mesh), 0, largest_rise(backwards) / study.diagonal, 1e-12));
    for (const DenoisingTrial& trial : study.trials) {
        // rms of 3n normal numbers has relative standard deviation 1/√(6n); five of them.
        section.checks.push_back(check_near(words.line("check.noise", "percent"_a = plain_text(100 * trial.relative, 3), mesh), 1,
                                            trial.rms.front() / (std::sqrt(3.0) * trial.sigma), 5 / std::sqrt(6 * n)));
    }
}

/// Where smoothing gains most, and where least.
report::Text best_and_worst(const Studies& studies, const std::vector<std::string>& levels) {
    const std::vector<Case> cases = cases_of(studies);
    const auto gain = [](const Case& c) { return c.part.gain(); };
    const auto best = std::ranges::max_element(cases, {}, gain), worst = std::ranges::min_element(cases, {}, gain);
    if (best->part.best_rms == 0) return words.say("finding.none", "low"_a = levels.front(), "high"_a = levels.back());
    const char* key = worst->part.best_rms == 0 ? "finding.harms" : gain(*worst) < 1.05 ? "finding.hardly" : "finding.less";
    report::Facts facts = facts_of(best->whole, best->part);
    facts.push_back("worst"_a = best == worst ? "" : words.line(key, facts_of(worst->whole, worst->part)));
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
    const auto studies = studies_of(meshes, "denoising", settings, progress, section, denoising_study);
    add(section, result_table(studies));
    for (const DenoisingStudy& study : studies) {
        add(section, error_plot(study));
        for (std::size_t i = study.trials.size() > 2 ? 1 : 0; i < study.trials.size(); ++i)
            add_trial_figure(answer, study, study.trials[i]);
        add_before_after(answer, study, settings.colormap);
        add_checks(section, study);
        section.parameters[words.line("parameter.lambda", "mesh"_a = study.name())] = plain_text(study.lambda, 6);
    }
    add_discussion(section, studies);

    std::vector<std::string> levels;
    for (const DenoisingTrial& trial : studies.front().trials) levels.push_back(readable_percent(trial.relative, 2));
    section.parameters["noise"] = words.line("parameter.noise", "levels"_a = listed(levels));
    section.parameters["iterations"] = length_of_runs(studies.front());
    section.parameters["seed"] = std::to_string(settings.seed);
    section.extent = words.line("extent", "levels"_a = listed(levels), "meshes"_a = listed(names_of(studies)));
    section.findings.push_back({best_and_worst(studies, levels), 78});
    return answer;
}

extern const Chapter chapter{
    .id = "q7",
    .code = {{"with_gaussian_noise", "src/mesh/vertex_noise.cpp"},
             {"smooth", "src/geometry/smoothing/laplacian_smoothing.cpp"},
             {"vertex_rms", "src/geometry/measures/mesh_error.cpp"},
             {"answer", "src/questions/q7_denoising/chapter.cpp"}},
    .answer = answer,
};

}   // namespace meshfolio::q7_denoising
