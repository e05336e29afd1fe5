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

/// Why there is a mesh of ours: the coursework has no clean one of that shape.
report::Text own_fandisk(const Grids& grids) {
    const bool used = std::ranges::any_of(grids, [](const DenoisingGrid& grid) {
        return grid.clean->input.role == "fandisk" && grid.clean->input.file == "fandisk_like.obj";
    });
    return used ? words.say("method.own") : report::Text();
}

}   // namespace

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer{section_of("q7")};
    report::Section& section = answer.section;
    const auto meshes = meshes_for(library, settings, {"cube", "fandisk", "armadillo"}, section);
    const auto grids = studies_of(meshes, "denoising", settings, progress, section, denoising_grid);
    section.answer = answer_of(grids);
    add_words(section, words, "method", "seed"_a = settings.seed, "own"_a = own_fandisk(grids));

    add_words(section, words, "results");
    add_paragraphs(section, {explanation_of(grids)});
    const output::ColorRange colours = add_states(answer, grids);
    add_paragraphs(section, {reading_of(grids)});
    add(section, result_table(grids));
    add_paragraphs(section, {summary_of(grids), strength_of(grids)});
    add(section, gain_map(leading(grids)));
    add_paragraphs(section, {amount_of(grids)});
    add_views(answer, grids, colours);
    add_limits(answer, grids);
    add(section, remains_table(grids));
    add_paragraphs(section, {limits_of(grids), beyond_of(grids)});

    begin_appendix(section);
    if (report::Table counts = count_table(grids); !counts.rows.empty()) add(section, std::move(counts));
    for (const DenoisingGrid& grid : grids) {
        if (&grid != &leading(grids)) add(section, gain_map(grid));
        add(section, error_plot(grid));
        add_checks(section, grid);
    }
    add(section, measure_table(grids));

    const DenoisingGrid& first = grids.front();
    const std::vector<double> noise = each_of(first.trials, [&](const NoisyTrial& trial) { return trial.relative; });
    const std::string levels = listed(each_of(noise, [](double relative) { return readable_percent(relative, 2); }));
    const std::string steps = listed(each_of(first.lambdas, [](double lambda) { return readable(lambda, 3); }));
    section.parameters = {
        {"noise", {words.line("parameter.noise", "levels"_a = levels), noise, "box diagonal"}},
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
    .answer = answer,
};

}   // namespace meshfolio::q7_denoising
