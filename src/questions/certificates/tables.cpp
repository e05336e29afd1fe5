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

}   // namespace

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
        .column("verdict", of([](const C& c) { return words_of(c.verdict()); }));
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

}   // namespace meshfolio::certificates
