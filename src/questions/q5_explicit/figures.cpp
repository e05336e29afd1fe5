#include <iterator>

#include "output/draw/framing.h"
#include "questions/bench/curvature_subject.h"
#include "questions/q5_explicit/parts.h"

namespace meshfolio::q5_explicit {

namespace {

/// A state of a run in one of its frames. Where spikes would be cut off it is drawn smaller, by `scale`.
struct Frame {
    output::Panel panel;   // an empty cell once the mesh is blown up or too wide
    double scale = 1;
};

Frame frame_of(const ExplicitStudy& study, const Strip& strip, std::size_t column) {
    const SmoothingRun& run = study.runs[strip.run];
    const int t = study.frame_times[column];
    const std::string name = id_of("q5", study.name(), "frame_" + step_name(run.lambda) + "_t" + std::to_string(t));
    if (column >= strip.frames.size()) return {{name, words.line("frames.blew_up", "iteration"_a = run.result.blow_up_iteration), nullptr}};
    const Positions& X = strip.frames[column];
    output::FittedPositions fitted = output::fitted_into_frame(study.subject.mesh(), X);
    Frame frame{
        framed_panel(study.subject, X, name, words.line("frames.label", "limits"_a = in_limits(study.subject, run.lambda), "t"_a = t))};
    if (!frame.panel.mesh) return frame;
    frame.panel.values = curvature_colours(study.subject, X);
    frame.scale = fitted.scale;
    if (fitted.scale < 1) frame.panel.mesh = std::make_shared<const TriangleMesh>(moved_to(study.subject.mesh(), std::move(fitted.X)));
    return frame;
}

/// The colours of all inputs, which the figures of this question share.
output::ColorRange range_of(const Studies& studies) {
    std::vector<output::Panel> inputs;
    for (const ExplicitStudy& study : studies)
        inputs.push_back({"", "", nullptr, curvature_colours(study.subject, study.subject.mesh().X)});
    return curvature_range(inputs);
}

/// What a caption says where a mesh has sharp edges.
std::string on_sharp_edges(const Studies& studies) {
    const bool sharp = std::ranges::any_of(studies, [](const ExplicitStudy& s) { return s.recommended && s.recommended->on_features > 0; });
    return sharp ? " " + words.line("figure.sharp") : "";
}

/// What a caption says where a few vertices set the limit.
std::string on_rings(const Studies& studies) {
    const Names ringed = names_where(studies, [](auto& study) { return study.recommended && !limiting_spot(study).empty(); });
    return ringed.empty() ? "" : " " + words.line("figure.ring", "meshes"_a = listed(ringed));
}

report::Facts facts_of(const ExplicitStudy& study) {
    const SmoothingRun& run = study.recommended->stopped;
    return {"mesh"_a = study.name(), "iterations"_a = run.result.iterations, "limits"_a = in_limits(study.subject, run.lambda)};
}

/// Draws input and result of one mesh in one figure.
void add_pair(Answer& answer, const Studies& studies, const std::string& id) {
    const ExplicitStudy& study = studies.front();
    const SmoothingRun& run = study.recommended->stopped;
    report::Facts facts = facts_of(study);
    facts.insert(facts.end(), {"ring"_a = on_rings(studies), "sharp"_a = on_sharp_edges(studies)});
    output::FigureRequest figure{
        .id = id,
        .title = words.line("recommended.title", facts),
        .subtitle = subtitle_of(*study.subject.source),
        .panels = {panel_of(*study.subject.source, id + "_input", "before", curvature_colours(study.subject, study.subject.mesh().X)),
                   smoothing_panel(study.subject, run.result.X, id + "_smoothed", words.line("recommended.after", facts))},
        .turnable = true,
        .coarse_edges = true};
    figure.range = curvature_range({figure.panels.front()});
    figure.panels.front().marked_vertices = limiting_spot(study);
    add_figure(answer, std::move(figure), words.line("recommended.caption", facts));
}

/// Scales the mesh so that all inputs have the same box diagonal.
output::Panel resized_panel(const ExplicitStudy& study, const Positions& X, const std::string& what, std::string label) {
    return panel_of(in_unit_box(study.subject.mesh(), X), id_of("q5", study.name(), what), std::move(label),
                    curvature_colours(study.subject, X));
}

/// Several meshes: each input beside its result.
void add_all(Answer& answer, const Studies& studies, const std::string& id) {
    output::FigureRequest figure{.id = id, .title = words.line("results.title"), .frame_panel = -1, .coarse_edges = true, .states = 2};
    for (const ExplicitStudy& study : studies) {
        if (!study.recommended) continue;
        const report::Facts facts = facts_of(study);
        figure.panels.push_back(resized_panel(study, study.subject.mesh().X, "input", words.line("results.input", facts)));
        figure.panels.back().marked_vertices = limiting_spot(study);
        figure.panels.push_back(resized_panel(study, study.recommended->stopped.result.X, "result", words.line("results.result", facts)));
    }
    figure.range = range_of(studies);
    add_figure(answer, std::move(figure),
               words.line("results.caption", "frames"_a = telling(studies).name(), "ring"_a = on_rings(studies),
                          "sharp"_a = on_sharp_edges(studies)));
    answer.figures.back().range->quantity.clear();   // the colour bar is that of the frames
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

void add_frames_figure(Answer& answer, const ExplicitStudy& study, const Studies& studies) {
    output::FigureRequest request{.id = id_of("q5", study.name(), "frames"),
                                  .title = words.line("frames.title", "mesh"_a = study.name()),
                                  .subtitle = subtitle_of(*study.subject.source),
                                  .layout = output::Layout::one_frame,
                                  .coarse_edges = true};
    Names shrunk;
    for (const int t : study.frame_times) request.columns.push_back("t = " + std::to_string(t));
    for (const Strip& strip : study.strips) {
        const std::string limits = in_limits(study.subject, study.runs[strip.run].lambda);
        request.rows.push_back(words.line("frames.row", "limits"_a = limits));
        for (std::size_t column = 0; column < study.frame_times.size(); ++column) {
            Frame frame = frame_of(study, strip, column);
            if (frame.scale < 1)
                shrunk.push_back(words.line("frames.shrunk.state", "limits"_a = limits, "t"_a = study.frame_times[column],
                                            "scale"_a = readable_percent(frame.scale, 2)));
            request.panels.push_back(std::move(frame.panel));
        }
    }
    request.range = range_for(range_of(studies), request.panels);
    const std::string small = shrunk.empty() ? "" : " " + words.line("frames.shrunk", "states"_a = listed(shrunk));
    const std::string caption = words.line("frames.caption", "mesh"_a = study.name(), "shrunk"_a = small);
    std::string alt = caption;
    for (const output::Panel& panel : request.panels)
        if (!panel.mesh) alt += " " + panel.label + ".";
    add_figure(answer, std::move(request), caption, alt);
}

}   // namespace meshfolio::q5_explicit
