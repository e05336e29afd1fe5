#include <ranges>

#include "questions/bench/curvature_subject.h"
#include "questions/methods/study.h"

namespace meshfolio::methods {

namespace {

/// True for the methods of the plot and the figure. The others are near to the implicit flow, or gain nothing.
bool is_plotted(DenoisingMethod method) {
    using enum DenoisingMethod;
    return method != explicit_flow && method != rebuilt_flow && method != conformal_flow;
}

double largest_gain(const NoiseTrial& trial, Gain gain) {
    const SearchResult* best = winner(trial, gain);
    return best ? (best->*gain)() : (trial.results.front().*gain)();
}

}   // namespace

void add_method(report::Section& section, const DenoisingLaboratory& laboratory) {
    const SearchBudget& budget = laboratory.budget;
    add_words(section, words, "method");
    report::BulletList noise, methods;
    for (const NoiseEntry& entry : noise_list())
        noise.items.push_back(report::text(report::strong(std::string(entry.title)), ": ", std::string(entry.description)));
    add(section, std::move(noise));
    add_words(section, words, "method.flows");
    for (const DenoisingEntry& entry : denoising_list())
        methods.items.push_back(report::text(report::strong(std::string(entry.title)), " ", report::ref(std::string(entry.reference)), ": ",
                                             std::string(entry.description)));
    add(section, std::move(methods));
    const int bounded = std::max(1, budget.values / 2);
    add_words(section, words, "method.budget", "total"_a = budget.total(), "values"_a = budget.values, "steps"_a = budget.steps,
              "bounded_values"_a = bounded, "bounded_steps"_a = budget.total() / bounded);
}

report::Table subject_table(const DenoisingLaboratory& laboratory) {
    return table("methods_meshes", words.line("meshes"), laboratory.meshes)
        .column("mesh", &DenoisingTrials::name)
        .column("vertices", {.digits = 7}, [](auto& m) { return m.subject.mesh.vertex_count(); })
        .column("cut from", {.unit = "vertices", .digits = 7},
                [](auto& m) { return cell_of(m.subject.whole_vertices, m.subject.is_patch()); })
        .column("mean edge", {.unit = "% of box"}, [](auto& m) { return 100 * m.subject.mean_edge / m.subject.diagonal; })
        .column("on edges sharper than 40°", {.unit = "% of vertices"}, [](auto& m) { return 100 * m.subject.character.feature_share; })
        .column("median angle at other edges", {.unit = "°"}, [](auto& m) { return m.subject.character.typical_angle; })
        .column("class", [](auto& m) { return m.subject.class_title(); });
}

report::Table gain_table(const DenoisingLaboratory& laboratory) {
    const report::Column gain{.unit = "×", .heat = Heat{1, 8}};
    auto gains = table("methods_gains", words.line("gains"), parts_within(laboratory.meshes, &DenoisingTrials::trials));
    gains.column("mesh", {.filter = true}, [](auto& row) { return row.whole.name(); })
        .column("noise",
                [](auto& row) { return std::string(row.part.s1_level ? words.line("noise.box") : noise_entry(row.part.kind).title); })
        .column("σ", {.unit = "h̄", .digits = 2}, [](auto& row) { return row.part.edges; });
    for (std::size_t i = 0; i < denoising_list().size(); ++i)
        gains.column(method_title(i), gain, [&](auto& row) { return cell_of(row.part.results[i].gain()); });
    return gains.column("largest in places", gain, [](auto& row) { return cell_of(largest_gain(row.part, &SearchResult::rms_gain)); })
        .column("in normals", gain, [](auto& row) { return cell_of(largest_gain(row.part, &SearchResult::angle_gain)); });
}

report::Table winner_table(const DenoisingLaboratory& laboratory) {
    const auto title = [](int method) { return method >= 0 ? report::Cell{method_title(method)} : report::Cell{}; };
    const auto value = [](const std::vector<double>& gains, int method) { return method >= 0 ? cell_of(gains[method]) : report::Cell{}; };
    return table("methods_winners", words.line("winners"), class_results(laboratory))
        .column("class", &ClassResult::title)
        .column("meshes", [](auto& c) { return listed(c.meshes); })
        .column("noisy meshes", {.digits = 4}, &ClassResult::trials)
        .column("best in shape", [&](auto& c) { return title(c.best); })
        .column("gain", {.unit = "×"}, [&](auto& c) { return value(c.gain, c.best); })
        .column("best in normals", [&](auto& c) { return title(c.best_by_angle); })
        .column("gain in normals", {.unit = "×"}, [&](auto& c) { return value(c.angle_gain, c.best_by_angle); });
}

void add_gain_plot(report::Section& section, const DenoisingLaboratory& laboratory) {
    if (laboratory.meshes.front().of_kind(NoiseKind::gaussian).size() < 2) return;
    report::Plot plot{.id = "methods_gain_versus_noise",
                      .caption = words.line("gain_plot"),
                      .x_label = words.line("gain_plot.x"),
                      .y_label = words.line("gain_plot.y"),
                      .log_x = true,
                      .log_y = true};
    Names ends;
    for (const DenoisingTrials& mesh : laboratory.meshes) {
        for (int i = 0; i < int(denoising_list().size()); ++i) {
            const DenoisingMethod method = denoising_list()[i].method;
            if (!is_plotted(method)) continue;
            report::Series series{.name = method_title(i),
                                  .style = filters_normals(method) ? report::Series::Style::dashed : report::Series::Style::line_and_points,
                                  .color = i,   // as on the other meshes, also where a method before it has no gain
                                  .pattern = i,
                                  .panel = mesh.name()};
            for (const NoiseTrial* trial : mesh.of_kind(NoiseKind::gaussian)) add_point(series, trial->edges, trial->results[i].gain());
            if (!std::isfinite(series.y.front())) continue;
            ends.push_back(mesh.name() + ", " + series.name + ": " + readable(series.y.front()) + " to " + readable(series.y.back()));
            plot.series.push_back(std::move(series));
        }
    }
    plot.alt = words.line("gain_plot.alt", "caption"_a = plot.caption, "gains"_a = joined(ends));
    add(section, plot);
}

void add_method_figure(Answer& answer, const DenoisingLaboratory& laboratory, bool box_levels) {
    const DenoisingTrials& first = laboratory.meshes.front();
    std::vector<Within<DenoisingTrials, NoiseTrial>> shown;
    for (const DenoisingTrials& mesh : laboratory.meshes | std::views::take(4)) shown.push_back({mesh, mesh.pictured_trial()});
    for (const NoiseTrial& trial : first.trials)
        if (trial.s1_level && box_levels) shown.push_back({first, trial});
    output::FigureRequest request{.id = "methods_results", .title = words.line("figure.title"), .layout = output::Layout::multiples};
    request.columns = {words.line("figure.clean"), words.line("figure.noisy")};
    for (const DenoisingEntry& entry : denoising_list())
        if (is_plotted(entry.method)) request.columns.push_back(std::string(entry.title));
    for (const auto& [mesh, trial] : shown) {
        const DenoisingSubject& subject = mesh.subject;
        const std::string base = id_of("methods", mesh.name(), trial.id());
        const auto coloured = [&](const Positions& X, const std::string& what, std::string label) {
            return panel_of(moved_to(subject.mesh, X), base + "_" + what, std::move(label),
                            shape_distances(subject.mesh, X) / subject.mean_edge);
        };
        request.rows.push_back(mesh.name() + ", " + trial.title());
        request.panels.push_back(panel_of(subject.mesh, base + "_clean", mesh.name()));
        request.panels.push_back(coloured(trial.noisy, "noisy", mesh.name() + ", noisy"));
        for (const SearchResult& result : trial.results) {
            if (!is_plotted(result.method)) continue;
            const std::string what(denoising_entry(result.method).name), gain = readable(result.gain(), 2);
            request.panels.push_back(result.defined ? coloured(result.X, what, method_title(result) + ", gain " + gain)
                                                    : output::Panel{base + "_" + what, words.line("figure.undefined"), nullptr});
        }
    }
    request.range = range_from_zero(request.panels, "pale", words.line("figure.quantity"), 0.01, "mean edges");
    const Names labels = each_of(request.panels, &output::Panel::label);
    add_figure(answer, std::move(request), words.line("figure.caption"), words.line("figure.alt", "panels"_a = joined(labels)));
}

}   // namespace meshfolio::methods
