// The section "prediction": the error of denoising foreseen, measured, and the iteration chosen without the clean mesh.
#include "questions/prediction/parts.h"

#include <algorithm>

#include "base/number_text.h"
#include "questions/core/section_tools.h"
#include "questions/core/study_list.h"

namespace meshfolio::prediction {

namespace {

using report::math;
using report::ref;

void add_formula_words(report::Section& section) {
    add_heading(section, "Method");
    add_paragraph(section, "With a fixed operator ", math("t"), " implicit steps are one matrix ", math("Sᵗ"),
                  ", so that the error against the clean mesh has a part that the shape loses and a part of the noise that is left, whose "
                  "squares add up in the mean. In the norm of the areas all modes give both, with ",
                  math("ĉ_i = Xᵀ M φ_i"), ":");
    add_formula(section, "noise_bias_variance", "prediction_eq_mass");
    add_paragraph(section, "The plain rms of question 7 (", ref("q7"),
                  ") weighs every vertex alike. There the modes are not orthogonal, and their products count:");
    add_formula(section, "denoise_prediction_vertices", "prediction_eq_vertices");
    add_paragraph(section,
                  "Up to 1000 vertices these are all modes. Beyond, the bias is that of one run without noise, and the trace is "
                  "the mean over fixed vectors of random signs ",
                  ref("hutchinson_1990"), ":");
    add_formula(section, "hutchinson_trace");
}

void add_rule_words(report::Section& section) {
    add_paragraph(section,
                  "An operator made from the noisy mesh depends on the noise, and neither formula holds. What holds for every "
                  "way to denoise is Stein's identity ",
                  ref("stein_1981"), ":");
    add_formula(section, "stein_risk", "prediction_eq_stein");
    add_paragraph(section,
                  "The expression in brackets needs no clean mesh. The divergence is that of the run as a black box, from a second run "
                  "whose input is "
                  "moved a little by random signs ",
                  ref("ramani_2008"),
                  ", so that the operator's own change is in it. The rule is to stop where this estimate is smallest. For ", math("σ"),
                  " a quadratic height is fitted to each vertex and its two rings, ", math("m"), " points with residuals ", math("r"), "; ",
                  math("κ"), " corrects for the cut:");
    add_formula(section, "noise_from_residuals");
}

void add_parameters(report::Section& section, const std::vector<PredictionStudy>& studies, const QuestionSettings& settings) {
    std::vector<std::string> levels;
    for (const NoiseLevelStudy& level : studies.front().levels) levels.push_back(readable_percent(level.sigma, 2));
    section.parameters["noise"] = listed(levels) + " of the box diagonal";
    section.parameters["seeds"] = std::to_string(studies.front().seeds);
    section.parameters["seed"] = std::to_string(settings.seed);
    for (const PredictionStudy& study : studies) {
        const double unit = study.diagonal;
        section.parameters["λ on " + study.name()] = plain_text(study.lambda * unit * unit, 6);
    }
}

void add_finding(report::Section& section, const std::vector<PredictionStudy>& studies) {
    double off = 0, regret = -1;
    std::size_t levels = 0;
    for (const PredictionStudy& study : studies) {
        levels += study.levels.size();
        for (const NoiseLevelStudy& level : study.levels) {
            const OperatorStudy& clean = level.of(FlowOperator::clean);
            off = std::max(off, deviation(clean.formula(), clean.measured));
            const OperatorStudy& own = level.of(FlowOperator::noisy);
            const RuleOutcome* rule = own.rule(by_stein_estimated);
            if (rule != nullptr && own.minimum_reached()) regret = std::max(regret, rule->mean_regret());
        }
    }
    report::Text t =
        report::text("The error of denoising with the clean operator was computed before any noise: ", readable_percent(off, 2),
                     " at most from the mean of ", counted(studies.front().seeds, "noisy mesh", "noisy meshes"), " in ",
                     counted(static_cast<int>(levels), "case"), ".");
    if (regret >= 0)
        report::extend(t, " A rule that sees the noisy mesh alone picks an iteration whose error is at most ", readable_percent(regret, 2),
                       " above the smallest, in the mean.");
    section.findings.push_back({std::move(t), 77});
}

}   // namespace

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer;
    report::Section& section = answer.section;
    section = section_of("prediction");
    LibraryMeshes meshes;
    if (settings.laboratory) {
        meshes = meshes_for(library, settings, {"cube", "lilium", "torus", "armadillo"}, section);
    } else if (settings.quick) {
        meshes = meshes_for(library, settings, {"cube"}, section);
    } else {
        meshes = meshes_for(library, settings, {"cube", "lilium"}, section);
    }
    add_formula_words(section);
    add_rule_words(section);

    add_heading(section, "Results");
    const auto studies = studies_of(meshes, "predicted denoising", settings, progress, section, prediction_study);
    section.blocks.emplace_back(clean_prediction_table(studies));
    for (const PredictionStudy& study : studies) section.blocks.emplace_back(clean_prediction_plot(study));
    section.blocks.emplace_back(operator_prediction_table(studies));
    for (const PredictionStudy& study : studies) {
        section.blocks.emplace_back(operator_prediction_plot(study, FlowOperator::noisy));
        if (settings.laboratory) section.blocks.emplace_back(operator_prediction_plot(study, FlowOperator::rebuilt));
    }
    section.blocks.emplace_back(why_table(studies));
    section.blocks.emplace_back(rule_table(studies));
    add_discussion(section, studies);
    append_checks(section, prediction_checks(studies));
    add_parameters(section, studies, settings);
    section.extent = "expected error and best iteration on " + listed(names_of(studies)) + " beside the mean of " +
                     counted(studies.front().seeds, "seed") +
                     ", with three operators; a rule that stops without the clean mesh, and its regret";
    add_finding(section, studies);
    return answer;
}

extern const Chapter chapter{
    .id = "prediction",
    .code = {{"denoising_prediction", "src/geometry/denoising/denoising_prediction.cpp"},
             {"noise_level", "src/geometry/denoising/noise_level.cpp"},
             {"risk_estimate", "src/geometry/denoising/risk_estimate.cpp"},
             {"denoising_run", "src/questions/prediction/runs.cpp"},
             {"answer", "src/questions/prediction/chapter.cpp"}},
    .answer = answer,
};

}   // namespace meshfolio::prediction
