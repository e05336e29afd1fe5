// The denoising laboratory: kinds of noise, levels and methods against each other, each method at its best within the same budget.
#include <ranges>

#include "geometry/denoising/component_size.h"
#include "geometry/measures/mesh_facts.h"
#include "mesh/samples/sample_shapes.h"
#include "questions/methods/parts.h"

namespace meshfolio::methods {

namespace {

void add_method(report::Section& section, const SearchBudget& budget) {
    add_words(section, words, "method");
    report::BulletList noise, methods;
    for (const NoiseEntry& entry : noise_list())
        noise.items.push_back(report::text(report::strong(std::string(entry.title)), ": ", std::string(entry.description)));
    add(section, std::move(noise));
    add_words(section, words, "method.flows");
    for (const DenoisingEntry& entry : denoising_list())
        methods.items.push_back(report::text(report::strong(std::string(entry.title)), " ", report::ref(std::string(entry.reference)), ": ",
                                             std::string(entry.description)));
    add(section, std::move(methods));
    const int bounded = std::max(1, budget.values / 2);
    add_words(section, words, "method.budget", "total"_a = budget.total(), "values"_a = budget.values, "steps"_a = budget.steps,
              "bounded_values"_a = bounded, "bounded_steps"_a = budget.total() / bounded);
}

/// Tries the methods on meshes of the library; with bundled ones also on an ellipsoid, smooth, closed and small.
DenoisingLaboratory laboratory_of(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress,
                                  report::Section& section) {
    std::initializer_list<std::string_view> quick{"cube"}, usual{"cube", "armadillo"},
        all{"cube", "plane", "fandisk_ns", "lilium", "armadillo"};
    const LibraryMeshes meshes = meshes_for(library, settings, settings.quick ? quick : settings.laboratory ? all : usual, section);
    const bool own_choice = settings.meshes.empty() && !library.has_own_meshes();
    const int most = largest_subject(settings, meshes.size() + (own_choice ? 1 : 0));
    const auto trials_on = [most](const SharedMesh& mesh, const QuestionSettings& all_settings) {
        return denoising_trials(denoising_subject(mesh->name, mesh->mesh(), most), all_settings);
    };
    DenoisingLaboratory laboratory{search_budget(settings),
                                   studies_of(meshes, "denoising by every method", settings, progress, section, trials_on)};
    if (own_choice && !settings.quick)
        laboratory.meshes.push_back(denoising_trials(denoising_subject("egg", ellipsoid_mesh(3, {1, 0.8, 0.65}), most), settings));
    return laboratory;
}

/// Returns the standard deviation of Σ|displacement|²/(3σ²n) about its mean 1: √2 over the root of the effective number of squares.
double strength_deviation(const DenoisingTrials& mesh, const NoiseTrial& trial) {
    const double n = mesh.subject.mesh.vertex_count();
    if (trial.kind == NoiseKind::gaussian) return std::sqrt(2 / (3 * n));
    if (trial.kind == NoiseKind::impulsive) return std::sqrt(2 / (3 * std::max(1.0, std::round(impulsive_share * n))));
    return std::sqrt(2 / n);   // box: as if one axis had it all
}

void add_checks(report::Section& section, const DenoisingLaboratory& laboratory) {
    double strength = 0, volume = 0, area = 0, unspent = 0, rounding = 0;
    bool any_volume = false;
    for (const auto& [mesh, trial] : parts_within(laboratory.meshes, &DenoisingTrials::trials)) {
        const double ratio = trial.damage.rms / (std::sqrt(3) * trial.sigma);
        strength = std::max(strength, std::abs(ratio * ratio - 1) / strength_deviation(mesh, trial));
        rounding = std::max(rounding, coordinate_spacing(mesh.subject.mesh) / mesh.subject.mean_edge);
        for (const SearchResult& r : trial.results) {
            if (r.defined && r.failed == 0) unspent = std::max(unspent, std::abs(double(r.steps - laboratory.budget.total())));
            if (r.method == DenoisingMethod::conformal_flow)
                area = std::max(area, std::abs(r.difference.area_ratio / trial.damage.area_ratio - 1));
            if (r.method != DenoisingMethod::volume_rescaled || !r.defined || !mesh.subject.has_volume_to_keep) continue;
            // Noise as large as a component turns it inside out, and no scale undoes that.
            const auto volumes = [&subject = mesh.subject](const Positions& X) {
                return component_sizes(moved_to(subject.mesh, X), subject.topology).volume;
            };
            if ((volumes(trial.noisy).array() * volumes(r.X).array() <= 0).any()) continue;
            volume = std::max(volume, std::abs(r.difference.volume_ratio / trial.damage.volume_ratio - 1));
            any_volume = true;
        }
    }
    append_checks(section,
                  {check_at_most(words.line("check.strength"), 5, strength, 0), check_near(words.line("check.budget"), 0, unspent, 0)});
    if (any_volume) add(section, report::within_rounding(check_at_most(words.line("check.volume"), 0, volume, 1e-9), rounding));
    add(section, report::within_rounding(check_at_most(words.line("check.area"), 0, area, 1e-9), rounding));
}

}   // namespace

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer{section_of("methods")};
    report::Section& section = answer.section;
    const DenoisingLaboratory laboratory = laboratory_of(library, settings, progress, section);
    const DenoisingTrials& first = laboratory.meshes.front();
    const std::vector<ClassResult> classes = class_results(laboratory);
    const int steps = laboratory.budget.total();

    add_method(section, laboratory.budget);
    add_words(section, words, "results");
    add(section, subject_table(laboratory), winner_table(classes), gain_table(laboratory));
    if (first.of_kind(NoiseKind::gaussian).size() > 1) add(section, gain_plot(laboratory));
    std::vector<Shown> shown;
    for (const DenoisingTrials& mesh : laboratory.meshes | std::views::take(4)) shown.push_back({mesh, mesh.pictured_trial()});
    for (const NoiseTrial& trial : first.trials)
        if (trial.s1_level && settings.laboratory) shown.push_back({first, trial});
    add_method_figure(answer, shown);
    add_words(section, words, "discussion", facts_of(laboratory));
    add_checks(section, laboratory);

    std::map<int, Names> won;   // classes by their best method
    for (const ClassResult& c : classes)
        if (c.best >= 0) won[c.best].push_back("“" + c.title + "”");
    Names winners;
    for (const auto& [method, titles] : won)
        winners.push_back(words.line("answer.winner", "method"_a = method_title(method), "classes"_a = listed(titles)));
    section.answer = winners.empty() ? words.say("answer.none") : words.say("answer", "winners"_a = listed(winners));

    const std::string impulsive = words.line("parameter.impulsive", "share"_a = readable_percent(impulsive_share, 2));
    section.parameters = {
        {words.line("parameter.steps"), steps}, {"seed", settings.seed}, {"impulsive noise", {impulsive, impulsive_share, "share"}}};
    section.extent = words.line("extent", "methods"_a = denoising_list().size(),
                                "trials"_a = parts_within(laboratory.meshes, &DenoisingTrials::trials).size(),
                                "meshes"_a = listed(names_of(laboratory.meshes)), "steps"_a = steps);
    return answer;
}

extern const Chapter chapter{
    .id = "methods",
    .code = {{"with_noise", "src/mesh/vertex_noise.cpp"},
             {"denoise", "src/geometry/denoising/denoising_methods.cpp"},
             {"filtered_normals", "src/geometry/denoising/normal_filters.cpp"},
             {"conformalised", "src/geometry/denoising/denoising_methods.cpp"},
             {"with_volumes", "src/geometry/denoising/component_size.cpp"},
             {"search", "src/questions/bench/denoising_search.cpp"},
             {"answer", "src/questions/methods/chapter.cpp"}},
    .roles = {"cube", "armadillo", "plane", "fandisk_ns", "lilium"},
    .planned_roles = 2,
    .cost = {.cpu = {{0.9, 0.2}, {0.05, 0.2}}, .memory = {{7, 25}, {4, 5}}},
    .answer = answer,
};

}   // namespace meshfolio::methods
