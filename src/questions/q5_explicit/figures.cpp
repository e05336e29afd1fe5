#include "base/number_text.h"
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
    return panel_of(moved_to(study.subject.mesh(), strip.frames[column]), name,
                    words.line("frames.label", "limits"_a = in_limits(study.subject, run.lambda), "t"_a = t));
}

}   // namespace

void add_recommended_figure(Answer& answer, const ExplicitStudy& study) {
    if (!study.recommended) return;
    const SmoothingRun& run = study.recommended->stopped;
    const report::Facts facts{"mesh"_a = study.name(), "iterations"_a = run.result.iterations,
                              "limits"_a = in_limits(study.subject, run.lambda)};
    const std::string id = id_of("q5", study.name(), "recommended");
    SixViewFigure figure{.id = id,
                         .title = words.line("recommended.title", facts),
                         .subtitle = subtitle_of(*study.subject.source),
                         .caption = words.line("recommended.caption", facts),
                         .edges = shows_edges(study),
                         .turnable = true};
    figure.panels = {panel_of(*study.subject.source, id + "_input", "input"),
                     panel_of(moved_to(study.subject.mesh(), run.result.X), id + "_smoothed", words.line("recommended.after", facts))};
    figure.panels.front().directions = false;
    add_figure(answer, std::move(figure));
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
