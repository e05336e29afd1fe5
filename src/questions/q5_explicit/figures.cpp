#include <iterator>

#include "output/draw/framing.h"
#include "questions/bench/curvature_subject.h"
#include "questions/core/diagram_names.h"
#include "questions/q5_explicit/parts.h"
#include "questions/q5_explicit/study.h"

namespace meshfolio::q5_explicit {

namespace {

/// A column of the figure of frames: a strip and an iteration; no strip: the input.
struct Column {
    std::optional<Strip> ExplicitStudy::*strip = nullptr;
    int t = 0;
};

/// Returns the columns: the input, two states just beyond the limit, and two at the largest step.
std::vector<Column> columns_of(const Studies& studies) {
    std::vector<Column> columns{{}};
    int late = 0, seen = 4;   // seen: the last iteration that shows all spikes of the far step on every mesh
    bool far = false;
    for (const ExplicitStudy& study : studies) {
        if (study.near && !study.near->times.empty()) late = std::max(late, study.near->times.back());
        if (!study.far) continue;
        far = true;
        seen = std::min(seen, std::max(1, study.runs[study.far->run].in_view_iteration));
    }
    for (const int t : each_once(std::vector{late / 2, late}))
        if (t > 0) columns.push_back({&ExplicitStudy::near, t});
    if (far) columns.insert(columns.end(), {{&ExplicitStudy::far, seen}, {&ExplicitStudy::far, 5}});
    return columns;
}

/// A state of a run.
struct Frame {
    output::Panel panel;   // an empty cell once the mesh is blown up or too wide
    double scale = 1;      // below 1 if the state is drawn smaller, so that no spike is cut off
};

/// Returns one cell of the figure of frames.
Frame frame_of(const ExplicitStudy& study, const Column& column) {
    const std::string name = id_of("q5", study.name(), "frame_");
    if (column.strip == nullptr)
        return {panel_of(*study.subject.source, name + "input", study.name(), curvature_colours(study.subject, study.subject.mesh().X))};
    const auto& strip = study.*column.strip;
    if (!strip) return {{name + (column.strip == &ExplicitStudy::near ? "near_t" : "far_t") + std::to_string(column.t), "–", nullptr}};
    const SmoothingRun& run = study.runs[strip->run];
    const std::string state = name + step_name(run.lambda) + "_t" + std::to_string(column.t);
    const Positions* X = strip->at(column.t);
    if (X == nullptr)
        return {{state, run.result.blew_up ? words.line("frames.blew_up", "iteration"_a = run.result.blow_up_iteration) : "–", nullptr}};
    output::FittedPositions fitted = output::fitted_into_frame(study.subject.mesh(), *X);
    const std::string limits = in_limits(study.subject, run.lambda);
    Frame frame{framed_panel(study.subject, *X, state, words.line("frames.label", "limits"_a = limits, "t"_a = column.t))};
    if (!frame.panel.mesh) return frame;
    frame.panel.values = curvature_colours(study.subject, *X);
    frame.scale = fitted.scale;
    if (fitted.scale < 1) frame.panel.mesh = std::make_shared<const TriangleMesh>(moved_to(study.subject.mesh(), std::move(fitted.X)));
    return frame;
}

/// Returns the colours of all inputs, which the figures of this question share.
output::ColorRange range_of(const Studies& studies) {
    std::vector<output::Panel> inputs;
    for (const ExplicitStudy& study : studies)
        inputs.push_back({"", "", nullptr, curvature_colours(study.subject, study.subject.mesh().X)});
    return curvature_range(inputs);
}

/// Returns the facts about rings and creases for the captions of inputs and results.
report::Facts remarks_on(const Studies& studies) {
    const bool sharp = std::ranges::any_of(studies, [](const ExplicitStudy& s) { return s.recommended && s.recommended->on_features > 0; });
    const Names ringed = names_where(studies, [](auto& study) { return study.recommended && !limiting_spot(study).empty(); });
    return {"ringed"_a = listed(ringed), "sharp"_a = sharp};
}

/// Returns the facts of labels about the recommended run.
report::Facts facts_of(const ExplicitStudy& study) {
    const SmoothingRun& run = study.recommended->stopped;
    return {"mesh"_a = study.name(), "iterations"_a = run.result.iterations, "limits"_a = in_limits(study.subject, run.lambda)};
}

/// Adds a figure of input and result of one mesh.
void add_pair(Answer& answer, const Studies& studies, const std::string& id) {
    const ExplicitStudy& study = studies.front();
    const SmoothingRun& run = study.recommended->stopped;
    report::Facts facts = facts_of(study);
    std::ranges::move(remarks_on(studies), std::back_inserter(facts));
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

/// Returns a panel of positions X, scaled so that all inputs have the same box diagonal.
output::Panel resized_panel(const ExplicitStudy& study, const Positions& X, const std::string& what, std::string label) {
    return panel_of(in_unit_box(study.subject.mesh(), X), id_of("q5", study.name(), what), std::move(label),
                    curvature_colours(study.subject, X));
}

/// Adds a figure of several meshes, each input beside its result.
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
    report::Facts remarks = remarks_on(studies);
    remarks.push_back("frames"_a = has_frames(studies));
    add_figure(answer, std::move(figure), words.line("results.caption", remarks));
}

}   // namespace

std::string recommended_figure(const Studies& studies) {
    return studies.size() == 1 ? id_of("q5", studies.front().name(), "recommended") : "q5_recommended";
}

void add_recommended_figure(Answer& answer, const Studies& studies) {
    if (std::ranges::none_of(studies, [](const ExplicitStudy& study) { return study.recommended.has_value(); })) return;
    if (studies.size() == 1) add_pair(answer, studies, recommended_figure(studies));
    else add_all(answer, studies, recommended_figure(studies));
}

report::Diagram wave_diagram() {
    using namespace diagram_names;
    constexpr int steps = 2, points = 96;
    constexpr double waves = 2.5, height = 0.34, apart = 1.2;
    Diagram diagram{.id = "q5_wave", .caption = words.line("wave"), .alt = words.line("wave.alt")};
    for (const auto& [product, title] : {std::pair{0.5, "wave.shrinks"}, {1.5, "wave.flips"}, {2.2, "wave.grows"}}) {
        Diagram::Panel& panel = diagram.panels.emplace_back(Diagram::Panel{.title = words.line(title)});
        for (int t = 0; t <= steps; ++t) {
            const double middle = -apart * t;
            const auto wave = [&](double factor, Style style) {
                std::vector<DiagramPoint> line;
                for (int i = 0; i <= points; ++i) {
                    const double x = double(i) / points;
                    line.push_back({4 * x, middle + height * factor * std::sin(2 * pi * waves * x)});
                }
                panel.paths.push_back(path_through(line, style));
            };
            panel.paths.push_back(path_through({{0, middle}, {4, middle}}, Style::thin));
            if (t > 0) wave(std::pow(1 / (1 + product), t), Style::dashed);
            wave(std::pow(1 - product, t), Style::accent);
            panel.labels.push_back({.x = 0, .y = middle, .words = text("t = " + std::to_string(t)), .side = Side::left});
        }
        panel.paths.push_back(path_through({{0, -1.5 * height - apart * steps}}, Style::thin));   // invisible: gives all panels one scale
    }
    return diagram;
}

bool has_frames(const Studies& studies) {
    return std::ranges::any_of(studies, [](const ExplicitStudy& study) { return study.near || study.far; });
}

void add_frames_figure(Answer& answer, const Studies& studies) {
    if (!has_frames(studies)) return;
    const std::vector<Column> columns = columns_of(studies);
    output::FigureRequest request{.id = "q5_frames",
                                  .title = words.line("frames.title"),
                                  .frame_panel = -1,
                                  .layout = output::Layout::multiples,
                                  .coarse_edges = true,
                                  .states = static_cast<int>(columns.size())};
    for (const Column& column : columns) {
        const auto run_of = [&](const ExplicitStudy& study) {
            return column.strip && study.*column.strip ? &study.runs[(study.*column.strip)->run] : nullptr;
        };
        const report::Facts facts{"limits"_a = common_limits(studies, run_of), "t"_a = column.t};
        request.columns.push_back(words.line(column.strip ? "frames.head" : "frames.input", facts));
    }
    Names shrunk;
    std::string unseen;
    for (const ExplicitStudy& study : studies) {
        request.rows.push_back(study.name());
        for (const Column& column : columns) {
            Frame frame = frame_of(study, column);
            if (frame.scale < 1)
                shrunk.push_back(words.line("frames.shrunk", "mesh"_a = study.name(), "state"_a = frame.panel.label,
                                            "scale"_a = readable_percent(frame.scale, 2)));
            if (!frame.panel.mesh) unseen += " " + frame.panel.label + ".";
            request.panels.push_back(std::move(frame.panel));
        }
    }
    request.range = range_for(range_of(studies), request.panels);
    const std::string caption = words.line("frames.caption", "shrunk"_a = listed(shrunk));
    add_figure(answer, std::move(request), caption, caption + unseen);
}

}   // namespace meshfolio::q5_explicit
