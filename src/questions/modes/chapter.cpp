// The section "modes": what a filter does to shape and to noise, one eigenmode at a time, and how far that is known beforehand.
#include "questions/modes/parts.h"

namespace meshfolio::modes {

namespace {

struct PartMeshes {
    LibraryMeshes shape, noise;
};
/// Finds the meshes of both parts; noise is added to clean meshes only. The user's own meshes take part in both.
PartMeshes part_meshes(const MeshLibrary& library, const QuestionSettings& settings, report::Section& section) {
    PartMeshes parts;
    const auto enter = [&](const std::vector<std::string_view>& roles, auto... of_parts) {
        for (const SharedMesh& mesh : meshes_for(library, settings, roles, section)) ((parts.*of_parts).push_back(mesh), ...);
    };
    const bool given = !settings.meshes.empty() || library.has_own_meshes();
    if (settings.laboratory && !given) {
        enter({"cube", "armadillo"}, &PartMeshes::shape, &PartMeshes::noise);
        enter({"plane_ns", "fandisk_ns"}, &PartMeshes::shape);
        enter({"lilium", "torus"}, &PartMeshes::noise);
        return parts;
    }
    enter({"cube"}, &PartMeshes::shape, &PartMeshes::noise);
    if (settings.quick || given) return parts;
    enter({"plane_ns"}, &PartMeshes::shape);
    enter({"lilium"}, &PartMeshes::noise);
    return parts;
}

void add_shape_checks(report::Section& section, const ModeStudy& study) {
    double damping = 0, gap = 0, energy = 0;
    int gaps = 0, runs = 0;
    for (const ModeDamping& d : study.dampings) damping = std::max(damping, d.deviation(study.eigenvalues));
    for (const SchemeGap& g : study.gaps) {
        if (!(g.lambda <= study.subject.critical && study.is_measurable(g))) continue;
        gap = std::max(gap, std::abs(g.predicted / g.measured - 1));
        ++gaps;
    }
    for (const TriedWay& run : study.tried) {
        if (!(run.rounding < 1e-7)) continue;
        energy = std::max(energy, std::abs(run.energy / run.way.energy - 1));
        ++runs;
    }
    add(section,
        check_at_most(words.line("check.damping", "modes"_a = study.eigenvalues.size(), "mesh"_a = study.name()), law_tolerance, damping));
    if (gaps > 0) add(section, check_at_most(words.line("check.gap", "mesh"_a = study.name()), 1e-6, gap));
    if (runs > 0) add(section, check_at_most(words.line("check.energy", "runs"_a = runs, "mesh"_a = study.name()), 1e-6, energy));
}

void add_noise_checks(report::Section& section, const PredictionStudies& studies) {
    constexpr double far = 5, wrong = 1.5;
    for (const auto& [study, level] : levels_of(studies)) {
        const auto name = [&mesh = study.name(), sigma = plain_text(100 * level.sigma, 3)](const char* key) {
            return words.line(key, "sigma"_a = sigma, "mesh"_a = mesh);
        };
        const StandardDistance right = standard_distance(study, level), control = standard_distance(study, level, wrong);
        append_checks(section, {check_at_most(name("check.vertices"), far, right.vertices, 0,
                                              words.line("check.vertices.note", "seeds"_a = study.seeds)),
                                check_at_most(name("check.area"), far, right.mass)});
        // Rounding may hide the difference between a right and a wrong formula.
        if (study.condition < 1e12) add(section, check_at_least(name("check.control"), far, control.vertices));
        // p(t) is the expected, m(t) the measured curve, off by δ at most: m(t_p) ≤ (1 + δ)p(t_p) ≤ (1 + δ)p(t_m) ≤ m(t_m)(1 + δ)/(1 − δ).
        const OperatorStudy& clean = level.of(FlowOperator::clean);
        const double off = deviation(clean.formula(), clean.measured);
        if (off < 0.5) add(section, check_at_most(name("check.regret"), (1 + off) / (1 - off) - 1, clean.regret_of_formula, 1e-12));
    }
}

void add_record(report::Section& section, const ModeStudies& shapes, const PredictionStudies& noisy, const QuestionSettings& settings) {
    const PredictionStudy& first = noisy.front();
    Names levels;
    std::vector<double> noise;
    for (const NoiseLevelStudy& level : first.levels) {
        noise.push_back(level.sigma);
        levels.push_back(readable_percent(level.sigma, 2));
    }
    section.parameters = {{"operator", words.line("parameter.operator")},
                          {words.line("parameter.step"), {"0.95 λ_crit", 0.95, "λ_crit"}},
                          {words.line("parameter.lanczos"), lanczos_steps(settings)},
                          {"noise", {words.line("parameter.noise", "levels"_a = listed(levels)), noise, "box diagonal"}},
                          {"seeds", first.seeds},
                          {"seed", settings.seed}};
    for (const PredictionStudy& study : noisy) {
        const double lambda = study.lambda * study.diagonal * study.diagonal;
        section.parameters["λ on " + study.name()] = {plain_text(lambda, 6), lambda, "length²"};
    }
    section.extent =
        words.line("extent", "meshes"_a = listed(names_of(shapes)), "noisy"_a = listed(names_of(noisy)), "seeds"_a = first.seeds);
}

}   // namespace

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer{section_of("modes")};
    report::Section& section = answer.section;
    const PartMeshes meshes = part_meshes(library, settings, section);
    const ModeStudies shapes = studies_of(meshes.shape, "modes", settings, progress, section, mode_study);
    const PredictionStudies noisy = studies_of(meshes.noise, "predicted denoising", settings, progress, section, prediction_study);
    const report::Facts of_shape = shape_facts(shapes), of_noise = noise_facts(noisy);
    report::Facts all = of_shape;
    all.insert(all.end(), of_noise.begin(), of_noise.end());

    add_words(section, words, "method");
    add_words(section, words, "shape", of_shape);
    add(section, damping_plot(shapes.front()));
    if (!shapes.front().gaps.empty()) add(section, gap_table(shapes));
    add_words(section, words, "cost", of_shape);
    add(section, cost_plot(shapes), truth_plot(shapes), crossing_table(shapes));
    add_words(section, words, "noise", of_noise);
    add(section, expected_plot(noisy), expected_table(noisy));
    add_words(section, words, "own_operator", of_noise);
    add(section, own_operator_plot(noisy), own_operator_table(noisy), why_table(noisy));
    add_words(section, words, "stopping", of_noise);
    add(section, rule_table(noisy));

    for (const ModeStudy& study : shapes) {
        add_shape_checks(section, study);
        for (const TriedWay& run : study.tried) {
            const bool is_explicit = run.way.scheme == SmoothingScheme::explicit_euler;
            const std::string energy = readable_percent(study.targets[run.target].energy, 2);
            section.timings.push_back({words.line("timing", "explicitly"_a = is_explicit, "steps"_a = run.way.steps,
                                                  "mesh"_a = study.name(), "energy"_a = energy),
                                       run.seconds});
        }
    }
    add_noise_checks(section, noisy);
    section.answer = words.say("answer", all);
    add_record(section, shapes, noisy, settings);
    return answer;
}

extern const Chapter chapter{
    .id = "modes",
    .code = {{"spectral_measure", "src/geometry/spectrum/spectral_measure.cpp"},
             {"CostModel", "src/questions/modes/costs.cpp"},
             {"mode_study", "src/questions/modes/mode_study.cpp"},
             {"denoising_prediction", "src/geometry/denoising/denoising_prediction.cpp"},
             {"noise_level", "src/geometry/denoising/noise_level.cpp"},
             {"risk_estimate", "src/geometry/denoising/risk_estimate.cpp"},
             {"prediction_study", "src/questions/modes/prediction_study.cpp"},
             {"answer", "src/questions/modes/chapter.cpp"}},
    .roles = {"cube", "plane_ns", "lilium", "armadillo", "fandisk_ns", "torus"},
    .planned_roles = 3,
    .cost = {.cpu = {{0.2, 32, 40}, {0.15, 14}}, .memory = {{12, 400}, {3, 230}}},
    .answer = answer,
};

}   // namespace meshfolio::modes
