// Certificates: spectra proved complete, operators checked by identities, planted faults that these checks must find; and preflight.
#include "geometry/curvature/curvature.h"
#include "geometry/measures/mesh_laws.h"
#include "questions/certificates/parts.h"

namespace meshfolio::certificates {

namespace {

std::string words_of(Proof proof) {
    return proof == Proof::proved ? "proved" : proof == Proof::refuted ? "refuted" : words.line("verdict.open");
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
        .column("sound", {.digits = 3}, [](auto& trial) { return cell_of(trial.sound.measured); })
        .column("with the fault", {.digits = 3}, [](auto& trial) { return cell_of(trial.faulty.measured); })
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

Names names_with(const std::vector<Certified>& meshes, Proof verdict) {
    return names_where(meshes, [&](const Certified& mesh) { return mesh.certificate.verdict() == verdict; });
}

report::Facts facts_of(const std::vector<Certified>& meshes, const std::vector<FaultTrial>& trials, const Specimen& specimen) {
    Names missed;
    int alone = 0;
    for (const FaultTrial& trial : trials) {
        if (!trial.caught()) missed.push_back("“" + trial.fault + "”");
        alone += trial.caught() && trial.also_seen_by.empty() ? 1 : 0;
    }
    return {"proved"_a = listed(names_with(meshes, Proof::proved)),
            "refuted"_a = listed(names_with(meshes, Proof::refuted)),
            "open"_a = listed(names_with(meshes, Proof::undecided)),
            "faults"_a = trials.size(),
            "modes"_a = specimen.spectrum.eigenvalues.size(),
            "vertices"_a = specimen.mesh.vertex_count(),
            "missed"_a = listed(missed),
            "alone"_a = alone};
}

/// Finds the meshes of the settings, else the user's own, else those of five roles that can be used: the preflight tells of the others.
LibraryMeshes meshes_of(const MeshLibrary& library, const QuestionSettings& settings, report::Section& section) {
    if (!settings.meshes.empty() || library.has_own_meshes()) return meshes_for(library, settings, {}, section);
    LibraryMeshes meshes;
    for (const char* role : {"armadillo", "cube", "bumpy_cube", "fandisk", "lilium"}) {
        try {
            meshes.push_back(library.role(role));
            enter_input(*meshes.back(), section);
        } catch (const InputError&) {
        }
    }
    return meshes;
}

/// Certifies one mesh after the other. Where none has an operator, the failed checks say why, and the preflight still stands.
std::vector<Certified> certified_meshes(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress,
                                        report::Section& section) try {
    return studies_of(meshes_of(library, settings, section), "certificates", settings, progress, section, certified);
} catch (const SolverError&) {
    return {};
}

}   // namespace

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer{section_of("certificates")};
    report::Section& section = answer.section;
    const std::vector<Inspected> inspected = inspected_meshes(library, settings, progress, section);
    const std::vector<Certified> meshes = certified_meshes(library, settings, progress, section);
    progress("planted faults");
    const Specimen specimen = ellipsoid_specimen();
    const std::vector<FaultTrial> trials = trials_of(specimen);

    add_words(section, words, "certificates");
    if (!meshes.empty()) add(section, spectrum_table(meshes), operator_table(meshes));
    add(section, fault_table(trials));
    add_checks(section, meshes, trials);
    add_words(section, words, "certificates.found", facts_of(meshes, trials, specimen));
    add_preflight(section, inspected);

    if (!meshes.empty()) section.parameters["modes"] = meshes.front().modes;
    section.extent =
        words.line("extent", "meshes"_a = inspected.size(), "spectra"_a = listed(names_of(meshes)), "faults"_a = trials.size());
    const auto complete = std::ranges::count_if(meshes, [](const Certified& c) { return c.certificate.holds(); });
    const auto caught = std::ranges::count_if(trials, &FaultTrial::caught);
    const auto flawed = std::ranges::ssize(inspected) - std::ranges::count_if(inspected, &Inspected::is_sound);
    section.answer =
        words.say("answer", "spectra"_a = meshes.size(), "complete"_a = complete, "all_complete"_a = complete == std::ranges::ssize(meshes),
                  "faults"_a = trials.size(), "missed"_a = std::ranges::ssize(trials) - caught, "flawed"_a = flawed,
                  "meshes"_a = inspected.size(), "several"_a = inspected.size() > 1);
    return answer;
}

extern const Chapter chapter{
    .id = "certificates",
    .code = {{"certify_spectrum", "src/geometry/spectrum/spectrum_certificate.cpp"},
             {"first_variation_error", "src/geometry/measures/mesh_laws.cpp"},
             {"planted_faults", "src/questions/certificates/planted_faults.cpp"},
             {"prepare_mesh", "src/mesh/mesh_checks.cpp"},
             {"consistent_orientation", "src/mesh/orientation.cpp"},
             {"defect_list", "src/questions/certificates/defects.cpp"},
             {"change_when_moved", "src/geometry/measures/mesh_facts.cpp"},
             {"answer", "src/questions/certificates/chapter.cpp"}},
    .roles = {"plane", "lilium", "armadillo", "plane_ns", "fandisk_ns", "cube", "cube8", "sphere", "ellipsoid", "torus", "bumpy_cube",
              "saddle", "fandisk"},
    .cost = {.cpu = {{0.6, 0, 12}, {0.5, 3.2}}, .memory = {{2, 125}, {3, 55}}, .whole_cpu = {0, 1.2}},
    .answer = answer,
    .never_left_out = true,
    .verifies_program = true,
};

}   // namespace meshfolio::certificates
