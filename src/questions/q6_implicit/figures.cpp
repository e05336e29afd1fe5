#include <algorithm>

#include "base/number_text.h"
#include "mesh/triangle_measures.h"
#include "questions/core/study_list.h"
#include "questions/q6_implicit/parts.h"

namespace meshfolio::q6_implicit {

namespace {

/// Of small meshes the triangles are drawn.
bool shows_edges(const ImplicitStudy& study) { return study.subject.mesh().face_count() < 3000; }

/// A row of the matrix: the input, and what one scheme makes of it with one λ.
struct Row {
    std::size_t lambda = 0;
    bool is_explicit = false;
};

/// Explicit above implicit, λ by λ; beyond the first λ whose explicit run blows up the implicit scheme alone.
std::vector<Row> rows_of(const ImplicitStudy& study) {
    std::vector<Row> rows;
    bool blown = false;
    for (std::size_t l = 0; l < study.lambdas.size(); ++l) {
        if (!blown) rows.push_back({l, true});
        rows.push_back({l, false});
        blown = blown || study.explicit_runs[l].result.blew_up;
    }
    return rows;
}

output::Panel panel_of_cell(const ImplicitStudy& study, const SmoothingCell& cell, bool is_explicit) {
    const std::string id = id_of("q6", study.name(), "matrix");
    const std::string what = step_name(cell.lambda) + "_t" + std::to_string(cell.iterations);
    const report::Fact at = "cell"_a = title_of(study, cell);
    if (!is_explicit)
        return panel_of(moved_to(study.subject.mesh(), cell.implicit_X), id + "_implicit_" + what, words.line("panel.implicit", at));
    if (cell.has_explicit())
        return framed_panel(study.subject, cell.explicit_X, id + "_explicit_" + what, words.line("panel.explicit", at));
    return {id + "_explicit_" + what, words.line("panel.blew_up", "iteration"_a = cell.explicit_blow_up), nullptr};
}

/// So that meshes of any size can stand side by side: a box of diagonal 1 about the origin.
TriangleMesh unit_sized(const TriangleMesh& mesh, const Positions& X) {
    const Box box = bounding_box(mesh);
    return moved_to(mesh, (X.rowwise() - box.centre().transpose()) / box.diagonal());
}

/// Has some result shrunk so far that its cell looks empty?
bool has_dots(const ImplicitStudy& study) {
    return std::ranges::any_of(study.grid, [&](const SmoothingCell& cell) {
        return bounding_box(moved_to(study.subject.mesh(), cell.implicit_X)).diagonal() < 0.02 * study.subject.diagonal;
    });
}

}   // namespace

std::string title_of(const ImplicitStudy& study, const SmoothingCell& cell) {
    return words.line("cell", "limits"_a = in_limits(study.subject, cell.lambda), "iterations"_a = cell.iterations);
}

void add_matrix(Answer& answer, const ImplicitStudy& study) {
    output::FigureRequest request;
    request.id = id_of("q6", study.name(), "matrix");
    request.layout = output::Layout::one_frame;
    request.edges = shows_edges(study);
    request.columns = {words.line("head.input")};
    for (const int t : study.iterations) request.columns.push_back(words.line("head.time", "iterations"_a = t));
    std::vector<std::string> labels;
    for (const Row& row : rows_of(study)) {
        request.rows.push_back(words.line(row.is_explicit ? "head.explicit" : "head.implicit",
                                          "limits"_a = in_limits(study.subject, study.lambdas[row.lambda])));
        request.panels.push_back(
            panel_of(*study.subject.source, request.id + "_input" + std::to_string(request.rows.size()), words.line("head.input")));
        for (std::size_t t = 0; t < study.iterations.size(); ++t) {
            request.panels.push_back(panel_of_cell(study, study.cell(row.lambda, t), row.is_explicit));
            labels.push_back(request.panels.back().label);
        }
    }
    const SmoothingCell *good = study.good(), *much = study.too_much();
    const report::Facts facts{
        "mesh"_a = study.name(), "good"_a = good ? words.line("matrix.good", "cell"_a = title_of(study, *good)) : words.line("matrix.none"),
        "much"_a = much ? words.line("matrix.much", "cell"_a = title_of(study, *much), "kept"_a = readable_percent(much->kept, 2)) : "",
        "dot"_a = has_dots(study) ? words.line("matrix.dot") : ""};
    request.title = words.line("matrix.title", facts);
    request.subtitle = words.line("figure.subtitle", "critical"_a = readable(study.subject.critical, 4));
    add(answer.section, report::Figure{request.id, words.line("matrix.caption", facts),
                                       words.line("matrix.alt", "title"_a = request.title, "panels"_a = listed(labels))});
    answer.figures.push_back(std::move(request));
}

void add_views(Answer& answer, const Studies& studies) {
    SixViewFigure figure{.id = "q6_views", .title = words.line("views.title"), .caption = words.line("views.caption"), .frame_panel = -1};
    std::vector<output::Panel> inputs;
    for (const ImplicitStudy& study : studies) {
        const SmoothingCell* good = study.good();
        if (good == nullptr) continue;
        inputs.push_back(smoothing_panel(study.subject, study.subject.mesh().X, "", ""));
        figure.panels.push_back(panel_of(unit_sized(study.subject.mesh(), good->implicit_X), "q6_views_" + study.name(),
                                         words.line("views.panel", "mesh"_a = study.name(), "cell"_a = title_of(study, *good)),
                                         curvature_colours(study.subject, good->implicit_X)));
    }
    if (figure.panels.empty()) return;
    figure.range = curvature_range(inputs);
    add_figure(answer, std::move(figure));
}

}   // namespace meshfolio::q6_implicit
