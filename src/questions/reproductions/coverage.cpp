// The experiments done one after the other, and the requirements that they cover.
#include <numeric>
#include <set>

#include "questions/reproductions/study.h"

namespace meshfolio::reproductions {

namespace {

/// The sections of a whole report that answer the requirements 7 to 34; empty: experiments alone.
constexpr std::array<std::string_view, limits::last_row - limits::first_row + 1> answering_sections{
    "q1",        "q1", "q1", "q1", "q1", "q2", "q3", "operators", "operators", "q4", "operators", "q4", "q5", "stability",
    "stability", "",   "",   "q6", "",   "",   "",   "",          "q7",        "",   "",          "",   "",   ""};

std::vector<int> required_rows() {
    std::vector<int> rows(answering_sections.size());
    std::iota(rows.begin(), rows.end(), limits::first_row);
    return rows;
}

bool reproduces(const Experiment& experiment, int row) { return std::ranges::find(experiment.rows, row) != experiment.rows.end(); }

report::Cell cell_if_said(const std::string& said) { return said.empty() ? report::Cell() : report::Cell(said); }

/// Adds, in place of an experiment, the reason why its mesh does not allow it. @return false
bool add_failure(const Reproduction& r, const Error& error) {
    add_opening(r, {});
    add_words(r.section(), words, "could_not_be_done", "why"_a = printable(error.what()));
    return false;
}

/// Does the experiment again and adds its blocks. @return false if its mesh does not allow it
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
        return [&experiments](int row) {
            std::map<std::string, int> counts;
            for (const Experiment& experiment : experiments)
                if (reproduces(experiment, row)) ++counts[experiment.from];
            Names reports;
            for (const auto& [from, count] : counts) reports.push_back(from + " (" + std::to_string(count) + ")");
            return cell_if_said(joined(reports, ", "));
        };
    };
    const auto answered_in = [](int row) {   // "Q4" for a question, the title of another section
        const std::string id(answering_sections[row - limits::first_row]);
        return cell_if_said(id.empty() ? "" : report::is_question(id) ? "Q" + id.substr(1) : chapter_of_id(id).title());
    };
    const auto key_of_row = [](int row) { return "row." + std::to_string(row); };
    return table("reproductions_coverage", words.line("coverage"), required_rows())
        .column("row", std::identity())
        .column("what", [&](int row) { return words.line(key_of_row(row)); })
        .column("experiments of", reports_of(bundled))
        .column("done here", reports_of(done))
        .column("could not be done", reports_of(failed))
        .column("answered in", answered_in)
        .column("remark", [&](int row) { return cell_if_said(row == 8 || row == 10 ? words.line(key_of_row(row) + ".remark") : ""); });
}

std::vector<int> uncovered_rows(const std::vector<Experiment>& experiments) {
    std::vector<int> rows = required_rows();
    std::erase_if(rows, [&](int row) {
        return !answering_sections[row - limits::first_row].empty() ||
               std::ranges::any_of(experiments, [&](const Experiment& e) { return reproduces(e, row); });
    });
    return rows;
}

void add_reproductions(Answer& answer, const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    report::Section& section = answer.section;
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
    section.answer = words.say("answer", "all"_a = answering_sections.size(), "here"_a = rows.size(), "failed"_a = failed.size());
}

}   // namespace meshfolio::reproductions
