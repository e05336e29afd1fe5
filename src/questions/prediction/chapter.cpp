// Predicted denoising: the error foreseen, measured, and the iteration chosen without the clean mesh.
#include "questions/prediction/parts.h"

namespace meshfolio::prediction {

namespace {

void add_checks(report::Section& section, const Studies& studies) {
    constexpr double far = 5, wrong = 1.5;
    for (const auto& [study, level] : levels_of(studies)) {
        const auto name = [&mesh = study.name(), sigma = plain_text(100 * level.sigma, 3)](const char* key) {
            return words.line(key, "sigma"_a = sigma, "mesh"_a = mesh);
        };
        const StandardDistance right = standard_distance(study, level), control = standard_distance(study, level, wrong);
        append_checks(section, {check_at_most(name("check.vertices"), far, right.vertices, 0,
                                              words.line("check.vertices.note", "seeds"_a = study.seeds)),
                                check_at_most(name("check.area"), far, right.mass)});
        // A formula that rounding drowns cannot be told from a wrong one.
        if (study.condition < 1e12) add(section, check_at_least(name("check.control"), far, control.vertices));
        // p(t) is the expected, m(t) the measured curve, off by δ at most: m(t_p) ≤ (1 + δ)p(t_p) ≤ (1 + δ)p(t_m) ≤ m(t_m)(1 + δ)/(1 − δ).
        const OperatorStudy& clean = level.of(FlowOperator::clean);
        const double off = deviation(clean.formula(), clean.measured);
        if (off < 0.5) add(section, check_at_most(name("check.regret"), (1 + off) / (1 - off) - 1, clean.regret_of_formula, 1e-12));
    }
}

report::Text answer_of(const Studies& studies) {
    const auto off = [&](FlowOperator kind) {
        const auto of_level = [kind](auto& each) { return deviation(each.part.of(kind).formula(), each.part.of(kind).measured); };
        return readable_percent(largest_of(levels_of(studies), of_level), 2);
    };
    return words.say("answer", "off"_a = off(FlowOperator::clean), "own"_a = off(FlowOperator::noisy));
}

LibraryMeshes meshes_of(const MeshLibrary& library, const QuestionSettings& settings, report::Section& section) {
    if (settings.laboratory) return meshes_for(library, settings, {"cube", "lilium", "torus", "armadillo"}, section);
    if (settings.quick) return meshes_for(library, settings, {"cube"}, section);
    return meshes_for(library, settings, {"cube", "lilium"}, section);
}

}   // namespace

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer{section_of("prediction")};
    report::Section& section = answer.section;
    const LibraryMeshes meshes = meshes_of(library, settings, section);
    add_words(section, words, {"method", "results"});
    const Studies studies = studies_of(meshes, "predicted denoising", settings, progress, section, prediction_study);
    add(section, clean_prediction_table(studies));
    for (const PredictionStudy& study : studies) add(section, clean_prediction_plot(study));
    add(section, operator_prediction_table(studies));
    for (const PredictionStudy& study : studies) {
        add(section, operator_prediction_plot(study, FlowOperator::noisy));
        if (settings.laboratory) add(section, operator_prediction_plot(study, FlowOperator::rebuilt));
    }
    add(section, why_table(studies), rule_table(studies));
    add_discussion(section, studies);
    add_checks(section, studies);
    section.answer = answer_of(studies);

    const PredictionStudy& first = studies.front();
    Names levels;
    std::vector<double> noise;
    for (const NoiseLevelStudy& level : first.levels) {
        noise.push_back(level.sigma);
        levels.push_back(readable_percent(level.sigma, 2));
    }
    section.parameters = {{"noise", {words.line("parameter.noise", "levels"_a = listed(levels)), noise, "box diagonal"}},
                          {"seeds", first.seeds},
                          {"seed", settings.seed}};
    for (const PredictionStudy& study : studies) {
        const double lambda = study.lambda * study.diagonal * study.diagonal;
        section.parameters["λ on " + study.name()] = {plain_text(lambda, 6), lambda, "length²"};
    }
    section.extent = words.line("extent", "meshes"_a = listed(names_of(studies)), "seeds"_a = first.seeds);
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
