// Certificates: spectra proved complete, operators checked by identities, and planted faults that these checks must find.
#include "geometry/curvature/curvature.h"
#include "geometry/measures/mesh_laws.h"
#include "questions/certificates/parts.h"

namespace meshfolio::certificates {

namespace {

std::string words_of(Proof proof) {
    return proof == Proof::proved ? "proved" : proof == Proof::refuted ? "refuted" : words.line("verdict.open");
}

std::string requirement(const report::Check& check) {
    const bool whole = check.expected == std::round(check.expected);
    const std::string limit = whole ? std::to_string(std::lround(check.expected)) : readable(check.expected, 2);
    if (check.kind == report::Check::Kind::at_most) return "≤ " + limit;
    if (check.kind == report::Check::Kind::at_least) return "≥ " + limit;
    return check.tolerance > 0 ? limit + " ± " + readable(check.tolerance, 2) : limit;
}

report::Table spectrum_table(const std::vector<Certified>& meshes) {
    using C = SpectrumCertificate;
    const report::Column number{.digits = 2}, count{.digits = 6}, width{.unit = "1/length²", .digits = 2};
    const auto of = [](auto value) { return [value](const Certified& mesh) { return std::invoke(value, mesh.certificate); }; };
    return table("certificates_spectra", words.line("spectra"), meshes)
        .column("mesh", &Certified::name)
        .column("k", count, &Certified::modes)
        .column("residual", number, of(&C::residual))
        .column("its limit", number, of(&C::residual_limit))
        .column("‖ΦᵀMΦ − I‖", number, of(&C::orthonormality_error))
        .column("Parseval gap", number, of(&C::parseval_gap))
        .column("σ", {.unit = "1/length²", .digits = 4}, of(&C::shift))
        .column("counted", count, of([](const C& c) { return cell_of(c.counted_below, c.counted_below >= 0); }))
        .column("found", count, of(&C::found_below))
        .column("δ", width, of(&C::delta))
        .column("gap", width, of(&C::gap))
        .column("zeros", count, of(&C::zero_eigenvalues))
        .column("components", count, of(&C::components))
        .column("verdict", of([](const C& c) { return c.says_nothing() ? words.line("verdict.empty") : words_of(c.verdict()); }));
}

report::Table operator_table(const std::vector<Certified>& meshes) {
    const auto flux = [](const Certified& m) {
        const SurfaceClaims claims = m.claims();
        return cell_of(flux_over_area(m.mesh()), claims.closed && claims.manifold && claims.orientable);
    };
    const auto gauss_bonnet = [](const Certified& m) {
        return cell_of(gauss_bonnet_error(m.angle_deficits, m.claims().euler_characteristic), m.claims().manifold);
    };
    const report::Column deviation{.digits = 2};
    return table("certificates_operators", words.line("operators"), meshes)
        .column("mesh", &Certified::name)
        .column("asymmetry of C", deviation, [](auto& m) { return asymmetry(m.laplacian.C); })
        .column("row sums", deviation, [](auto& m) { return row_sum_error(m.laplacian.C); })
        .column("energy/area − 1", deviation, [](auto& m) { return energy_over_area(m.mesh(), m.laplacian.C) - 1; })
        .column("first variation", deviation,
                [](auto& m) { return cell_of(first_variation_error(m.mesh(), m.laplacian.C), m.without_area == 0); })
        .column("ΣM/area − 1", deviation, [](auto& m) { return mass_over_area(m.mesh(), m.laplacian.M) - 1; })
        .column("flux", deviation, flux)
        .column("Gauss–Bonnet", deviation, gauss_bonnet);
}

report::Table fault_table(const std::vector<FaultTrial>& trials) {
    return table("certificates_faults", words.line("faults"), trials)
        .column("planted fault", &FaultTrial::fault)
        .column("named check", [](auto& trial) { return trial.sound.name; })
        .column("must be", [](auto& trial) { return requirement(trial.sound); })
        .column("sound", {.digits = 5}, [](auto& trial) { return cell_of(trial.sound.measured); })
        .column("with the fault", {.digits = 5}, [](auto& trial) { return cell_of(trial.faulty.measured); })
        .column("caught", [](auto& trial) { return trial.caught() ? "yes" : "no"; })
        .column("also seen by", [](auto& trial) { return trial.also_seen_by.size(); });
}

Certified certified(SharedMesh source, const QuestionSettings& settings) {
    Certified c;
    c.source = std::move(source);
    c.laplacian = laplace_beltrami(c.mesh());
    c.angle_deficits = angle_deficit(c.mesh(), c.topology());
    c.without_area = c.source->preflight().zero_area_faces;
    const Spectrum spectrum =
        smallest_eigenpairs(c.laplacian, settings.k.empty() ? 15 : std::ranges::max(settings.k), {.dense_below = 200});
    c.modes = static_cast<int>(spectrum.eigenvalues.size());
    c.certificate = certify_spectrum(c.mesh(), c.laplacian, spectrum);
    return c;
}

void add_checks(report::Section& section, const std::vector<Certified>& meshes, const std::vector<FaultTrial>& trials) {
    for (const Certified& mesh : meshes) {
        const std::string on = " on " + mesh.name();
        append_checks(section, spectrum_checks(mesh.certificate, on));
        append_checks(section, operator_checks(mesh.mesh(), mesh.laplacian, on, mesh.without_area));
        append_checks(section, surface_checks(mesh.mesh(), mesh.angle_deficits, mesh.claims(), on));
    }
    for (const FaultTrial& trial : trials) add(section, check_of(trial));
}

report::Text about_spectra(const std::vector<Certified>& meshes) {
    Names proved, refuted, open;
    for (const Certified& mesh : meshes) {
        const Proof verdict = mesh.certificate.verdict();
        (verdict == Proof::proved ? proved : verdict == Proof::refuted ? refuted : open).push_back(mesh.name());
    }
    report::Text t;
    if (!proved.empty()) report::extend(t, words.say("proved", "meshes"_a = listed(proved)), " ");
    if (!refuted.empty()) report::extend(t, words.say("refuted", "meshes"_a = listed(refuted)), " ");
    if (!open.empty()) report::extend(t, words.say("open", "meshes"_a = listed(open)));
    return t;
}

report::Text about_faults(const std::vector<FaultTrial>& trials, const Specimen& specimen) {
    Names missed;
    int alone = 0;
    for (const FaultTrial& trial : trials) {
        if (!trial.caught()) missed.push_back("“" + trial.fault + "”");
        alone += trial.caught() && trial.also_seen_by.empty() ? 1 : 0;
    }
    const report::Text caught =
        missed.empty() ? words.say("planted.caught") : words.say("planted.missed", "missed"_a = listed(missed), "number"_a = missed.size());
    return paragraph_of({words.say("planted", "faults"_a = trials.size(), "modes"_a = specimen.spectrum.eigenvalues.size(),
                                   "vertices"_a = specimen.mesh.vertex_count(), "caught"_a = caught),
                         alone > 0 ? words.say("planted.alone", "alone"_a = alone) : report::Text()});
}

}   // namespace

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer{section_of("certificates")};
    report::Section& section = answer.section;
    const auto sources = meshes_for(library, settings, {"armadillo", "cube", "bumpy_cube", "fandisk", "lilium"}, section);
    const auto meshes = studies_of(sources, "certificates", settings, progress, section, certified);
    progress("planted faults");
    const Specimen specimen = ellipsoid_specimen();
    const std::vector<FaultTrial> trials = trials_of(specimen);

    add_words(section, words, {"method", "results"});
    add(section, spectrum_table(meshes), operator_table(meshes), fault_table(trials));
    add_checks(section, meshes, trials);
    add_words(section, words, "discussion");
    add_paragraphs(section, {about_spectra(meshes), about_faults(trials, specimen)});

    section.parameters["modes"] = meshes.front().modes;
    section.extent = words.line("extent", "meshes"_a = listed(names_of(meshes)), "faults"_a = trials.size());
    const auto complete = std::ranges::count_if(meshes, [](const Certified& c) { return c.certificate.holds(); });
    const auto caught = std::ranges::count_if(trials, &FaultTrial::caught);
    const bool all = complete == std::ranges::ssize(meshes) && caught == std::ranges::ssize(trials);
    section.answer = words.say(all ? "answer.all" : "answer", "complete"_a = complete, "meshes"_a = meshes.size(), "caught"_a = caught,
                               "faults"_a = trials.size());
    return answer;
}

extern const Chapter chapter{
    .id = "certificates",
    .code = {{"certify_spectrum", "src/geometry/spectrum/spectrum_certificate.cpp"},
             {"first_variation_error", "src/geometry/measures/mesh_laws.cpp"},
             {"planted_faults", "src/questions/certificates/planted_faults.cpp"},
             {"answer", "src/questions/certificates/chapter.cpp"}},
    .answer = answer,
};

}   // namespace meshfolio::certificates
