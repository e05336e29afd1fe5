// The section "reproductions": the experiments of four earlier reports done again, with their own parameters.
#include <set>

#include "base/errors.h"
#include "base/number_text.h"
#include "questions/core/section_tools.h"
#include "questions/reproductions/parts.h"

namespace meshfolio::reproductions {

namespace {

using report::code;
using report::math;

void add_method(report::Section& section, const QuestionSettings& settings) {
    add_heading(section, "Method");
    add_paragraph(section,
                  "Four earlier reports on this coursework, S0 to S3, show what their programs made of their meshes. Each of their "
                  "experiments is a few lines of a settings file, with the parameters of the report, and can be done again. ",
                  settings.own_experiments
                      ? report::text("Done here are the ones of the settings given.")
                      : report::text("Done here are a few small ones; all of a report run with ",
                                     code("report --config s0 --only reproductions"), ", and likewise s1, s2 and s3. "),
                  settings.own_experiments ? report::text() : report::text(report::ref("reproductions_coverage"), " says which is which."));
    add_paragraph(
        section,
        "Where a mesh of a report is not in the data folders, a bundled one stands in. Raw λ and σ are areas and lengths of "
        "the original: they carry over as the same multiple of ",
        math("λ_crit"),
        " where a mesh is only smoothed, of the mean edge (squared for λ) where noise is removed. The uniform operator's λ has no "
        "unit and stays. What a report does not say is chosen by a rule that stands beside it.");
}

template <class Done>
void enter_inputs(report::Section& section, const Done& done) {
    for (const ExperimentMesh& mesh : done.meshes) enter_input(*mesh.used, section);
}

void reproduce(const Reproduction& r, const MeshLibrary& library) {
    const auto do_again = [&](auto experiment_of, auto add) {
        const auto done = experiment_of(library, r.experiment, r.settings);
        enter_inputs(r.section(), done);
        add(r, done);
    };
    switch (r.experiment.kind) {
        case ExperimentKind::curvature:
            return do_again(curvature_experiment, add_curvature_reproduction);
        case ExperimentKind::forms:
            return add_forms_reproduction(r);
        case ExperimentKind::reconstruction:
            return do_again(reconstruction_experiment, add_reconstruction_reproduction);
        case ExperimentKind::smoothing:
            return do_again(smoothing_experiment, add_smoothing_reproduction);
        case ExperimentKind::denoising:
        case ExperimentKind::error_curve:
            return do_again(noisy_experiment, add_noisy_reproduction);
    }
}

/// What a mesh does not allow is told, and the other experiments go on.
void reproduce_or_tell(const Reproduction& r, const MeshLibrary& library) {
    const auto tell = [&](const Error& error) {
        add_opening(r, {});
        add_paragraph(r.section(), report::strong("Could not be done: "), printable(error.what()), ".");
        r.section().warnings.push_back(r.experiment.from + ", " + rows_text(r.experiment.rows) + ": " + printable(error.what()));
    };
    try {
        reproduce(r, library);
    } catch (const MeshError& error) {
        tell(error);
    } catch (const SolverError& error) {
        tell(error);
    }
}

std::string number_of(std::size_t index) { return (index < 9 ? "0" : "") + std::to_string(index + 1); }

}   // namespace

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer;
    report::Section& section = answer.section;
    section = section_of("reproductions");
    add_method(section, settings);

    add_heading(section, "Coverage");
    section.blocks.emplace_back(coverage_table(settings.bundled_experiments, settings.experiments));
    if (!settings.bundled_experiments.empty()) {
        section.checks.push_back(report::check_at_most("rows 7 to 34 that neither a bundled experiment nor a section answers", 0,
                                                       double(uncovered_rows(settings.bundled_experiments).size())));
    }
    std::set<int> rows;
    std::set<std::string> reports;
    for (std::size_t i = 0; i < settings.experiments.size(); ++i) {
        const Experiment& experiment = settings.experiments[i];
        progress(experiment.from + ", " + rows_text(experiment.rows));
        reproduce_or_tell({answer, experiment, settings, "reproductions_" + number_of(i)}, library);
        rows.insert(experiment.rows.begin(), experiment.rows.end());
        reports.insert(experiment.from);
    }
    section.parameters["experiments"] = std::to_string(settings.experiments.size());
    section.parameters["taken from"] = settings.own_experiments ? "the settings file" : "the brief ones of the bundled files";
    section.extent = settings.experiments.empty()
                         ? "no experiments were named"
                         : counted(static_cast<int>(settings.experiments.size()), "experiment") + " of " +
                               listed({reports.begin(), reports.end()}) + " done again, for " +
                               counted(static_cast<int>(rows.size()), "row") +
                               " of the requirements; which section or bundled experiment answers each of the others";
    constexpr int all = limits::last_row - limits::first_row + 1;
    const auto covered = [](const std::vector<Experiment>& by) {
        return std::to_string(all - static_cast<int>(uncovered_rows(by).size()));
    };
    section.findings.push_back(
        {report::text("Earlier reports: of the ", std::to_string(all), " things that they and the assignment show ",
                      covered(settings.experiments), " are done again by a section of the whole report or by an experiment here; with ",
                      counted(static_cast<int>(settings.bundled_experiments.size()), "bundled experiment"), " it would be ",
                      covered(settings.bundled_experiments), "."),
         20});
    return answer;
}

extern const Chapter chapter{
    .id = "reproductions",
    .code = {{"read_experiments", "src/run/settings/experiment_reader.cpp"},
             {"experiment_meshes", "src/questions/reproductions/study.cpp"},
             {"smoothing_experiment", "src/questions/reproductions/study.cpp"},
             {"noisy_experiment", "src/questions/reproductions/study.cpp"},
             {"curvature_experiment", "src/questions/reproductions/field_study.cpp"},
             {"reconstruction_experiment", "src/questions/reproductions/field_study.cpp"},
             {"answer", "src/questions/reproductions/chapter.cpp"}},
    .answer = answer,
};

}   // namespace meshfolio::reproductions
