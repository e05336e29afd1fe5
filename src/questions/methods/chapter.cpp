// The section "methods": kinds of noise, levels and methods against each other, each method at its best within the same budget.
#include "questions/methods/parts.h"

#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "geometry/measures/mesh_error.h"
#include "mesh/samples/sample_shapes.h"
#include "questions/bench/curvature_study.h"
#include "questions/core/section_tools.h"
#include "questions/core/six_view_figure.h"
#include "questions/core/study_list.h"

namespace meshfolio::methods {

namespace {

using report::check_at_most;
using report::check_near;
using report::math;
using report::ref;

void add_list_of_methods(report::Section& section) {
    report::BulletList list;
    for (const DenoisingEntry& entry : denoising_list()) {
        list.items.push_back(report::text(report::strong(std::string(entry.title)), " ", ref(std::string(entry.reference)), ": ",
                                          std::string(entry.description)));
    }
    section.blocks.push_back(std::move(list));
}

void add_list_of_noise(report::Section& section) {
    report::BulletList list;
    for (const NoiseEntry& entry : noise_list())
        list.items.push_back(report::text(report::strong(std::string(entry.title)), ": ", std::string(entry.description)));
    section.blocks.push_back(std::move(list));
}

void add_method(report::Section& section, const SearchBudget& budget) {
    add_heading(section, "Method");
    add_paragraph(section, "Clean meshes get noise of four kinds, all seeded. At the same ", math("σ"),
                  " they are equally strong: the mean squared displacement is ", math("3σ²"),
                  " whatever the kind. Its unit is the mean edge of the clean mesh; one level is that of an earlier report, 20 % of the "
                  "bounding box, axis by axis.");
    add_list_of_noise(section);
    add_paragraph(section,
                  "Eight methods take it off again. Six move the vertices by diffusion; two of them rescale what it leaves, and one of "
                  "these rebuilds the masses alone:");
    add_formula(section, "volume_rescaling");
    add_formula(section, "conformal_flow", "methods_eq_conformal");
    add_paragraph(section,
                  "Two filter the face normals first, so that a face learns only from faces like itself, and then move the vertices "
                  "towards them ",
                  ref("sun_2007"), ":");
    add_formula(section, "bilateral_normals", "methods_eq_bilateral");
    add_formula(section, "vertex_update");
    add_list_of_methods(section);
    add_paragraph(section, "The guide ", math("g"), " of the bilateral filter is the normal ", math("n"),
                  " itself; that of the guided one is the mean normal of the most consistent patch around, which noise does not reach so "
                  "easily. That is why it stands here beside the bilateral filter: the two differ in the guide alone.");
    add_paragraph(
        section, "Every method gets the same budget on every noisy mesh: ", std::to_string(budget.total()), " steps, in runs of ",
        std::to_string(budget.values), " parameters × ", counted(budget.steps, "step"),
        " each (explicit and Taubin, whose steps are bounded: ", std::to_string(std::max(1, budget.values / 2)), " × ",
        std::to_string(budget.total() / std::max(1, budget.values / 2)),
        "). The parameters are geometric sequences: λ from 0.05 to 0.9 of λ_crit (explicit), pass bands from 0.01 to 0.3 of μ_max/2 "
        "(Taubin), "
        "λ from 0.0025 to 2.56 squared mean edges of the noisy mesh (the other flows), σ_r from 0.1 to 1 (normals). After every step the "
        "result is held against the clean mesh; what is told of a method is its best. So the numbers are bounds of what can be had with "
        "it, not what one gets without knowing the truth.");
    add_paragraph(
        section, "Three measures, each as a gain, that of the noisy mesh over the least reached: the ", report::strong("shape"),
        ", how far vertices are from the clean triangles around their places (rms), which decides; their ", report::strong("places"),
        ", how far they are from where they were (rms); and the ", report::strong("normals"),
        ", the mean angle between faces and clean faces. Noise moves vertices within the surface too, which does not change its "
        "shape, and which nothing in the shape tells: whoever takes off all that is normal to a smooth surface, and leaves what is "
        "within it, two thirds of the mean square of Gaussian noise, gains ",
        math("√(3/2) = 1.22"), " in places. Whoever gains more has brought back some of what is within it.");
}

/// On the library's meshes, and beside the bundled roles on an ellipsoid of our own: smooth, closed and small enough to be taken whole.
DenoisingLaboratory laboratory_of(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress,
                                  report::Section& section) {
    const LibraryMeshes meshes = settings.quick ? meshes_for(library, settings, {"cube"}, section)
                                 : settings.laboratory
                                     ? meshes_for(library, settings, {"cube", "plane", "fandisk_ns", "lilium", "armadillo"}, section)
                                     : meshes_for(library, settings, {"cube", "armadillo"}, section);
    const bool own_choice = settings.meshes.empty() && !library.has_own_meshes();
    const int most = largest_subject(settings, meshes.size() + (own_choice ? 1 : 0));
    const auto trials_on = [most](const std::shared_ptr<const LibraryMesh>& mesh, const QuestionSettings& all) {
        return denoising_trials(denoising_subject(mesh->name, mesh->mesh(), most), all);
    };
    DenoisingLaboratory laboratory{search_budget(settings),
                                   studies_of(meshes, "denoising by every method", settings, progress, section, trials_on)};
    if (own_choice && !settings.quick)
        laboratory.meshes.push_back(denoising_trials(denoising_subject("egg", ellipsoid_mesh(3, {1, 0.8, 0.65}), most), settings));
    return laboratory;
}

/// Standard deviation of Σ|displacement|²/(3σ²n) about its mean 1: √2 over the root of the effective number of squares.
double strength_deviation(const DenoisingTrials& mesh, const NoiseTrial& trial) {
    const double n = mesh.subject.mesh.vertex_count();
    switch (trial.kind) {
        case NoiseKind::gaussian:
            return std::sqrt(2 / (3 * n));
        case NoiseKind::impulsive:
            return std::sqrt(2 / (3 * std::max(1.0, std::round(impulsive_share * n))));
        case NoiseKind::normal:
        case NoiseKind::box:   // as if one axis had it all
            break;
    }
    return std::sqrt(2 / n);
}

void add_finding(report::Section& section, const DenoisingLaboratory& laboratory) {
    std::vector<std::string> told;
    for (const ClassResult& c : class_results(laboratory)) {
        if (told.size() < 3 && c.best() >= 0)
            told.push_back(method_title(c.best()) + " on “" + c.title + "” (" + readable(c.gain[static_cast<std::size_t>(c.best())], 2) +
                           "-fold)");
    }
    if (told.empty()) told.push_back("none, for the noise changed no shape");
    section.findings.push_back(
        {report::text("Of eight denoising methods at their best within the same budget, the one that restores shapes best on average is ",
                      listed(told), "."),
         70});
}

}   // namespace

void add_method_figure(Answer& answer, const DenoisingTrials& mesh, const NoiseTrial& trial) {
    const DenoisingSubject& subject = mesh.subject;
    const std::string base = id_of("methods", mesh.name(), trial.id());
    const auto coloured = [&](const Positions& X, const std::string& what, std::string label) {
        return panel_of(moved_to(subject.mesh, X), base + "_" + what, std::move(label),
                        shape_distances(subject.mesh, subject.topology.vertex_faces, X) / subject.mean_edge);
    };
    output::FigureRequest request;
    request.id = base;
    request.title = "Every method at its best on " + mesh.name();
    request.subtitle = trial.words() + "; least error of shape of each method";
    request.three_quarter = request.three_quarter_frame = true;
    std::vector<output::Panel> panels{coloured(trial.noisy, "noisy", "noisy")};
    std::string alt = "Small pictures of " + mesh.name() + ": clean; noisy, error of shape " +
                      readable(trial.results.front().noisy.shape / subject.mean_edge, 2) + " mean edges";
    for (const SearchResult& result : trial.results) {
        if (!result.defined) continue;
        const DenoisingEntry& entry = denoising_entry(result.method);
        panels.push_back(coloured(result.X, std::string(entry.name), std::string(entry.title) + ", gain " + readable(result.gain(), 2)));
        alt += "; " + panels.back().label;
    }
    request.range = output::robust_range(panels, "viridis", "distance to the clean surface", "mean edges", 0.01);
    request.range->low = request.range->clipped_below = 0;   // a distance begins at 0
    request.panels = {panel_of(subject.mesh, base + "_clean", "clean")};
    request.panels.insert(request.panels.end(), panels.begin(), panels.end());
    const std::string caption =
        mesh.name() + (subject.is_patch() ? " (a patch of it)" : "") + " with noise (" + trial.words() +
        ") and every method at the parameter and step of its least error of shape, in one frame; coloured by the distance of each vertex "
        "to the clean triangles around its place. Look at edges and corners, at what is left of the noise, and at the size.";
    answer.section.blocks.push_back(report::Figure{request.id, caption, alt + "."});
    answer.figures.push_back(std::move(request));
}

std::vector<report::Check> method_checks(const DenoisingLaboratory& laboratory) {
    std::vector<report::Check> checks;
    double strength = 0, volume = 0, area = 0, unspent = 0;
    int volumes = 0;
    for (const DenoisingTrials& mesh : laboratory.meshes) {
        for (const NoiseTrial& trial : mesh.trials) {
            const double ratio = trial.spoilt.rms / (std::sqrt(3) * trial.sigma);
            strength = std::max(strength, std::abs(ratio * ratio - 1) / strength_deviation(mesh, trial));
            for (const SearchResult& r : trial.results) {
                if (r.defined && r.failed == 0) unspent = std::max(unspent, std::abs(double(r.steps - laboratory.budget.total())));
                if (r.method == DenoisingMethod::conformal_flow)
                    area = std::max(area, std::abs(r.difference.area_ratio / trial.spoilt.area_ratio - 1));
                if (r.method != DenoisingMethod::volume_rescaled || !r.defined) continue;
                volume = std::max(volume, std::abs(r.difference.volume_ratio / trial.spoilt.volume_ratio - 1));
                ++volumes;
            }
        }
    }
    checks.push_back(check_at_most("noise as strong as asked: largest deviation of the mean squared displacement / its standard deviation",
                                   5, strength, 0));
    checks.push_back(check_near("the same budget: largest difference of the steps made from it", 0, unspent, 0));
    if (volumes > 0)
        checks.push_back(check_at_most("volume rescaling keeps the volume of the noisy mesh: largest relative change", 0, volume, 1e-9));
    checks.push_back(check_at_most("the conformalised flow keeps the area of the noisy mesh: largest relative change", 0, area, 1e-9));
    return checks;
}

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer;
    report::Section& section = answer.section;
    section = section_of("methods");
    const DenoisingLaboratory laboratory = laboratory_of(library, settings, progress, section);
    add_method(section, laboratory.budget);

    add_heading(section, "Results");
    section.blocks.emplace_back(subject_table(laboratory));
    section.blocks.emplace_back(winner_table(class_results(laboratory)));
    section.blocks.emplace_back(limit_table(laboratory));
    for (const DenoisingTrials& mesh : laboratory.meshes) {
        for (const Measure measure : {Measure::shape, Measure::places, Measure::normals})
            section.blocks.emplace_back(gain_table(mesh, measure));
        if (mesh.of_kind(NoiseKind::gaussian).size() > 1) section.blocks.emplace_back(gain_plot(mesh));
        add_method_figure(answer, mesh, mesh.trials[static_cast<std::size_t>(mesh.pictured)]);
        section.blocks.emplace_back(result_table(mesh));
    }
    const DenoisingTrials& first = laboratory.meshes.front();
    for (const NoiseTrial& trial : first.trials) {
        if (trial.s1_level && settings.laboratory) add_method_figure(answer, first, trial);
    }
    add_discussion(section, laboratory);
    append_checks(section, method_checks(laboratory));

    std::size_t trials = 0;
    for (const DenoisingTrials& mesh : laboratory.meshes) trials += mesh.trials.size();
    section.parameters["steps a method on a noisy mesh"] = std::to_string(laboratory.budget.total());
    section.parameters["seed"] = std::to_string(settings.seed);
    section.parameters["impulsive noise"] = "on " + readable_percent(impulsive_share, 2) + " of the vertices";
    section.extent = counted(int(denoising_list().size()), "method") + " on " + counted(int(trials), "noisy mesh", "noisy meshes") +
                     " made from " + listed(names_of(laboratory.meshes)) + ", each at its best within " +
                     std::to_string(laboratory.budget.total()) +
                     " steps; winners by class of mesh, and the noise at which each begins and ceases to help";
    add_finding(section, laboratory);
    return answer;
}

extern const Chapter chapter{
    .id = "methods",
    .code = {{"with_noise", "src/mesh/vertex_noise.cpp"},
             {"denoise", "src/geometry/denoising/denoising_methods.cpp"},
             {"filtered_normals", "src/geometry/denoising/normal_filters.cpp"},
             {"conformalised", "src/geometry/smoothing/conformal_flow.cpp"},
             {"with_volumes", "src/geometry/denoising/component_size.cpp"},
             {"search", "src/questions/methods/search.cpp"},
             {"answer", "src/questions/methods/chapter.cpp"}},
    .answer = answer,
};

}   // namespace meshfolio::methods
