// The section "stability": the limit of explicit smoothing proved, and what happens on both sides of it.
#include "questions/stability/parts.h"

#include "base/number_text.h"
#include "questions/core/section_tools.h"
#include "questions/core/study_list.h"
#include "questions/stability/figures.h"

namespace meshfolio::stability {

namespace {

using report::math;
using report::ref;

void add_method(report::Section& section) {
    add_heading(section, "Method");
    add_paragraph(section, "A step of explicit smoothing multiplies each mode by ", math("1 − λμ"), ", so that no mode grows as long as");
    add_formula(section, "stability_limit", "stability_eq_limit");
    add_paragraph(section, "Lanczos finds ", math("μ_max"),
                  " but proves nothing: what it returns may be too small, and the step too large. Two facts enclose ", math("μ_max"),
                  ". Every vector proves a "
                  "lower bound by its Rayleigh quotient, and a Cholesky factorisation that runs to its end proves an upper one:");
    add_formula(section, "stability_certificate", "stability_eq_certificate");
    add_paragraph(
        section,
        "The rounding of the quotient and of the factorisation is bounded beforehand and counted in; the latter by the machine "
        "precision times the entries of the factor ",
        ref("rump_2006"),
        ". So the bounds hold for the matrices as stored, whose own entries were rounded when they were assembled. If Lanczos had "
        "missed the top, the factorisation just above its value would break down; a factor from farther above then serves to find it. "
        "The bound of Gershgorin needs neither and is enough where a safe step will do:");
    add_formula(section, "gershgorin_bound");
    add_paragraph(section, "All of this holds only if no ", math("μ"),
                  " is below 0, for such a mode grows whatever the step. Weights that are all ≥ 0 rule that out, and so does a sum over "
                  "flat triangles, whose own matrices are semidefinite; what rounding leaves of it is bounded in the table.");
}

}   // namespace

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer;
    report::Section& section = answer.section;
    section = section_of("stability");
    const auto meshes = meshes_for(library, settings, {"cube", "plane_ns", "fandisk_ns", "armadillo"}, section);
    add_method(section);

    add_heading(section, "Results");
    const auto studies = studies_of(meshes, "limit of explicit smoothing", settings, progress, section, stability_study);
    progress("rebuilt flow of " + studies.back().name());
    const RebuiltFlow flow = rebuilt_flow(studies.back(), settings);
    section.blocks.emplace_back(certificate_table(studies));
    section.blocks.emplace_back(unit_table(studies));
    add_limiting_vertex_figures(answer, studies, settings.colormap);
    section.blocks.emplace_back(growth_table(studies));
    section.blocks.emplace_back(growth_plot(studies.back()));   // the law is one: the table has the others
    section.blocks.emplace_back(flow_table(flow));
    section.blocks.emplace_back(flow_plot(flow));
    section.blocks.emplace_back(flow_time_table(flow));
    add_discussion(section, studies, flow);
    append_checks(section, stability_checks(studies, flow));

    for (const StabilityStudy& study : studies) {
        section.parameters["λ_crit of " + study.name()] = plain_text(study.cotangent.critical(), 10);
    }
    section.parameters["steps of the runs at 0.99 and 1.01 λ_crit"] = std::to_string(studies.front().cotangent.beyond.steps());
    section.parameters["operator"] = "cotangent with barycentric areas; uniform";
    section.extent = "the limits of two operators on " + listed(names_of(studies)) +
                     " proved from both sides; runs a hundredth below and beyond; rebuilt flow with fixed and adaptive steps";
    const StabilityStudy& last = studies.back();
    section.findings.push_back(
        {report::text("The largest stable λ of ", last.name(), ", ", readable(rounded_down(last.cotangent.certificate.lambda_low(), 5), 5),
                      " rounded down, is proved to ", readable(last.cotangent.certificate.relative_width(), 1), " relative; vertex ",
                      std::to_string(last.limiting.vertex), " sets it."),
         76});
    return answer;
}

extern const Chapter chapter{
    .id = "stability",
    .code = {{"stability_certificate", "src/geometry/smoothing/stability_certificate.cpp"},
             {"definiteness", "src/geometry/spectrum/definiteness.cpp"},
             {"enclose_largest", "src/geometry/spectrum/eigenvalue_enclosure.cpp"},
             {"largest_eigenvalue", "src/geometry/spectrum/stability.cpp"},
             {"mode_growth", "src/geometry/smoothing/mode_growth.cpp"},
             {"LimitWatch", "src/geometry/smoothing/limit_watch.h"},
             {"answer", "src/questions/stability/chapter.cpp"}},
    .answer = answer,
};

}   // namespace meshfolio::stability
