// Question 4: meshes rebuilt from the k smoothest eigenvectors of the cotangent Laplace–Beltrami operator.
#include "geometry/measures/hausdorff.h"
#include "geometry/measures/mesh_facts.h"
#include "questions/bench/law_checks.h"
#include "questions/q4_spectral/parts.h"

namespace meshfolio::q4_spectral {

namespace {

constexpr auto count_digits = 6;

/// A length of each element, as a share of the box.
auto of_box(const SpectralStudy& study, auto length_of) {
    return [&study, length_of](auto& element) {
        const double length = std::invoke(length_of, element);
        return cell_of(length < rounding * study.diagonal ? 0 : percent_of(study) * length);
    };
}

report::Table error_table(const SpectralStudy& study) {
    const report::Column share{.unit = "% of box"};
    std::string caption =
        words.line("errors", "mesh"_a = study.name(), "diagonal"_a = readable(study.diagonal), "limit"_a = readable_percent(seen_error, 1));
    if (is_exact(study, study.modes())) caption += " " + words.line("errors.exact");
    return table(id_of(study, "errors"), std::move(caption), study.reconstructions)
        .column("k", {.digits = count_digits}, &Reconstruction::k)
        .column("rms", {.unit = share.unit, .digits = 2}, of_box(study, [](auto& r) { return r.difference.area_weighted_rms; }))
        .column("off", {.unit = "% of area", .digits = 2}, [&](auto& r) { return 100 * share_seen(study, r); })
        .column("farther off", {.unit = "% of vertices", .digits = 2},
                [&](auto& r) { return cell_of(&r == &study.reconstructions.front() ? NAN : 100 * share_made_worse(study, *(&r - 1), r)); })
        .column("maximum", share, of_box(study, [](auto& r) { return r.difference.max; }))
        .column("Hausdorff", share, of_box(study, [&](auto& r) { return hausdorff_distance(study.mesh(), r.mesh).distance; }))
        .column("mean normal angle", {.unit = "°"},
                [&](auto& r) { return cell_of(is_exact(study, r.k) ? 0 : r.difference.mean_normal_angle * 180 / pi); })
        .column("volume", {.unit = "% of original"}, [](auto& r) { return cell_of(100 * r.difference.volume_ratio); });
}

report::Plot error_plot(const SpectralStudy& study) {
    const double percent = percent_of(study), least = rounding * study.diagonal;   // below it, a logarithm would squeeze everything else
    report::Series predicted{.name = words.line("error_versus_k.predicted")};
    report::Series measured{.name = words.line("error_versus_k.measured"), .style = report::Series::Style::points};
    for (int k = 1; k <= study.modes() && study.rms[k] > least; ++k) add_point(predicted, k, percent * study.rms[k]);
    for (const Reconstruction& r : study.reconstructions)
        if (r.difference.area_weighted_rms > least) add_point(measured, r.k, percent * r.difference.area_weighted_rms);
    report::Plot plot{.id = id_of(study, "error_versus_k"),
                      .caption = words.line("error_versus_k", "mesh"_a = study.name(), "modes"_a = study.modes()),
                      .alt = words.line("error_versus_k.alt", "first"_a = readable(percent * study.rms[1]),
                                        "last"_a = readable(percent * study.rms[study.modes()]), "modes"_a = study.modes()),
                      .x_label = "number of eigenvectors k",
                      .y_label = words.line("error_versus_k.y"),
                      .log_x = true,
                      .log_y = true,
                      .series = {std::move(predicted), std::move(measured)}};
    if (const auto law = fall_of_the_error(study)) {
        report::Series fitted{.name = words.line("error_versus_k.fitted", "power"_a = readable(law->power, 2)),
                              .style = report::Series::Style::dashed};
        for (const int k : {law->first, law->last}) add_point(fitted, k, percent * law->at(k));
        plot.series.push_back(std::move(fitted));
        plot.caption += " " + words.line("error_versus_k.fit", "first"_a = law->first, "last"_a = law->last);
    }
    for (const double share : target_shares)
        if (const int k = smallest_k_below(study, share); k > 0)
            plot.markers.push_back({double(k), percent * study.rms[k], readable_percent(share, 1) + ": k = " + std::to_string(k)});
    return plot;
}

report::Table eigenvalue_table(const SpectralStudy& study) {
    std::vector<int> shown;
    for (int i = 1; i <= study.modes(); ++i)
        if (i <= 10 || std::ranges::find(study.reconstructions, i, &Reconstruction::k) != study.reconstructions.end()) shown.push_back(i);
    const Vector& mu = study.spectrum.eigenvalues;
    return table(id_of(study, "eigenvalues"), words.line("eigenvalues", "mesh"_a = study.name()), shown)
        .column("index", {.digits = count_digits}, std::identity())
        .column("μ", {.unit = "1/length²", .digits = 6}, [&](int i) { return mu[i - 1]; })
        .column("residual", {.digits = 2}, [&](int i) { return study.spectrum.residuals[i - 1]; })
        .column("wavelength", {.unit = "length"}, [&](int i) { return cell_of(wavelength(study, i), mu[i - 1] > 0); });
}

report::Table limb_table(const SpectralStudy& study, const LimbStudy& limbs) {
    const report::Column share{.unit = "% of box"};
    return table(id_of(study, "limbs"),
                 words.line("limbs", "mesh"_a = study.name(), "thin"_a = percent_of_box(study, limbs.thin_diameter),
                            "thick"_a = percent_of_box(study, limbs.thick_diameter)),
                 limbs.errors)
        .column("k", {.digits = count_digits}, &LimbErrors::k)
        .column("shortest wavelength", share,
                [&](auto& row) { return cell_of(percent_of(study) * wavelength(study, row.k), study.spectrum.eigenvalues[row.k - 1] > 0); })
        .column("error, thin", share, of_box(study, &LimbErrors::thin))
        .column("error, thick", share, of_box(study, &LimbErrors::thick))
        .column("thin / thick", [](auto& row) { return row.thin / row.thick; });
}

report::Table cost_table(const SpectralStudy& study, double factor_entries) {
    std::vector<ModeCost> costs;
    for (const Reconstruction& r : study.reconstructions) costs.push_back(mode_cost(r.k, study.vertices(), factor_entries));
    return table(id_of(study, "cost"), words.line("cost", "mesh"_a = study.name(), "entries"_a = readable(factor_entries, 4)), costs)
        .column("k", {.digits = count_digits}, &ModeCost::k)
        .column("solves", {.unit = "Mflop"}, [](auto& cost) { return 1e-6 * cost.solve_operations; })
        .column("orthogonalisation", {.unit = "Mflop"}, [](auto& cost) { return 1e-6 * cost.orthogonalise_operations; })
        .column("rebuilding", {.unit = "Mflop"}, [](auto& cost) { return 1e-6 * cost.rebuild_operations; })
        .column("Φ", {.unit = "MiB"}, &ModeCost::megabytes);
}

void add_checks(report::Section& section, const SpectralStudy& study) {
    const auto of_diagonal = [&](const char* key, double length, double tolerance = 1e-9) {
        add(section, report::within_rounding(check_at_most(words.line(key, "mesh"_a = study.name()), 0, length / study.diagonal, tolerance),
                                             coordinate_spacing(study.mesh()) / study.diagonal));
    };
    const int needles = study.preflight().needle_faces + study.preflight().zero_area_faces;
    append_checks(section, spectrum_checks(study.certificate, " on " + study.name(),
                                           needles > 0 ? words.line("check.needles", "faces"_a = needles) : ""));
    of_diagonal("check.parseval", largest_parseval_gap(study));
    of_diagonal("check.no_rise", largest_rise(study.rms), 1e-12);
    if (study.modes() == study.vertices()) of_diagonal("check.all_modes", study.reconstructions.back().difference.max);
}

/// The rebuilt meshes, written out. @return their k: "5, 15 and 60"
report::Parameter add_meshes(Answer& answer, const SpectralStudy& study) {
    Names counts;
    std::vector<int> numbers;
    for (const Reconstruction& r : study.reconstructions) {
        numbers.push_back(r.k);
        counts.push_back(std::to_string(r.k));
        const std::string file = id_of(study, "k" + counts.back()) + ".ply";
        answer.meshes.push_back({file, std::make_shared<const TriangleMesh>(r.mesh)});
        answer.section.output_meshes.push_back("meshes/" + file);
    }
    return {listed(counts), numbers};
}

void add_record(Answer& answer, const std::vector<Subject>& subjects) {
    report::Section& section = answer.section;
    Names done;
    for (const Subject& subject : subjects) {
        const SpectralStudy& study = subject.study;
        const report::Parameter counts = add_meshes(answer, study);
        done.push_back(words.line("extent.mesh", "mesh"_a = study.name(), "counts"_a = counts.text));
        section.parameters["k on " + study.name()] = counts;
        section.parameters["solver on " + study.name()] = study.spectrum.dense ? "dense" : "shift-invert Lanczos";
        section.timings.push_back({"eigenpairs of " + study.name(), study.seconds});
    }
    section.parameters["area form"] = "barycentric";
    const bool part = std::ranges::any_of(subjects, [](const Subject& s) { return !s.study.spectrum.dense; });
    section.extent = words.line(part ? "extent.certified" : "extent", "meshes"_a = listed(done));
}

/// Puts each figure and table after the paragraph that explains it.
void add_results(Answer& answer, const Subject& subject) {
    report::Section& section = answer.section;
    const SpectralStudy& study = subject.study;
    add_paragraphs(section, {what_is_seen(subject)});
    add_reconstruction_figure(answer, study);
    add_paragraphs(section, {better_or_not(study)});
    add(section, error_table(study));
    add_paragraphs(section, {how_fast(study)});
    add(section, error_plot(study));
    add_paragraphs(section, {what_modes_look_like(study)});
    add_eigenfunction_figure(answer, study);
    add_paragraphs(section, {thin_parts(study, subject.limbs)});
    if (subject.limbs.measured()) add(section, limb_table(study, subject.limbs));
    add_paragraphs(section, {the_large_k(subject)});
}

void add_appendix(Answer& answer, const std::vector<Subject>& subjects) {
    begin_appendix(answer.section);
    for (const Subject& subject : subjects) {
        add_further_figure(answer, subject.study);
        add(answer.section, eigenvalue_table(subject.study));
        if (!subject.study.spectrum.dense) add(answer.section, cost_table(subject.study, subject.factor_entries));
    }
}

}   // namespace

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer{section_of("q4")};
    report::Section& section = answer.section;
    const auto meshes = meshes_for(library, settings, {"armadillo"}, section);
    const auto subjects = studies_of(meshes, "eigenpairs", settings, progress, section, subject_of);
    section.answer = answer_in_short(subjects);
    add_paragraphs(section, {lead(subjects)});
    add_words(section, words, "method");
    add_paragraphs(section, {solvers(subjects)});
    add_words(section, words, "results");
    for (const Subject& subject : subjects) {
        add_results(answer, subject);
        add_checks(section, subject.study);
    }
    add_appendix(answer, subjects);
    add_record(answer, subjects);
    return answer;
}

extern const Chapter chapter{
    .id = "q4",
    .code = {{"smallest_eigenpairs", "src/geometry/spectrum/laplace_spectrum.cpp"},
             {"certify_spectrum", "src/geometry/spectrum/spectrum_certificate.cpp"},
             {"reconstruct", "src/geometry/spectrum/spectral_reconstruction.cpp"},
             {"reconstruction_rms", "src/geometry/spectrum/spectral_reconstruction.cpp"},
             {"local_thickness", "src/geometry/measures/local_thickness.cpp"},
             {"answer", "src/questions/q4_spectral/chapter.cpp"}},
    .answer = answer,
};

}   // namespace meshfolio::q4_spectral
