// Certificates: spectra proved complete where rounding lets them, operators held against identities, and faults planted to show that
// these checks can fail.
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "geometry/curvature/curvature.h"
#include "geometry/measures/mesh_laws.h"
#include "questions/certificates/planted_faults.h"
#include "questions/core/section_tools.h"
#include "questions/core/study_list.h"

namespace meshfolio::certificates {

namespace {

using report::math;
using report::ref;

/// One mesh with its operator, its smallest modes and what was measured on them.
struct Certified {
    std::shared_ptr<const LibraryMesh> source;
    LaplaceBeltrami laplacian;
    Vector angle_deficits;   // [rad]
    int without_area = 0;    // triangles
    SpectrumCertificate certificate;
    int modes = 0;

    const std::string& name() const { return source->name; }
    const TriangleMesh& mesh() const { return source->mesh(); }
    SurfaceClaims claims() const {
        const Preflight& p = source->prepared->preflight;
        return {p.manifold(), p.orientable, p.closed(), p.euler_characteristic};
    }
};

Certified certified(std::shared_ptr<const LibraryMesh> source, const QuestionSettings& settings) {
    Certified c;
    c.source = std::move(source);
    c.laplacian = laplace_beltrami(c.mesh());
    c.angle_deficits = angle_deficit(c.mesh(), c.source->prepared->topology);
    corner_cotangents(c.mesh(), &c.without_area);
    const int k = settings.k.empty() ? 15 : *std::max_element(settings.k.begin(), settings.k.end());
    const Spectrum spectrum = smallest_eigenpairs(c.laplacian, k);
    c.modes = static_cast<int>(spectrum.eigenvalues.size());
    c.certificate = certify_spectrum(c.mesh(), c.laplacian, spectrum);
    return c;
}

// ---- results ----------------------------------------------------------------------------------------------------------

std::string words_of(Proof proof) {
    return proof == Proof::proved ? "proved" : proof == Proof::refuted ? "refuted" : "cannot be proved here";
}

void add_spectrum_table(report::Section& section, const std::vector<Certified>& meshes) {
    report::Table table;
    table.id = "certificates_spectra";
    table.caption =
        "Certificates of the smallest eigenpairs. Residual: of the pair nearest to its limit. Counted: negative pivots of −C − σM; found: "
        "eigenvalues of the spectrum below the same σ. δ: by how much rounding may move σ in that count; gap: distance of σ from the "
        "values found, less what their residuals leave open. Proved needs δ < gap. Where k cuts a cluster of equal eigenvalues, σ lies "
        "just below the cluster.";
    table.columns = {{"mesh", "", 3},         {"k", "", 6},          {"residual", "", 2},   {"its limit", "", 2}, {"‖ΦᵀMΦ − I‖", "", 2},
                     {"Parseval gap", "", 2}, {"σ", "1/length²", 4}, {"counted", "", 6},    {"found", "", 6},     {"δ", "1/length²", 2},
                     {"gap", "1/length²", 2}, {"zeros", "", 6},      {"components", "", 6}, {"verdict", "", 3}};
    for (const Certified& mesh : meshes) {
        const SpectrumCertificate& c = mesh.certificate;
        table.rows.push_back({mesh.name(), double(mesh.modes), c.residual, c.residual_limit, c.orthonormality_error, c.parseval_gap,
                              c.shift, cell_of(c.counted_below, c.counted_below >= 0), double(c.found_below), c.delta, c.gap,
                              double(c.zero_eigenvalues), double(c.components), words_of(c.verdict())});
    }
    section.blocks.push_back(std::move(table));
}

void add_operator_table(report::Section& section, const std::vector<Certified>& meshes) {
    report::Table table;
    table.id = "certificates_operators";
    table.caption =
        "Identities that need no known surface, as deviations. Energy: of the positions over the area, less 1. First variation: CX + "
        "∇area at the worst vertex, – where triangles have no area and so no normal. Flux: |Σ A n| over the area, – for open meshes. "
        "Gauss–Bonnet is – where the mesh is not "
        "manifold.";
    table.columns = {
        {"mesh", "", 3},        {"asymmetry of C", "", 2}, {"row sums", "", 2},    {"energy/area − 1", "", 2}, {"first variation", "", 2},
        {"ΣM/area − 1", "", 2}, {"flux", "", 2},           {"Gauss–Bonnet", "", 2}};
    for (const Certified& mesh : meshes) {
        const SurfaceClaims claims = mesh.claims();
        const bool sealed = claims.closed && claims.manifold && claims.orientable;
        table.rows.push_back({mesh.name(), asymmetry(mesh.laplacian.C), row_sum_error(mesh.laplacian.C),
                              energy_over_area(mesh.mesh(), mesh.laplacian.C) - 1,
                              cell_of(first_variation_error(mesh.mesh(), mesh.laplacian.C), mesh.without_area == 0),
                              mass_over_area(mesh.mesh(), mesh.laplacian.M) - 1, cell_of(flux_over_area(mesh.mesh()), sealed),
                              cell_of(gauss_bonnet_error(mesh.angle_deficits, claims.euler_characteristic), claims.manifold)});
    }
    section.blocks.push_back(std::move(table));
}

std::string requirement(const report::Check& check) {
    const bool whole = check.expected == std::round(check.expected);
    const std::string limit = whole ? std::to_string(std::lround(check.expected)) : readable(check.expected, 2);
    if (check.kind == report::Check::Kind::at_most) return "≤ " + limit;
    if (check.kind == report::Check::Kind::at_least) return "≥ " + limit;
    return check.tolerance > 0 ? limit + " ± " + readable(check.tolerance, 2) : limit;
}

void add_fault_table(report::Section& section, const std::vector<FaultTrial>& trials) {
    report::Table table;
    table.id = "certificates_faults";
    table.caption =
        "Faults planted in sound data, each against the check that is to see it; also seen by: how many of the other checks passed "
        "without the fault and failed with it.";
    table.columns = {{"planted fault"},         {"named check"}, {"must be"},     {"sound", "", 5},
                     {"with the fault", "", 5}, {"caught"},      {"also seen by"}};
    for (const FaultTrial& trial : trials) {
        table.rows.push_back({trial.fault, trial.sound.name, requirement(trial.sound), cell_of(trial.sound.measured),
                              cell_of(trial.faulty.measured), std::string(trial.caught() ? "yes" : "no"),
                              double(trial.also_seen_by.size())});
    }
    section.blocks.push_back(std::move(table));
}

// ---- words ------------------------------------------------------------------------------------------------------------

void add_method(report::Section& section) {
    add_heading(section, "Method");
    add_paragraph(section,
                  "A certificate takes a spectrum from wherever it comes and measures, on the operator and the mesh alone, the residual of "
                  "each pair, M-orthonormality, and Parseval's identity with the tail ‖x − Φĉ‖² measured by itself. The residual is "
                  "relative to μ, and where μ is smaller to the operator's own unit, its median row over ΣM:");
    add_formula(section, "residual", "certificates_eq_residual");
    add_formula(section, "m_orthonormal");
    add_paragraph(section,
                  "That nothing is missing follows from a factorisation, not from the eigensolver: the negative pivots count the "
                  "eigenvalues below σ (Sylvester's law of inertia).");
    add_formula(section, "inertia", "certificates_eq_inertia");
    add_paragraph(
        section,
        "Rounding makes that the count of a nearby matrix, whose eigenvalues lie within δ of the true ones. δ is computed from the "
        "factor ",
        ref("higham_2002"),
        ". The count proves something only where δ is smaller than the distance of σ from the values found, "
        "which is why σ lies in the middle of a gap. Otherwise completeness is neither proved nor refuted: it cannot be proved here.");
    add_paragraph(section,
                  "The zero eigenvalues must be as many as the components of the triangles. The operator itself is held against "
                  "identities that are true on every mesh: ",
                  math("C"),
                  " is symmetric, its rows sum to 0, the Dirichlet energy of "
                  "the positions and the sum of ",
                  math("M"), " are the area, and ", math("CX"),
                  " is minus the gradient of the area, which normals and edges give without a cotangent.");
}

void add_discussion(report::Section& section, const std::vector<Certified>& meshes, const std::vector<FaultTrial>& trials,
                    const Specimen& specimen) {
    add_heading(section, "Discussion");
    std::vector<std::string> proved, refuted, open;
    for (const Certified& mesh : meshes) {
        const Proof verdict = mesh.certificate.verdict();
        (verdict == Proof::proved ? proved : verdict == Proof::refuted ? refuted : open).push_back(mesh.name());
    }
    report::Text text;
    if (!proved.empty()) {
        report::extend(text, "No eigenvalue is missing below σ on ", listed(proved),
                       ": that is proved, and the pairs found are right within "
                       "their residuals (",
                       ref("certificates_spectra"), "). ");
    }
    if (!refuted.empty()) report::extend(text, "It is refuted on ", listed(refuted), ": the failed checks below say what is wrong. ");
    if (!open.empty()) report::extend(text, "It cannot be proved here on ", listed(open), ": rounding may move σ by more than its gap.");
    section.blocks.push_back(report::Paragraph{std::move(text)});

    std::vector<std::string> missed, alone;
    for (const FaultTrial& trial : trials) {
        if (!trial.caught()) missed.push_back("“" + trial.fault + "”");
        if (trial.caught() && trial.also_seen_by.empty()) alone.push_back("“" + trial.fault + "”");
    }
    report::Text faults = report::text("A check that cannot fail proves nothing. ", counted(static_cast<int>(trials.size()), "fault"),
                                       " were planted, one at a time, in the operator and the ",
                                       counted(static_cast<int>(specimen.spectrum.eigenvalues.size()), "smallest mode"),
                                       " of the bundled ellipsoid (", std::to_string(specimen.mesh.vertex_count()), " vertices): ");
    if (missed.empty()) {
        report::extend(faults, "each was caught by the check named in ", ref("certificates_faults"), ". ");
    } else {
        report::extend(faults, listed(missed), missed.size() == 1 ? " was" : " were", " not caught by the check named in ",
                       ref("certificates_faults"), ". ");
    }
    if (!alone.empty()) report::extend(faults, "No other check would have seen ", listed(alone), ".");
    section.blocks.push_back(report::Paragraph{std::move(faults)});
}

}   // namespace

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer;
    report::Section& section = answer.section;
    section = section_of("certificates");
    const auto sources = meshes_for(library, settings, {"armadillo", "cube", "bumpy_cube", "fandisk", "lilium"}, section);
    const auto meshes = studies_of(sources, "certificates", settings, progress, section, certified);
    progress("planted faults");
    const Specimen specimen = bundled_specimen();
    const std::vector<FaultTrial> trials = trials_of(specimen);

    add_method(section);
    add_heading(section, "Results");
    add_spectrum_table(section, meshes);
    add_operator_table(section, meshes);
    add_fault_table(section, trials);
    for (const Certified& mesh : meshes) {
        const std::string on = " on " + mesh.name();
        append_checks(section, spectrum_checks(mesh.certificate, on));
        append_checks(section, operator_checks(mesh.mesh(), mesh.laplacian, on, mesh.without_area));
        append_checks(section, surface_checks(mesh.mesh(), mesh.angle_deficits, mesh.claims(), on));
    }
    for (const FaultTrial& trial : trials) section.checks.push_back(check_of(trial));
    add_discussion(section, meshes, trials, specimen);

    const auto caught = std::count_if(trials.begin(), trials.end(), [](const FaultTrial& t) { return t.caught(); });
    const auto complete = std::count_if(meshes.begin(), meshes.end(), [](const Certified& c) { return c.certificate.holds(); });
    section.parameters["modes"] = std::to_string(meshes.front().modes);
    section.extent = "spectra of " + listed(names_of(meshes)) + " examined, " + std::to_string(trials.size()) + " faults planted";
    section.findings.push_back(
        {report::text("Certificates: ", std::to_string(complete), " of ", counted(static_cast<int>(meshes.size()), "spectrum", "spectra"),
                      " proved complete by inertia with its rounding; ", std::to_string(caught), " of ", std::to_string(trials.size()),
                      " planted faults caught by the check named for each."),
         77});
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
