#include <algorithm>
#include <iterator>

#include "base/number_text.h"
#include "mesh/triangle_measures.h"
#include "questions/core/section_tools.h"
#include "questions/core/study_list.h"
#include "questions/q5_explicit/parts.h"

namespace meshfolio::q5_explicit {

namespace {

/// Few enough triangles to be drawn with their edges.
bool shows_edges(const ExplicitStudy& study) { return study.subject.mesh().face_count() < 3000; }

/// The state of a run in one of its frames; an empty cell once it is blown up.
output::Panel frame_of(const ExplicitStudy& study, const Strip& strip, std::size_t column) {
    const SmoothingRun& run = study.runs[strip.run];
    const int t = study.frame_times[column];
    const std::string name = id_of("q5", study.name(), "frame_" + step_name(run.lambda) + "_t" + std::to_string(t));
    if (column >= strip.frames.size()) return {name, words.line("frames.blew_up", "iteration"_a = run.result.blow_up_iteration), nullptr};
    return framed_panel(study.subject, strip.frames[column], name,
                        words.line("frames.label", "limits"_a = in_limits(study.subject, run.lambda), "t"_a = t));
}

report::Facts facts_of(const ExplicitStudy& study) {
    const SmoothingRun& run = study.recommended->stopped;
    return {"mesh"_a = study.name(), "iterations"_a = run.result.iterations, "limits"_a = in_limits(study.subject, run.lambda)};
}

/// One mesh: input and result in one figure.
void add_pair(Answer& answer, const Studies& studies, const std::string& id) {
    const ExplicitStudy& study = studies.front();
    const SmoothingRun& run = study.recommended->stopped;
    const report::Facts facts = facts_of(study);
    SixViewFigure figure{.id = id,
                         .title = words.line("recommended.title", facts),
                         .subtitle = subtitle_of(*study.subject.source),
                         .caption = words.line("recommended.caption", facts),
                         .edges = shows_edges(study),
                         .turnable = true};
    figure.panels = {smoothing_panel(study.subject, run.result.X, id + "_smoothed", words.line("recommended.after", facts))};
    add_smoothing_figure(answer, study.subject, id + "_input", std::move(figure));
}

/// At the size and place in which all inputs have the same box diagonal.
output::Panel resized_panel(const ExplicitStudy& study, const Positions& X, const std::string& what, std::string label) {
    const Eigen::RowVector3d centre = bounding_box(study.subject.mesh()).centre().transpose();
    return panel_of(moved_to(study.subject.mesh(), (X.rowwise() - centre) / study.subject.diagonal), id_of("q5", study.name(), what),
                    std::move(label), curvature_colours(study.subject, X));
}

/// Several meshes: each input beside its result.
void add_all(Answer& answer, const Studies& studies, const std::string& id) {
    SixViewFigure figure{.id = id, .title = words.line("results.title"), .frame_panel = -1};
    std::vector<output::Panel> inputs;
    for (const ExplicitStudy& study : studies) {
        if (!study.recommended) continue;
        const report::Facts facts = facts_of(study);
        figure.panels.push_back(resized_panel(study, study.subject.mesh().X, "input", words.line("results.input", facts)));
        inputs.push_back(figure.panels.back());
        figure.panels.push_back(resized_panel(study, study.recommended->stopped.result.X, "result", words.line("results.result", facts)));
    }
    figure.caption = words.line("results.caption");
    figure.range = curvature_range(inputs);
    add_figure(answer, std::move(figure));
}

}   // namespace

std::string recommended_figure(const Studies& studies) {
    return studies.size() == 1 ? id_of("q5", studies.front().name(), "recommended") : "q5_recommended";
}

void add_recommended_figure(Answer& answer, const Studies& studies) {
    if (std::ranges::none_of(studies, [](const ExplicitStudy& study) { return study.recommended.has_value(); })) return;
    if (studies.size() == 1)
        add_pair(answer, studies, recommended_figure(studies));
    else
        add_all(answer, studies, recommended_figure(studies));
}

void add_frames_figure(Answer& answer, const ExplicitStudy& study) {
    output::FigureRequest request;
    request.id = id_of("q5", study.name(), "frames");
    request.title = words.line("frames.title", "mesh"_a = study.name());
    request.subtitle = subtitle_of(*study.subject.source);
    request.layout = output::Layout::one_frame;
    request.edges = shows_edges(study);
    for (const int t : study.frame_times) request.columns.push_back("t = " + std::to_string(t));
    for (const Strip& strip : study.strips) {
        request.rows.push_back(words.line("frames.row", "limits"_a = in_limits(study.subject, study.runs[strip.run].lambda)));
        for (std::size_t column = 0; column < study.frame_times.size(); ++column) request.panels.push_back(frame_of(study, strip, column));
    }
    const std::string caption = words.line("frames.caption", "mesh"_a = study.name());
    std::string alt = caption;
    for (const output::Panel& panel : request.panels)
        if (!panel.mesh) alt += " " + panel.label + ".";
    add(answer.section, report::Figure{request.id, caption, alt});
    answer.figures.push_back(std::move(request));
}

}   // namespace meshfolio::q5_explicit
