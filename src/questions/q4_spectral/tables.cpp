#include "geometry/measures/mesh_facts.h"
#include "questions/bench/law_checks.h"
#include "questions/q4_spectral/study.h"

namespace meshfolio::q4_spectral {

namespace {

using Style = report::Series::Style;

constexpr auto count_digits = 6;

/// Returns a function from an element to a cell with length_of(element) in % of the box diagonal; 0 if that is rounding.
auto of_box(const SpectralStudy& study, auto length_of) {
    return [&study, length_of](auto& element) {
        const double length = std::invoke(length_of, element);
        return cell_of(length < rounding * study.diagonal ? 0 : percent_of(study) * length);
    };
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

}   // namespace

report::Table error_table(const Subject& subject) {
    const SpectralStudy& study = subject.study;
    const report::Column share{.unit = "% of box"};
    const auto place = [&](auto& r) { return static_cast<std::size_t>(&r - study.reconstructions.data()); };
    return table(id_of(study, "errors"),
                 words.line("errors", "mesh"_a = study.name(), "diagonal"_a = readable(study.diagonal),
                            "limit"_a = readable_percent(seen_error, 1), "exact"_a = is_exact(study, study.modes())),
                 study.reconstructions)
        .column("k", {.digits = count_digits}, &Reconstruction::k)
        .column("rms", {.unit = share.unit, .digits = 2}, of_box(study, [](auto& r) { return r.difference.area_weighted_rms; }))
        .column("off", {.unit = "% of area", .digits = 2}, [&](auto& r) { return 100 * share_seen(study, r); })
        .column("farther off", {.unit = "% of vertices", .digits = 2},
                [&](auto& r) { return cell_of(place(r) == 0 ? NAN : 100 * share_made_worse(study, *(&r - 1), r)); })
        .column("maximum", share, of_box(study, [](auto& r) { return r.difference.max; }))
        .column("Hausdorff", share, of_box(study, [&](auto& r) { return subject.hausdorff[place(r)]; }))
        .column("mean normal angle", {.unit = "°"},
                [&](auto& r) { return cell_of(is_exact(study, r.k) ? 0 : r.difference.mean_normal_angle * 180 / pi); })
        .column("volume", {.unit = "% of original"}, [](auto& r) { return cell_of(100 * r.difference.volume_ratio); });
}

report::Plot error_plot(const SpectralStudy& study) {
    const double percent = percent_of(study), least = rounding * study.diagonal;   // smaller errors would squeeze the logarithmic axis
    report::Series coefficients{.name = words.line("error_versus_k.coefficients"), .style = Style::points};
    report::Series predicted{.name = words.line("error_versus_k.predicted")};
    report::Series measured{.name = words.line("error_versus_k.measured"), .style = Style::points};
    const Vector sizes = coefficient_sizes(study.spectrum, study.laplacian.M, study.mesh().X);
    // Coefficients far below the error left are not drawn.
    for (int k = zero_modes(study) + 1; k <= study.modes() && study.rms[k] > least; ++k)
        if (sizes[k - 1] > 1e-3 * study.rms[k]) add_point(coefficients, k, percent * sizes[k - 1]);
    for (int k = 1; k <= study.modes() && study.rms[k] > least; ++k) add_point(predicted, k, percent * study.rms[k]);
    for (const Reconstruction& r : study.reconstructions)
        if (r.difference.area_weighted_rms > least) add_point(measured, r.k, percent * r.difference.area_weighted_rms);
    report::Plot plot{.id = id_of(study, "error_versus_k"),
                      .alt = words.line("error_versus_k.alt", "first"_a = readable(percent * study.rms[1]),
                                        "last"_a = readable(percent * study.rms[study.modes()]), "modes"_a = study.modes()),
                      .x_label = words.line("error_versus_k.x"),
                      .y_label = words.line("error_versus_k.y"),
                      .log_x = true,
                      .log_y = true,
                      .series = {std::move(predicted), std::move(measured), std::move(coefficients)}};
    const auto law = fall_of_the_error(study);
    plot.caption = words.line("error_versus_k", "mesh"_a = study.name(), "modes"_a = study.modes(), "fitted"_a = law.has_value(),
                              "first"_a = law ? law->first : 0, "last"_a = law ? law->last : 0);
    if (law) {
        report::Series fitted{.name = words.line("error_versus_k.fitted", "power"_a = readable(law->power, 2)), .style = Style::dashed};
        for (const int k : {law->first, law->last}) add_point(fitted, k, percent * law->at(k));
        plot.series.push_back(std::move(fitted));
    }
    for (const double share : {0.1, 0.01, 0.001})   // the smallest k with such an error is marked
        if (const int k = smallest_k_below(study, share); k > 0)
            plot.markers.push_back({double(k), percent * study.rms[k], readable_percent(share, 1) + ": k = " + std::to_string(k)});
    return plot;
}

report::Plot spectrum_plot(const SpectralStudy& study) {
    report::Series measured{.name = words.line("spectrum.measured")};
    report::Series weyl{.name = words.line("spectrum.weyl"), .style = Style::dashed};
    for (int k = zero_modes(study) + 1; k <= study.modes(); ++k) {
        add_point(measured, k, study.spectrum.eigenvalues[k - 1]);
        add_point(weyl, k, weyl_eigenvalue(study, k));
    }
    return {.id = id_of(study, "spectrum"),
            .caption = words.line("spectrum", "mesh"_a = study.name(), "open"_a = !study.preflight().closed()),
            .x_label = words.line("spectrum.x"),
            .y_label = words.line("spectrum.y"),
            .log_x = true,
            .log_y = true,
            .series = {std::move(measured), std::move(weyl)}};
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

void add_results(Answer& answer, const Subjects& subjects) {
    report::Section& section = answer.section;
    for (const Subject& subject : subjects) {
        const SpectralStudy& study = subject.study;
        const report::Facts facts = facts_of(subjects, &subject - subjects.data());
        add_words(section, words, "pictures", facts);
        add_reconstruction_figure(answer, study);
        add_words(section, words, "better", facts);
        add(section, error_table(subject), error_plot(study));
        for (const char* key : {"rate", "modes"}) add_words(section, words, key, facts);
        add_eigenfunction_figure(answer, study);
        if (study.modes() > zero_modes(study) + 1) add(section, spectrum_plot(study));
        add_words(section, words, "thin", facts);
        if (subject.limbs.measured()) add(section, limb_table(study, subject.limbs));
        add_words(section, words, "large", facts);
        add_checks(section, study);
    }
}

void add_record(Answer& answer, const Subjects& subjects) {
    report::Section& section = answer.section;
    Names done;
    for (const Subject& subject : subjects) {
        const SpectralStudy& study = subject.study;
        Names counts;
        std::vector<int> numbers;
        for (const Reconstruction& r : study.reconstructions) {
            numbers.push_back(r.k);
            counts.push_back(std::to_string(r.k));
            const std::string file = id_of(study, "k" + counts.back()) + ".ply";
            answer.meshes.push_back({file, std::make_shared<const TriangleMesh>(r.mesh)});
            section.output_meshes.push_back("meshes/" + file);
        }
        done.push_back(words.line("extent.mesh", "mesh"_a = study.name(), "counts"_a = listed(counts)));
        section.parameters["k on " + study.name()] = {listed(counts), numbers};
        section.parameters["solver on " + study.name()] = study.spectrum.dense ? "dense" : "shift-invert Lanczos";
        section.timings.push_back({"eigenpairs of " + study.name(), study.seconds});
    }
    section.parameters["area form"] = "barycentric";
    section.extent = words.line("extent", "meshes"_a = listed(done),
                                "iterated"_a = std::ranges::any_of(subjects, [](const Subject& s) { return !s.study.spectrum.dense; }));
}

}   // namespace meshfolio::q4_spectral
