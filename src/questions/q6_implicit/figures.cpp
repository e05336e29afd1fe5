#include "questions/bench/curvature_subject.h"
#include "questions/q6_implicit/parts.h"

namespace meshfolio::q6_implicit {

namespace {

/// A row of the matrix: what one scheme makes of the input with one λ.
struct Row {
    std::size_t lambda = 0;
    bool is_explicit = false;
};

/// The first explicit run that blew up, if one of its pictures can be drawn.
std::optional<std::size_t> drawn_blow_up(const ImplicitStudy& study) {
    const std::optional<std::size_t> blown = study.first_blown();
    for (std::size_t t = 0; blown && t < study.iterations.size(); ++t)
        if (const SmoothingCell& cell = study.cell(*blown, t); cell.has_explicit() && fits_a_frame(study.subject, cell.explicit_X))
            return blown;
    return {};
}

/// Explicit above implicit, λ by λ; beyond the first λ whose explicit run blows up the implicit scheme alone.
std::vector<Row> rows_of(const ImplicitStudy& study) {
    std::vector<Row> rows;
    const std::size_t blown = study.first_blown().value_or(study.lambdas.size());
    for (std::size_t l = 0; l < study.lambdas.size(); ++l) {
        if (l < blown || l == drawn_blow_up(study)) rows.push_back({l, true});
        rows.push_back({l, false});
    }
    return rows;
}

/// Smaller than one sees: a fiftieth of the box of the input.
bool is_dot(const SmoothingSubject& subject, const Positions& X) {
    return bounding_box(moved_to(subject.mesh(), X)).diagonal() < 0.02 * subject.diagonal;
}

/// Coloured by curvature; where there is nothing to see the cell is empty and says why.
output::Panel panel_of_cell(const ImplicitStudy& study, const SmoothingCell& cell, bool is_explicit) {
    const std::string id = id_of("q6", study.name(), "matrix");
    const std::string what = step_name(cell.lambda) + "_t" + std::to_string(cell.iterations);
    const std::string name = id + (is_explicit ? "_explicit_" : "_implicit_") + what;
    if (is_explicit && !cell.has_explicit()) return {name, words.line("panel.blew_up", "iteration"_a = cell.explicit_blow_up), nullptr};
    const Positions& X = is_explicit ? cell.explicit_X : cell.implicit_X;
    if (is_dot(study.subject, X)) return {name, words.line("panel.dot"), nullptr};
    const std::string label = words.line(is_explicit ? "panel.explicit" : "panel.implicit", "cell"_a = title_of(study, cell));
    output::Panel panel = framed_panel(study.subject, X, name, label);
    if (panel.mesh) panel.values = curvature_colours(study.subject, X);
    return panel;
}

/// The explicit runs that are left out: at larger λ than the first that blew up.
std::string left_out(const ImplicitStudy& study) {
    Names runs;
    for (std::size_t l = study.first_blown().value_or(study.lambdas.size()); l < study.lambdas.size(); ++l) {
        if (l == drawn_blow_up(study)) continue;
        const Smoothed& run = study.explicit_runs[l].result;
        if (run.blew_up)
            runs.push_back(words.line("matrix.not_drawn.run", "limits"_a = in_limits(study.subject, study.lambdas[l]),
                                      "iteration"_a = run.blow_up_iteration));
    }
    return runs.empty() ? "" : words.line("matrix.not_drawn", "runs"_a = listed(runs));
}

}   // namespace

std::string title_of(const ImplicitStudy& study, const SmoothingCell& cell) {
    return words.line("cell", "limits"_a = in_limits(study.subject, cell.lambda), "iterations"_a = cell.iterations);
}

output::ColorRange colours_of(const Studies& studies) {
    std::vector<output::Panel> inputs;
    for (const ImplicitStudy& study : studies) inputs.push_back(smoothing_panel(study.subject, study.subject.mesh().X, "", ""));
    return curvature_range(inputs);
}

void add_matrix(Answer& answer, const ImplicitStudy& study, const output::ColorRange& colours, bool has_legend) {
    output::FigureRequest request{.id = id_of("q6", study.name(), "matrix"),
                                  .subtitle = words.line("figure.subtitle", "critical"_a = readable(study.subject.critical, 4)),
                                  .layout = output::Layout::one_frame,
                                  .columns = {words.line("head.input")},
                                  .coarse_edges = true};
    for (const int t : study.iterations) request.columns.push_back(words.line("head.time", "iterations"_a = t));
    Names labels;
    for (const Row& row : rows_of(study)) {
        const std::size_t r = request.rows.size();
        request.rows.push_back(words.line(row.is_explicit ? "head.explicit" : "head.implicit",
                                          "limits"_a = in_limits(study.subject, study.lambdas[row.lambda])));
        if (r == 0)
            request.panels.push_back(panel_of(*study.subject.source, request.id + "_input", words.line("head.input"),
                                              curvature_colours(study.subject, study.subject.mesh().X)));
        else
            request.panels.push_back({request.id + "_none" + std::to_string(r), "", nullptr});
        for (std::size_t t = 0; t < study.iterations.size(); ++t) {
            request.panels.push_back(panel_of_cell(study, study.cell(row.lambda, t), row.is_explicit));
            labels.push_back(request.panels.back().label);
        }
    }
    request.range = range_for(colours, request.panels);
    if (!has_legend) request.range->quantity.clear();
    const SmoothingCell *good = study.good(), *much = study.too_much();
    const report::Facts facts{"mesh"_a = study.name(),
                              "good"_a = good ? words.line("matrix.good", "cell"_a = title_of(study, *good)) : words.line("matrix.none"),
                              "much"_a = much ? words.line("matrix.much", "cell"_a = title_of(study, *much)) : "",
                              "left_out"_a = left_out(study), "scale"_a = has_legend ? "" : words.line("matrix.scale")};
    request.title = words.line("matrix.title", facts);
    const std::string alt = words.line("matrix.alt", "title"_a = request.title, "panels"_a = listed(labels));
    add_figure(answer, std::move(request), words.line("matrix.caption", facts), alt);
}

void add_views(Answer& answer, const Studies& studies, const output::ColorRange& colours) {
    output::FigureRequest figure{.id = "q6_views", .title = words.line("views.title"), .frame_panel = -1, .coarse_edges = true};
    for (const ImplicitStudy& study : studies) {
        const SmoothingCell* good = study.good();
        if (good == nullptr) continue;
        figure.panels.push_back(panel_of(in_unit_box(study.subject.mesh(), good->implicit_X), "q6_views_" + study.name(),
                                         words.line("views.panel", "mesh"_a = study.name(), "cell"_a = title_of(study, *good)),
                                         curvature_colours(study.subject, good->implicit_X)));
    }
    if (figure.panels.empty()) return;
    figure.range = range_for(colours, figure.panels);
    add_figure(answer, std::move(figure), words.line("views.caption"));
}

}   // namespace meshfolio::q6_implicit
