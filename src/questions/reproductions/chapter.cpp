// The section "reproductions": the experiments of four earlier reports done again, with their own parameters.
#include <set>

#include "questions/reproductions/parts.h"

namespace meshfolio::reproductions {

namespace {

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
        add_words(r.section(), words, "could_not_be_done", "why"_a = printable(error.what()));
        r.section().warnings.push_back(r.where() + ": " + printable(error.what()));
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
    Answer answer{section_of("reproductions")};
    report::Section& section = answer.section;
    add_words(section, words, settings.own_experiments ? "method.own" : "method.bundled");
    add_words(section, words, {"method.carried", "coverage.heading"});
    add(section, coverage_table(settings.bundled_experiments, settings.experiments));
    if (!settings.bundled_experiments.empty())
        add(section, check_at_most(words.line("check.rows"), 0, double(uncovered_rows(settings.bundled_experiments).size())));
    std::set<int> rows;
    std::set<std::string> reports;
    for (std::size_t i = 0; i < settings.experiments.size(); ++i) {
        const Reproduction r{answer, settings.experiments[i], settings, "reproductions_" + number_of(i)};
        progress(r.where());
        reproduce_or_tell(r, library);
        rows.insert(r.experiment.rows.begin(), r.experiment.rows.end());
        reports.insert(r.experiment.from);
    }
    section.parameters = {{"experiments", settings.experiments.size()},
                          {"taken from", words.line(settings.own_experiments ? "parameter.own" : "parameter.bundled")}};
    section.extent = words.line(settings.experiments.empty() ? "extent.none" : "extent", "experiments"_a = settings.experiments.size(),
                                "reports"_a = listed({reports.begin(), reports.end()}), "rows"_a = rows.size());
    constexpr int all = limits::last_row - limits::first_row + 1;
    const int here = all - static_cast<int>(uncovered_rows(settings.experiments).size());
    section.answer = words.say(here == all ? "answer.all" : "answer", "all"_a = all, "here"_a = here);
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
