// Question 4: meshes rebuilt from the k smoothest eigenvectors of the cotangent Laplace–Beltrami operator.
#include <algorithm>

#include "questions/bench/law_checks.h"
#include "questions/core/section_tools.h"
#include "questions/core/value_lists.h"
#include "questions/q4_spectral/parts.h"

namespace meshfolio::q4_spectral {

namespace {

void add_low_pass_checks(report::Section& section, const SpectralStudy& study, const LowPassStudy& low_pass) {
    const auto at_most = [&](const char* key, double limit, double measured, double tolerance = 0) {
        section.checks.push_back(report::check_at_most(words.line(key, "mesh"_a = study.name()), limit, measured, tolerance));
    };
    if (low_pass.k == 0) return;
    double excess = 0;
    for (const LowPassError& row : low_pass.errors) excess = std::max(excess, row.ideal_from_response - row.ideal);
    at_most("check.low_pass_part", 0, excess / study.diagonal, 1e-9);
    const LowPassError &first = low_pass.errors.front(), &last = low_pass.errors.back();
    if (last.degree < 15 * std::sqrt(low_pass.bound / low_pass.cutoff)) return;
    // From this degree on the passage of the step is narrow, and the series of the smooth response has converged.
    at_most("check.low_pass_degrees", 1, last.ideal / first.ideal);
    at_most("check.low_pass_smooth", 0, (last.smooth - low_pass.unknown) / study.diagonal, 1e-8);
}

void add_checks(report::Section& section, const SpectralStudy& study, const std::vector<Threshold>& thresholds, const BandStudy& bands) {
    const auto of_diagonal = [&](std::string name, double length, double tolerance = 1e-9) {
        section.checks.push_back(report::check_at_most(std::move(name), 0, length / study.diagonal, tolerance));
    };
    const auto on_mesh = [&](const char* key) { return words.line(key, "mesh"_a = study.name()); };
    for (const Threshold& t : thresholds)
        of_diagonal(words.line("check.threshold", "k"_a = t.k, "mesh"_a = study.name()), std::abs(t.measured_rms - study.rms[t.k]));
    const int needles = study.source->prepared->preflight.needle_faces + study.source->prepared->preflight.zero_area_faces;
    append_checks(section, spectrum_checks(study.certificate, " on " + study.name(),
                                           needles > 0 ? words.line("check.needles", "faces"_a = needles) : ""));
    of_diagonal(on_mesh("check.parseval"), largest_parseval_gap(study));
    of_diagonal(on_mesh("check.no_rise"), largest_rise(study.rms), 1e-12);
    if (study.modes() == study.vertices()) of_diagonal(on_mesh("check.all_modes"), study.reconstructions.back().difference.max);
    if (bands.meshes.empty()) return;
    double gap = 0;
    for (const EqualisedMesh& state : bands.meshes) gap = std::max(gap, std::abs(state.predicted_rms - state.measured_rms));
    of_diagonal(on_mesh("check.filters"), gap);
}

report::Finding finding(const SpectralStudy& study) {
    const int enough = smallest_k_below(study, 0.01);
    const Reconstruction& last = study.reconstructions.back();
    if (enough > 0) return {words.say("finding.reached", "k"_a = enough, "vertices"_a = study.vertices(), "mesh"_a = study.name()), 80};
    return {
        words.say("finding.not_reached", "k"_a = last.k, "mesh"_a = study.name(), "error"_a = percent_of_box(study, last.difference.rms)),
        80};
}

/// What the modes are good for beyond rebuilding, and what they cost.
void add_uses(Answer& answer, const SpectralStudy& study, const SpectralUses& uses, const QuestionSettings& settings) {
    report::Section& section = answer.section;
    if (uses.limbs.measured()) add(section, limb_table(study, uses.limbs));
    add(section, cost_table(study, uses.factor_entries));
    if (!uses.bands.bands.empty()) {
        add_band_figure(answer, study, uses.bands, settings.colormap);
        add(section, band_table(study, uses.bands));
        add(section, filter_table(study, uses.bands));
    }
    if (uses.low_pass.k > 0) {
        add(section, low_pass_table(study, uses.low_pass));
        add(section, low_pass_plot(study, uses.low_pass));
    }
    add_mistake_figure(answer, study, uses.mistakes, settings.colormap);
    add(section, mistake_table(study, uses.mistakes));
    section.timings.push_back({"eigenpairs of " + study.name(), study.seconds});
    if (uses.low_pass.k > 0) section.timings.push_back({words.line("timing.low_pass", "mesh"_a = study.name()), uses.low_pass.seconds});
}

/// All about one mesh.
void add_mesh(Answer& answer, const SpectralStudy& study, const SpectralUses& uses, const QuestionSettings& settings) {
    report::Section& section = answer.section;
    const std::vector<Threshold> thresholds = thresholds_of(study);
    add_reconstruction_figure(answer, study);
    add_before_after(answer, study, settings.colormap);
    add(section, error_table(study));
    add(section, error_plot(study));
    if (!thresholds.empty()) add(section, threshold_table(study, thresholds));
    add(section, eigenvalue_table(study));
    add_eigenfunction_gallery(answer, study, settings.quick);
    add_uses(answer, study, uses, settings);
    add_checks(section, study, thresholds, uses.bands);
    add_low_pass_checks(section, study, uses.low_pass);
    section.findings.push_back(finding(study));
}

/// The rebuilt meshes, written out. @return their k: "5, 15 and 60"
std::string add_meshes(Answer& answer, const SpectralStudy& study) {
    std::vector<std::string> counts;
    for (const Reconstruction& r : study.reconstructions) {
        counts.push_back(std::to_string(r.k));
        const std::string file = id_of(study, "k" + counts.back()) + ".ply";
        answer.meshes.push_back({file, std::make_shared<const TriangleMesh>(r.mesh)});
        answer.section.output_meshes.push_back("meshes/" + file);
    }
    return listed(counts);
}

}   // namespace

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer;
    report::Section& section = answer.section;
    section = section_of("q4");
    const auto meshes = meshes_for(library, settings, {"armadillo"}, section);
    add_words(section, words, "method");

    add_words(section, words, "results");
    const auto studies = studies_of(meshes, "eigenpairs", settings, progress, section, spectral_study);
    std::vector<SpectralUses> uses;
    for (const SpectralStudy& study : studies) {
        progress("uses of the modes of " + study.name());
        uses.push_back(spectral_uses(study, settings));
    }
    std::vector<std::string> done;
    for (std::size_t i = 0; i < studies.size(); ++i) {
        const SpectralStudy& study = studies[i];
        add_mesh(answer, study, uses[i], settings);
        const std::string counts = add_meshes(answer, study);
        done.push_back(words.line("extent.mesh", "mesh"_a = study.name(), "counts"_a = counts));
        section.parameters["k on " + study.name()] = counts;
        section.parameters["solver on " + study.name()] = study.spectrum.dense ? "dense" : "shift-invert Lanczos";
    }
    add_discussion(section, studies, uses);
    section.parameters["area form"] = "barycentric";
    section.extent = words.line("extent", "meshes"_a = listed(done));
    return answer;
}

extern const Chapter chapter{
    .id = "q4",
    .code = {{"smallest_eigenpairs", "src/geometry/spectrum/laplace_spectrum.cpp"},
             {"certify_spectrum", "src/geometry/spectrum/spectrum_certificate.cpp"},
             {"reconstruct", "src/geometry/spectrum/spectral_reconstruction.cpp"},
             {"reconstruction_rms", "src/geometry/spectrum/spectral_reconstruction.cpp"},
             {"filtered", "src/geometry/spectrum/spectral_filter.cpp"},
             {"chebyshev_low_pass", "src/geometry/spectrum/chebyshev_filter.cpp"},
             {"reconstruct_unmapped", "src/geometry/spectrum/spectral_mistakes.cpp"},
             {"local_thickness", "src/geometry/measures/local_thickness.cpp"},
             {"answer", "src/questions/q4_spectral/chapter.cpp"}},
    .answer = answer,
};

}   // namespace meshfolio::q4_spectral
