// The section "reproductions": the experiments of four earlier reports, done again with their own parameters.
#include <set>

#include "questions/reproductions/parts.h"

namespace meshfolio::reproductions {

namespace {

/// A requirement of the coursework; the message "row.<row>" says what it asks for.
struct RequiredRow {
    int row;
    std::string_view section;   // also answers it; empty: experiments alone
    bool remarked = false;      // by "row.<row>.remark"

    std::string key() const { return "row." + std::to_string(row); }
};

constexpr std::array required_rows{
    RequiredRow{7, "q1"},         RequiredRow{8, "q1", true},   RequiredRow{9, "q1"},         RequiredRow{10, "q1", true},
    RequiredRow{11, "q1"},        RequiredRow{12, "q2"},        RequiredRow{13, "q3"},        RequiredRow{14, "operators"},
    RequiredRow{15, "operators"}, RequiredRow{16, "q4"},        RequiredRow{17, "operators"}, RequiredRow{18, "q4"},
    RequiredRow{19, "q5"},        RequiredRow{20, "stability"}, RequiredRow{21, "stability"}, RequiredRow{22, ""},
    RequiredRow{23, ""},          RequiredRow{24, "q6"},        RequiredRow{25, ""},          RequiredRow{26, ""},
    RequiredRow{27, ""},          RequiredRow{28, ""},          RequiredRow{29, "q7"},        RequiredRow{30, ""},
    RequiredRow{31, ""},          RequiredRow{32, ""},          RequiredRow{33, ""},          RequiredRow{34, ""}};
static_assert(required_rows.front().row == limits::first_row && required_rows.back().row == limits::last_row);

bool reproduces(const Experiment& experiment, int row) { return std::ranges::find(experiment.rows, row) != experiment.rows.end(); }

report::Cell cell_if_said(const std::string& said) { return said.empty() ? report::Cell() : report::Cell(said); }

/// Adds, in place of an experiment, the reason why its mesh does not allow it. @return false
bool add_failure(const Reproduction& r, const Error& error) {
    add_opening(r, {});
    add_words(r.section(), words, "could_not_be_done", "why"_a = printable(error.what()));
    return false;
}

/// Does the experiment again. @return whether its mesh allows it
bool reproduce(const Reproduction& r, const MeshLibrary& library) try {
    const auto do_again = [&](auto experiment_of, auto add) {
        const auto done = experiment_of(library, r.experiment, r.settings);
        for (const ExperimentMesh& mesh : done.meshes) enter_input(*mesh.used, r.section());
        add(r, done);
    };
    const ExperimentKind kind = r.experiment.kind;
    if (kind == ExperimentKind::curvature) do_again(curvature_experiment, add_curvature_reproduction);
    if (kind == ExperimentKind::forms) add_forms_reproduction(r);
    if (kind == ExperimentKind::reconstruction) do_again(reconstruction_experiment, add_reconstruction_reproduction);
    if (kind == ExperimentKind::smoothing) do_again(smoothing_experiment, add_smoothing_reproduction);
    if (is_noisy(r.experiment)) do_again(noisy_experiment, add_noisy_reproduction);
    return true;
} catch (const MeshError& error) {
    return add_failure(r, error);
} catch (const SolverError& error) {
    return add_failure(r, error);
}

}   // namespace

report::Table coverage_table(const std::vector<Experiment>& bundled, const std::vector<Experiment>& done,
                             const std::vector<Experiment>& failed) {
    const auto reports_of = [](const std::vector<Experiment>& experiments) {   // "S0 (1), S1 (2)": how many of each report
        return [&experiments](const RequiredRow& required) {
            std::map<std::string, int> counts;
            for (const Experiment& experiment : experiments)
                if (reproduces(experiment, required.row)) ++counts[experiment.from];
            Names reports;
            for (const auto& [from, count] : counts) reports.push_back(from + " (" + std::to_string(count) + ")");
            return cell_if_said(joined(reports, ", "));
        };
    };
    const auto answered_in = [](const RequiredRow& row) {   // "Q4" for a question, the title of another section
        const std::string id(row.section);
        return cell_if_said(id.empty() ? "" : report::is_question(id) ? "Q" + id.substr(1) : chapter_of_id(id).title());
    };
    return table("reproductions_coverage", words.line("coverage"), required_rows)
        .column("row", &RequiredRow::row)
        .column("what", [](const RequiredRow& row) { return words.line(row.key()); })
        .column("experiments of", reports_of(bundled))
        .column("done here", reports_of(done))
        .column("could not be done", reports_of(failed))
        .column("answered in", answered_in)
        .column("remark", [](auto& row) { return row.remarked ? report::Cell(words.line(row.key() + ".remark")) : report::Cell(); });
}

std::vector<int> uncovered_rows(const std::vector<Experiment>& experiments) {
    std::vector<int> rows;
    for (const RequiredRow& required : required_rows) {
        const bool by_experiment = std::ranges::any_of(experiments, [&](const Experiment& e) { return reproduces(e, required.row); });
        if (!by_experiment && required.section.empty()) rows.push_back(required.row);
    }
    return rows;
}

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer{section_of("reproductions")};
    report::Section& section = answer.section;
    add_words(section, words, "method", "own"_a = settings.own_experiments);
    const std::size_t place_of_coverage = section.blocks.size();
    std::vector<Experiment> done, failed;
    std::set<std::string> reports;
    std::set<int> rows;   // done
    for (std::size_t i = 0; i < settings.experiments.size(); ++i) {
        const Experiment& experiment = settings.experiments[i];
        const Reproduction r{answer, experiment, settings, (i < 9 ? "reproductions_0" : "reproductions_") + std::to_string(i + 1)};
        progress(r.where());
        const bool is_done = reproduce(r, library);
        (is_done ? done : failed).push_back(experiment);
        if (is_done) rows.insert(experiment.rows.begin(), experiment.rows.end());
        reports.insert(experiment.from);
    }
    section.blocks.insert(section.blocks.begin() + static_cast<std::ptrdiff_t>(place_of_coverage),
                          coverage_table(settings.bundled_experiments, done, failed));
    add(section, check_at_most(words.line("check.done"), 0, double(failed.size())));
    if (!settings.bundled_experiments.empty())
        add(section, check_at_most(words.line("check.rows"), 0, double(uncovered_rows(settings.bundled_experiments).size())));
    section.parameters = {{"experiments", settings.experiments.size()},
                          {"taken from", words.line(settings.own_experiments ? "parameter.own" : "parameter.bundled")}};
    section.extent = words.line(settings.experiments.empty() ? "extent.none" : "extent", "experiments"_a = done.size(),
                                "reports"_a = listed({reports.begin(), reports.end()}), "rows"_a = rows.size());
    section.answer = words.say("answer", "all"_a = required_rows.size(), "here"_a = rows.size(), "failed"_a = failed.size());
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
    .roles = {"armadillo"},
    .cost = {.cpu = {{0.8, 40}, {0.2, 22}}, .memory = {{36, 125}, {10, 75}}},
    .answer = answer,
    .on_request = true,
};

}   // namespace meshfolio::reproductions
