#include "geometry/measures/hausdorff.h"
#include "questions/bench/curvature_subject.h"
#include "questions/methods/parts.h"

namespace meshfolio::methods {

namespace {

/// "λ = 0.16 h̄², step 5"; empty for the noisy mesh.
report::Cell where(const SearchResult& r, const SearchState& state) {
    if (!r.defined || state.step == 0) return {};
    return parameter_words(r.method, state.value) + ", step " + std::to_string(state.step);
}

/// "≤ 0.03" where a limit lies beyond the levels tried.
report::Cell limit_cell(double edges, bool at_end, const char* sign) {
    return std::isfinite(edges) ? report::Cell{(at_end ? sign : "") + readable(edges, 2)} : report::Cell{};
}

std::size_t place_of(const DenoisingEntry& entry) { return static_cast<std::size_t>(&entry - denoising_list().data()); }

}   // namespace

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

report::Table gain_table(const DenoisingTrials& mesh, const Measure& measure) {
    const double unit = measure.is_angle() ? degrees : 100 / mesh.subject.diagonal;
    const std::string key = "gains." + std::string(measure.key);
    auto gains = table(id_of("methods", mesh.name(), &measure == &measures[0] ? "gains" : "gains_" + std::string(measure.key)),
                       words.line("gains", "mesh"_a = mesh.name(), "measure"_a = words.line(key)), mesh.trials);
    gains.column("noise", [](auto& t) { return t.s1_level ? words.line("noise.box_level") : std::string(noise_entry(t.kind).title); });
    gains.column("σ", {.unit = "mean edges", .digits = 2}, [](auto& t) { return t.edges; });
    gains.column("σ", {.unit = "% of box", .digits = 2}, [&](auto& t) { return 100 * t.sigma / mesh.subject.diagonal; });
    gains.column(measure.is_angle() ? "angle, noisy" : "error, noisy", {.unit = measure.is_angle() ? "°" : "% of box"},
                 [&](auto& t) { return unit * (t.results.front().noisy.*measure.error); });
    for (std::size_t i = 0; i < denoising_list().size(); ++i)
        gains.column(method_title(i), {.unit = "×", .heat = Heat{1, 8}}, [&](auto& t) { return cell_of((t.results[i].*measure.gain)()); });
    return gains;
}

report::Table result_table(const DenoisingTrials& mesh) {
    const NoiseTrial& trial = mesh.pictured_trial();
    const double percent = 100 / mesh.subject.diagonal;
    const auto defined = [](auto value_of) { return [=](auto& r) { return cell_of(value_of(r), r.defined); }; };
    const auto hausdorff = [&](auto& r) {
        const TriangleMesh& clean = mesh.subject.mesh;
        return r.defined ? report::Cell{percent * hausdorff_distance(clean, moved_to(clean, r.X)).distance} : report::Cell{};
    };
    return table(id_of("methods", mesh.name(), "results"), words.line("at_their_best", "mesh"_a = mesh.name(), "noise"_a = trial.title()),
                 trial.results)
        .column("method", [](auto& r) { return method_title(r); })
        .column("best with", [](auto& r) { return where(r, r.by_shape); })
        .column("error of shape", {.unit = "% of box"}, defined([=](auto& r) { return percent * r.by_shape.shape; }))
        .column("gain", {.unit = "×"}, [](auto& r) { return cell_of(r.gain()); })
        .column("rms error", {.unit = "% of box"}, defined([=](auto& r) { return percent * r.difference.rms; }))
        .column("Hausdorff", {.unit = "% of box"}, hausdorff)
        .column("normal angle", {.unit = "°"}, defined([](auto& r) { return degrees * r.difference.mean_normal_angle; }))
        .column("squared normal angle", {.unit = "°²"},
                defined([](auto& r) { return degrees * degrees * r.difference.mean_squared_normal_angle; }))
        .column("volume", {.unit = "×", .digits = 4},
                [&](auto& r) { return cell_of(r.difference.volume_ratio, r.defined && mesh.subject.has_volume_to_keep); })
        .column("least rms error", {.unit = "% of box"}, defined([=](auto& r) { return percent * r.by_rms.rms; }))
        .column("with", [](auto& r) { return where(r, r.by_rms); })
        .column("least normal angle", {.unit = "°"}, defined([](auto& r) { return degrees * r.by_angle.angle; }))
        .column("with", [](auto& r) { return where(r, r.by_angle); });
}

report::Table winner_table(const std::vector<ClassResult>& classes) {
    const auto title = [](int method) { return method >= 0 ? report::Cell{method_title(method)} : report::Cell{}; };
    const auto value = [](const std::vector<double>& gains, int method) { return method >= 0 ? cell_of(gains[method]) : report::Cell{}; };
    auto winners = table("methods_winners", words.line("winners"), classes);
    winners.column("class", &ClassResult::title)
        .column("meshes", [](auto& c) { return listed(c.meshes); })
        .column("noisy meshes", {.digits = 4}, &ClassResult::trials)
        .column("best in shape", [&](auto& c) { return title(c.best()); })
        .column("gain", {.unit = "×"}, [&](auto& c) { return value(c.gain, c.best()); })
        .column("best in normals", [&](auto& c) { return title(c.best_by_angle()); })
        .column("gain in normals", {.unit = "×"}, [&](auto& c) { return value(c.angle_gain, c.best_by_angle()); });
    for (std::size_t i = 0; i < denoising_list().size(); ++i)
        winners.column(method_title(i) + ", shape", {.unit = "×"}, [&](auto& c) { return cell_of(c.gain[i]); });
    return winners;
}

report::Table limit_table(const DenoisingLaboratory& laboratory) {
    const DenoisingTrials& first = laboratory.meshes.front();
    std::string levels;
    for (const NoiseTrial* trial : first.of_kind(NoiseKind::gaussian)) levels += (levels.empty() ? "" : ", ") + readable(trial->edges, 2);
    auto limits = table("methods_limits", words.line("levels", "levels"_a = levels, "mesh"_a = first.name()),
                        parts_within(laboratory.meshes, [](auto&) { return denoising_list(); }));
    limits.column("mesh", [](auto& row) { return row.whole.name(); }).column("method", [](auto& row) { return row.part.title; });
    const auto add_limits = [&](const std::string& measure, Gain gain) {
        const auto column = [&](const char* name, const auto& cell) {
            limits.column(measure + name, {.unit = "mean edges"},
                          [&](auto& row) { return cell(noise_limits(row.whole, place_of(row.part), gain)); });
        };
        column(": helps from", [](const NoiseLimits& l) { return limit_cell(l.helps_from, l.helps_at_first, "≤ "); });
        column(": helps up to", [](const NoiseLimits& l) { return limit_cell(l.helps_to, l.helps_at_last, "≥ "); });
        column(": works up to", [](const NoiseLimits& l) { return limit_cell(l.halves_to, l.halves_at_last, "≥ "); });
    };
    add_limits("shape", &SearchResult::gain);
    add_limits("places", &SearchResult::rms_gain);
    return limits;
}

report::Plot gain_plot(const DenoisingTrials& mesh) {
    report::Plot plot{.id = id_of("methods", mesh.name(), "gain_versus_noise"),
                      .caption = words.line("gain_plot", "mesh"_a = mesh.name(), "class"_a = mesh.subject.class_title()),
                      .x_label = words.line("gain_plot.x"),
                      .y_label = words.line("gain_plot.y"),
                      .log_x = true,
                      .log_y = true};
    Names ends;
    for (int i = 0; i < int(denoising_list().size()); ++i) {
        const DenoisingMethod method = denoising_list()[i].method;
        const bool filter = filters_normals(method);
        report::Series series{
            .name = method_title(i),
            .style = filter ? report::Series::Style::dashed : report::Series::Style::line_and_points,
            .color = i,   // as on the other meshes, also where a method before it has no gain
            .pattern = i,
            .panel = words.line(filter || method == DenoisingMethod::conformal_flow ? "gain_plot.others" : "gain_plot.laplacian")};
        for (const NoiseTrial* trial : mesh.of_kind(NoiseKind::gaussian)) add_point(series, trial->edges, trial->results[i].gain());
        if (!std::isfinite(series.y.front())) continue;
        ends.push_back(series.name + " " + readable(series.y.front()) + " to " + readable(series.y.back()));
        plot.series.push_back(std::move(series));
    }
    plot.alt = words.line("gain_plot.alt", "caption"_a = plot.caption, "gains"_a = joined(ends));
    return plot;
}

void add_method_figure(Answer& answer, const DenoisingTrials& mesh, const NoiseTrial& trial) {
    const DenoisingSubject& subject = mesh.subject;
    const std::string base = id_of("methods", mesh.name(), trial.id());
    const auto coloured = [&](const Positions& X, const std::string& what, std::string label) {
        return panel_of(moved_to(subject.mesh, X), base + "_" + what, std::move(label),
                        shape_distances(subject.mesh, X) / subject.mean_edge);
    };
    std::vector<output::Panel> panels{coloured(trial.noisy, "noisy", "noisy")};
    Names labels;
    for (const SearchResult& result : trial.results) {
        if (!result.defined) continue;
        labels.push_back(method_title(result) + ", gain " + readable(result.gain(), 2));
        panels.push_back(coloured(result.X, std::string(denoising_entry(result.method).name), labels.back()));
    }
    output::FigureRequest request{.id = base,
                                  .title = words.line("figure.title", "mesh"_a = mesh.name()),
                                  .subtitle = words.line("figure.subtitle", "noise"_a = trial.title()),
                                  .range = range_from_zero(panels, "pale", words.line("figure.quantity"), 0.01, "mean edges"),
                                  .layout = output::Layout::one_frame};
    panels.insert(panels.begin(), panel_of(subject.mesh, base + "_clean", "clean"));
    request.panels = std::move(panels);
    const std::string name = subject.is_patch() ? words.line("figure.patch", "mesh"_a = mesh.name()) : mesh.name();
    const double error = trial.results.front().noisy.shape / subject.mean_edge;
    add_figure(answer, std::move(request), words.line("figure.caption", "mesh"_a = name, "noise"_a = trial.title()),
               words.line("figure.alt", "mesh"_a = mesh.name(), "error"_a = readable(error, 2), "methods"_a = joined(labels)));
}

}   // namespace meshfolio::methods
