// Certificates: spectra proved complete, operators checked by identities, and planted faults that these checks must find.
#include "geometry/curvature/curvature.h"
#include "geometry/measures/mesh_laws.h"
#include "questions/certificates/parts.h"
#include "questions/certificates/planted_faults.h"

namespace meshfolio::certificates {

namespace {

/// One mesh with its operator, its smallest modes and their certificate.
struct Certified : OnMesh {
    LaplaceBeltrami laplacian;
    Vector angle_deficits;   // [rad]
    int without_area = 0;    // triangles
    SpectrumCertificate certificate;
    int modes = 0;

    SurfaceClaims claims() const {
        const Preflight& p = source->preflight();
        return {p.manifold(), p.orientable, p.encloses_volume(), p.euler_characteristic};
    }
};

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
        .column("verdict", of([](const C& c) {
                    if (c.says_nothing()) return words.line("verdict.empty");
                    const Proof verdict = c.verdict();
                    return verdict == Proof::proved ? "proved" : verdict == Proof::refuted ? "refuted" : words.line("verdict.open");
                }));
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

/// Certifies the meshes of the settings, else the user's own, else those of five roles that can be used; the preflight reports the others.
/// If no mesh has an operator, the failed checks say why, and the preflight still stands.
std::vector<Certified> certified_meshes(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress,
                                        report::Section& section) try {
    LibraryMeshes meshes;
    if (!settings.meshes.empty() || library.has_own_meshes()) {
        meshes = meshes_for(library, settings, {}, section);
    } else {
        for (const char* role : {"armadillo", "cube", "bumpy_cube", "fandisk", "lilium"}) {
            try {
                meshes.push_back(library.role(role));
                enter_input(*meshes.back(), section);
            } catch (const InputError&) {
            }
        }
    }
    return studies_of(meshes, "certificates", settings, progress, section, certified);
} catch (const SolverError&) {
    return {};
}

}   // namespace

Certificates add_certificates(report::Section& section, const MeshLibrary& library, const QuestionSettings& settings,
                              const Progress& progress) {
    const std::vector<Certified> meshes = certified_meshes(library, settings, progress, section);
    progress("planted faults");
    const Specimen specimen = ellipsoid_specimen();
    const std::vector<FaultTrial> trials = trials_of(specimen);

    add_words(section, words, "certificates");
    if (!meshes.empty()) add(section, spectrum_table(meshes), operator_table(meshes));
    add(section, fault_table(trials));
    for (const Certified& mesh : meshes) {
        const std::string on = " on " + mesh.name();
        append_checks(section, spectrum_checks(mesh.certificate, on));
        append_checks(section, operator_checks(mesh.mesh(), mesh.laplacian, on, mesh.without_area));
        append_checks(section, surface_checks(mesh.mesh(), mesh.angle_deficits, mesh.claims(), on));
    }
    Names missed;
    int alone = 0;   // faults that only the named check sees
    for (const FaultTrial& trial : trials) {
        add(section, check_of(trial));
        if (!trial.caught()) missed.push_back("“" + trial.fault + "”");
        alone += trial.caught() && trial.also_seen_by.empty() ? 1 : 0;
    }
    const auto names_with = [&](Proof verdict) {
        return names_where(meshes, [&](const Certified& mesh) { return mesh.certificate.verdict() == verdict; });
    };
    const Names proved = names_with(Proof::proved);
    add_words(section, words, "certificates.found", "proved"_a = listed(proved), "refuted"_a = listed(names_with(Proof::refuted)),
              "open"_a = listed(names_with(Proof::undecided)), "faults"_a = trials.size(), "modes"_a = specimen.spectrum.eigenvalues.size(),
              "vertices"_a = specimen.mesh.vertex_count(), "missed"_a = listed(missed), "alone"_a = alone);
    if (!meshes.empty()) section.parameters["modes"] = meshes.front().modes;
    return {names_of(meshes), static_cast<int>(proved.size()), static_cast<int>(trials.size()), static_cast<int>(missed.size())};
}

}   // namespace meshfolio::certificates
