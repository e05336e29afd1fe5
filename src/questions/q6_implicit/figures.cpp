#include <set>

#include "questions/bench/curvature_subject.h"
#include "questions/q6_implicit/parts.h"
#include "questions/q6_implicit/study.h"

namespace meshfolio::q6_implicit {

namespace {

/// A picture: the result of one scheme in a cell.
struct Shown {
    const SmoothingCell* cell = nullptr;
    bool is_explicit = false;

    const Positions& X() const { return is_explicit ? cell->explicit_X : cell->implicit_X; }
    bool operator==(const Shown&) const = default;
};
using Column = std::pair<Shown, Shown>;   // one above the other

/// True if the state spans between a fiftieth and two boxes of the input.
bool is_visible(const ImplicitStudy& study, const Shown& shown) {
    const SmoothingSubject& subject = study.subject;
    return shown.X().size() > 0 && fits_a_frame(subject, shown.X()) &&
           bounding_box(moved_to(subject.mesh(), shown.X())).diagonal() >= 0.02 * subject.diagonal;
}

/// Returns at most five columns: both schemes at equal λ and t, within the limit and at the first step beyond; then many implicit steps
/// above few of equal λt.
std::vector<Column> columns_of(const ImplicitStudy& study) {
    constexpr std::size_t most = 5;
    std::vector<Column> columns;
    const auto add = [&](const Shown& above, const Shown& below) {
        const Column column{above, below};
        if (columns.size() < most && is_visible(study, above) && is_visible(study, below) && std::ranges::count(columns, column) == 0)
            columns.push_back(column);
    };
    const std::size_t last = study.iterations.size() - 1;
    const auto add_schemes = [&](const std::optional<std::size_t>& l, std::size_t t) {
        if (l) add({&study.cell(*l, t), true}, {&study.cell(*l, t), false});
    };
    for (const std::size_t t : std::set{std::size_t(0), last / 2, last}) add_schemes(study.within_limit(), t);
    add_schemes(study.first_blown(), 0);
    for (const SmoothingCell& many : study.grid)
        if (const SmoothingCell* few = study.in_fewer_steps(many); few && many.lambda > study.subject.critical) add({&many}, {few});
    for (std::size_t l = 0; columns.empty() && l < study.lambdas.size(); ++l) add({&study.cell(l, 0)}, {&study.cell(l, last)});
    return columns;
}

/// Returns the state below the input: the recommended result, else the first that no column shows.
Shown below_input(const ImplicitStudy& study, const std::vector<Column>& columns) {
    if (study.good()) return {study.good()};
    for (const SmoothingCell& cell : study.grid)
        if (const Shown shown{&cell}; is_visible(study, shown) && std::ranges::count(columns, shown, &Column::second) == 0) return shown;
    return columns.front().second;
}

report::Facts facts_of(const ImplicitStudy& study, const SmoothingCell& cell) {
    return {"mesh"_a = study.name(), "limits"_a = in_limits(study.subject, cell.lambda), "iterations"_a = cell.iterations};
}

output::Panel panel_of(const ImplicitStudy& study, const Shown& shown, const std::string& name) {
    const std::string label = words.line(shown.is_explicit ? "panel.explicit" : "panel.implicit", facts_of(study, *shown.cell));
    return smoothing_panel(study.subject, shown.X(), name, label);
}

/// Returns the range of mean curvature on all inputs, which every figure of shapes uses.
output::ColorRange colours_of(const Studies& studies) {
    std::vector<output::Panel> inputs;
    for (const ImplicitStudy& study : studies) inputs.push_back(smoothing_panel(study.subject, study.subject.mesh().X, "", ""));
    return curvature_range(inputs);
}

/// Adds the figure of one mesh. @pre has_pairs(study)
void add_pair_figure(Answer& answer, const ImplicitStudy& study, const output::ColorRange& colours) {
    const std::vector<Column> columns = columns_of(study);
    const std::string id = id_of("q6", study.name(), "pairs");
    const Shown below = below_input(study, columns);
    output::FigureRequest request{.id = id,
                                  .title = words.line("pairs.title", "mesh"_a = study.name()),
                                  .subtitle = words.line("figure.subtitle", "critical"_a = readable(study.subject.critical, 4)),
                                  .layout = output::Layout::one_frame,
                                  .in_a_line = static_cast<int>(1 + columns.size()),
                                  .coarse_edges = true};
    request.panels.push_back(meshfolio::panel_of(*study.subject.source, id + "_input", words.line("panel.input"),
                                                 curvature_colours(study.subject, study.subject.mesh().X)));
    const auto name = [&](const char* line) { return id + line + std::to_string(request.panels.size()); };
    for (const auto& [above, _] : columns) request.panels.push_back(panel_of(study, above, name("_above")));
    request.panels.push_back(panel_of(study, below, name("_below")));
    for (const auto& [_, under] : columns) request.panels.push_back(panel_of(study, under, name("_below")));
    request.range = range_for(colours, request.panels);
    report::Facts facts = facts_of(study, *below.cell);
    facts.insert(facts.end(), {"recommended"_a = study.good() != nullptr, "steps"_a = study.cost ? study.cost->explicit_steps : 0});
    add_figure(answer, std::move(request), words.line("pairs.caption", facts));
}

}   // namespace

void add_pairs(Answer& answer, const Studies& studies, std::size_t first, std::size_t count) {
    const output::ColorRange colours = colours_of(studies);
    for (std::size_t i = first; i < studies.size() && i - first < count; ++i)
        if (has_pairs(studies[i])) add_pair_figure(answer, studies[i], colours);
}

bool has_pairs(const ImplicitStudy& study) { return study.good() || !columns_of(study).empty(); }

bool compares_schemes(const ImplicitStudy& study) {
    return std::ranges::any_of(columns_of(study), [](const Column& column) { return column.first.is_explicit; });
}

bool compares_equal_times(const ImplicitStudy& study) {
    return std::ranges::any_of(columns_of(study), [&](const Column& column) {
        return !column.first.is_explicit && study.in_fewer_steps(*column.first.cell) == column.second.cell;
    });
}

void add_views(Answer& answer, const Studies& studies) {
    output::FigureRequest figure{.id = "q6_views", .title = words.line("views.title"), .frame_panel = -1, .coarse_edges = true};
    for (const ImplicitStudy& study : studies)
        if (const SmoothingCell* good = study.good())
            figure.panels.push_back(meshfolio::panel_of(in_unit_box(study.subject.mesh(), good->implicit_X), "q6_views_" + study.name(),
                                                        words.line("views.panel", facts_of(study, *good)),
                                                        curvature_colours(study.subject, good->implicit_X)));
    if (figure.panels.empty()) return;
    figure.range = range_for(colours_of(studies), figure.panels);
    add_figure(answer, std::move(figure), words.line("views.caption", "several"_a = figure.panels.size() > 1));
}

void add_gap_map(Answer& answer, const Studies& studies) {
    output::FigureRequest figure{.id = "q6_gap_map", .title = words.line("gap_map.title"), .layout = output::Layout::multiples};
    figure.coarse_edges = true;
    for (const ImplicitStudy& study : studies) {
        if (!study.cost || study.cost->gap.size() == 0) continue;
        const SmoothingCell& good = *study.good();
        figure.panels.push_back(meshfolio::panel_of(moved_to(study.subject.mesh(), good.implicit_X), "q6_gap_map_" + study.name(),
                                                    words.line("views.panel", facts_of(study, good)),
                                                    100 / vertex_rms(study.subject.mesh().X, good.implicit_X) * study.cost->gap));
    }
    if (figure.panels.empty()) return;
    figure.range = range_from_zero(figure.panels, "pale", words.line("gap_map.quantity"), 0.01, "% of the motion");
    add_figure(answer, std::move(figure), words.line("gap_map.caption"));
}

}   // namespace meshfolio::q6_implicit
