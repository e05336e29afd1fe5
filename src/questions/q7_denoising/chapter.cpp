// Question 7: what Laplacian smoothing can do against noise, measured against the clean mesh.
#include "questions/q7_denoising/parts.h"

namespace meshfolio::q7_denoising {

namespace {

void add_checks(report::Section& section, const DenoisingGrid& grid) {
    const report::Fact mesh = "mesh"_a = grid.name();
    const double n = grid.clean->mesh().vertex_count();
    for (const NoisyTrial& trial : grid.trials) {
        // rms of 3n normal numbers has relative standard deviation 1/√(6n); five of them.
        add(section, check_near(words.line("check.noise", "percent"_a = plain_text(100 * trial.relative, 3), mesh), 1,
                                trial.found.noisy.rms / (std::sqrt(3.0) * trial.sigma), 5 / std::sqrt(6 * n)));
        // The nearest point of the surface is no farther than the vertex's own place.
        add(section, check_at_most(words.line("check.surface", "percent"_a = plain_text(100 * trial.relative, 3), mesh), 1,
                                   trial.found.by_rms.shape / trial.found.by_rms.rms, 1e-12));
    }
}

/// The coursework has no clean mesh of that shape, so there is one of ours.
bool has_own_fandisk(const Grids& grids) {
    return std::ranges::any_of(grids, [](const DenoisingGrid& grid) {
        return grid.clean->input.role == "fandisk" && grid.clean->input.file == "fandisk_like.obj";
    });
}

}   // namespace

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer{section_of("q7")};
    report::Section& section = answer.section;
    const auto meshes = meshes_for(library, settings, section);
    const auto grids = studies_of(meshes, "denoising", settings, progress, section, denoising_grid);
    const Reasons reasons = reasons_of(grids);
    const report::Facts facts = facts_of(grids, reasons);
    section.answer = words.say("answer", facts);
    add_words(section, words, "method", "seed"_a = settings.seed, "own"_a = has_own_fandisk(grids));

    add_words(section, words, "discussion.why", facts);
    if (!reasons.bands.mu.empty()) add(section, mode_plot(reasons));
    if (reasons.grid) add(section, error_plot(reasons));
    add_words(section, words, "discussion.when", facts);
    add(section, result_table(grids));
    add_states(answer, grids);
    add_views(answer, grids);
    add_words(section, words, "discussion.cost", facts);
    add_losses(answer, grids);

    begin_appendix(section);
    add_words(section, words, "discussion.further", facts);
    add(section, measure_table(grids), gain_map(leading(grids)), remains_table(grids));
    for (const DenoisingGrid& grid : grids) add_checks(section, grid);

    const DenoisingGrid& first = grids.front();
    const std::vector<double> noise = tries_of(settings, first.mean_edge).noise;
    const bool in_edges = tries_in_edges(settings);
    const std::string levels =
        words.line("parameter.noise", "in_edges"_a = in_edges, "edges"_a = readable(level_in_edges, 2),
                   "levels"_a = listed(each_of(noise, [](double relative) { return readable_percent(relative, 2); })));
    const std::string steps = listed(each_of(first.lambdas, [](double lambda) { return readable(lambda, 3); }));
    section.parameters = {
        {"noise", {levels, noise, "box diagonal"}},
        {"λ", {words.line("parameter.lambda", "steps"_a = steps), first.lambdas, "h̄²"}},
        {"iterations", {words.line("parameter.iterations", "last"_a = first.iterations), static_cast<double>(first.iterations)}},
        {"seed", settings.seed}};
    section.extent = words.line("extent", "levels"_a = levels, "steps"_a = first.lambdas.size(), "iterations"_a = first.iterations,
                                "meshes"_a = listed(names_of(grids)));
    return answer;
}

extern const Chapter chapter{
    .id = "q7",
    .code = {{"with_gaussian_noise", "src/mesh/vertex_noise.cpp"},
             {"smooth", "src/geometry/smoothing/laplacian_smoothing.cpp"},
             {"search", "src/questions/bench/denoising_search.cpp"},
             {"shape_rms", "src/geometry/measures/mesh_error.cpp"},
             {"answer", "src/questions/q7_denoising/chapter.cpp"}},
    .roles = {"cube", "fandisk", "armadillo"},
    .cost = {.cpu = {{0.2, 50, 20}, {0.3, 9, 8.5}},
             .memory = {{14, 250}, {10, 250}},
             .lengths = &QuestionSettings::iterations,
             .length = {32, 16},
             .runs = {20, 6}},
    .answer = answer,
    .lab = &lab,
};

}   // namespace meshfolio::q7_denoising
