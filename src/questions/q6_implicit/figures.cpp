#include <algorithm>

#include "base/number_text.h"
#include "questions/core/study_list.h"
#include "questions/q6_implicit/parts.h"

namespace meshfolio::q6_implicit {

namespace {

/// Of small meshes the triangles are drawn.
bool shows_edges(const ImplicitStudy& study) { return study.subject.mesh().face_count() < 3000; }

output::Panel panel_of_cell(const ImplicitStudy& study, const Positions& X, const std::string& figure, const std::string& name,
                            std::string label) {
    return panel_of(moved_to(study.subject.mesh(), X), id_of("q6", study.name(), figure) + "_" + name, std::move(label));
}

std::string step_head(const ImplicitStudy& study, double lambda) {
    return words.line("head.step", "limits"_a = in_limits(study.subject, lambda));
}

/// A matrix of pictures from three quarters. @param what  also begins the keys of its words
void add_matrix_figure(Answer& answer, const ImplicitStudy& study, const std::string& what, const report::Facts& facts,
                       output::FigureRequest request) {
    request.id = id_of("q6", study.name(), what);
    request.title = words.line(what + ".title", facts);
    request.subtitle = words.line("figure.subtitle", "critical"_a = readable(study.subject.critical, 4));
    request.layout = output::Layout::one_frame;
    request.edges = shows_edges(study);
    std::vector<std::string> labels;
    for (const output::Panel& panel : request.panels) labels.push_back(panel.label);
    const std::string caption = words.line(what + ".caption", facts);
    add(answer.section,
        report::Figure{request.id, caption, words.line("figure.alt", "title"_a = request.title, "panels"_a = listed(labels))});
    answer.figures.push_back(std::move(request));
}

}   // namespace

std::string title_of(const ImplicitStudy& study, const SmoothingCell& cell) {
    return words.line("cell", "limits"_a = in_limits(study.subject, cell.lambda), "iterations"_a = cell.iterations);
}

void add_matrix(Answer& answer, const ImplicitStudy& study) {
    output::FigureRequest request;
    for (const int t : study.iterations) request.columns.push_back(words.line("head.time", "iterations"_a = t));
    for (const double lambda : study.lambdas) request.rows.push_back(step_head(study, lambda));
    for (const SmoothingCell& cell : study.grid)
        request.panels.push_back(panel_of_cell(study, cell.implicit_X, "matrix",
                                               step_name(cell.lambda) + "_t" + std::to_string(cell.iterations), title_of(study, cell)));
    request.frame_panel = -1;
    const SmoothingCell* good = study.good();
    add_matrix_figure(answer, study, "matrix",
                      {"mesh"_a = study.name(),
                       "good"_a = good ? words.line("matrix.good", "cell"_a = title_of(study, *good)) : words.line("matrix.none")},
                      std::move(request));
}

std::vector<const SmoothingCell*> compared_cells(const ImplicitStudy& study) {
    std::vector<const SmoothingCell*> cells;
    const auto blown = std::ranges::find_if(study.grid, [](const SmoothingCell& cell) { return !cell.has_explicit(); });
    if (blown == study.grid.end()) {
        for (std::size_t l = 0; l < study.lambdas.size(); ++l) cells.push_back(&study.middle_cell(l));
        return cells;
    }
    const std::size_t index = static_cast<std::size_t>(blown - study.grid.begin()), step = index / study.iterations.size();
    if (step > 0) cells.push_back(&study.cell(0, study.iterations.size() - 1));
    for (std::size_t t = 0; t <= index % study.iterations.size(); ++t) cells.push_back(&study.cell(step, t));
    return cells;
}

void add_pairs(Answer& answer, const ImplicitStudy& study) {
    output::FigureRequest request;
    std::vector<output::Panel> implicit_row;
    for (const SmoothingCell* cell : compared_cells(study)) {
        const std::string name = step_name(cell->lambda) + "_t" + std::to_string(cell->iterations);
        request.columns.push_back(title_of(study, *cell));
        implicit_row.push_back(panel_of_cell(study, cell->implicit_X, "pairs", "implicit_" + name,
                                             words.line("panel.implicit", "cell"_a = request.columns.back())));
        if (cell->has_explicit())
            request.panels.push_back(panel_of_cell(study, cell->explicit_X, "pairs", "explicit_" + name,
                                                   words.line("panel.explicit", "cell"_a = request.columns.back())));
        else
            request.panels.push_back({id_of("q6", study.name(), "pairs") + "_explicit_" + name,
                                      words.line("panel.blew_up", "iteration"_a = cell->explicit_blow_up), nullptr});
    }
    request.rows = {words.line("head.explicit"), words.line("head.implicit")};
    request.frame_panel = static_cast<int>(implicit_row.size());   // spikes would shrink the others
    request.panels.insert(request.panels.end(), implicit_row.begin(), implicit_row.end());
    add_matrix_figure(answer, study, "pairs", {"mesh"_a = study.name()}, std::move(request));
}

void add_views(Answer& answer, const ImplicitStudy& study) {
    const SmoothingCell *good = study.good(), *much = study.too_much();
    const std::string id = id_of("q6", study.name(), "views");
    SixViewFigure figure{.id = id,
                         .title = words.line("views.title", "mesh"_a = study.name()),
                         .subtitle = words.line("figure.subtitle", "critical"_a = readable(study.subject.critical, 4)),
                         .panels = {panel_of(*study.subject.source, id + "_input", words.line("views.input"))},
                         .edges = shows_edges(study),
                         .turnable = true};
    figure.panels.front().directions = good == nullptr;   // of a result
    report::Facts facts{"mesh"_a = study.name(), "good"_a = "", "much"_a = ""};
    if (good) {
        facts[1] = "good"_a = words.line("views.good", "cell"_a = title_of(study, *good), "fall"_a = energy_fall(good->implicit_energy),
                                         "kept"_a = readable_percent(good->kept, 2));
        figure.panels.push_back(
            panel_of_cell(study, good->implicit_X, "views", "good", words.line("views.good.label", "cell"_a = title_of(study, *good))));
    }
    if (much) {
        facts[2] = "much"_a = words.line("views.much", "cell"_a = title_of(study, *much), "kept"_a = readable_percent(much->kept, 2));
        figure.panels.push_back(
            panel_of_cell(study, much->implicit_X, "views", "much", words.line("views.much.label", "cell"_a = title_of(study, *much))));
        figure.panels.back().directions = false;
    }
    figure.caption = words.line("views.caption", facts);
    add_figure(answer, std::move(figure));
}

}   // namespace meshfolio::q6_implicit
