#include <Eigen/Geometry>

#include "questions/stability/parts.h"

namespace meshfolio::stability {

namespace {

/// The direction of the renderer's three-quarter view, precise enough to see a patch from above.
const Vector3 towards_viewer = Vector3(0.53, 0.37, 0.76).normalized();

/// The positions turned about a vertex so that its normal faces the viewer.
Positions turned(const TriangleMesh& mesh, int vertex) {
    const Vector3 normal = vertex_normals(mesh).row(vertex);
    if (!(normal.squaredNorm() > 0)) return mesh.X;
    const Eigen::Matrix3d turn = Eigen::Quaterniond::FromTwoVectors(normal, towards_viewer).toRotationMatrix();
    return (mesh.X.rowwise() - mesh.X.row(vertex)) * turn.transpose();
}

/// Adds a figure with one colour range from `low` to 1 for all panels.
void add_multiples(Answer& answer, output::FigureRequest request, const std::string& caption, const std::string& colormap,
                   const std::string& quantity, double low) {
    request.range = output::robust_range(request.panels, colormap, quantity, "", 1);
    request.range->low = low;
    request.range->high = 1;
    request.range->clipped_below = request.range->clipped_above = 0;
    request.layout = output::Layout::multiples;
    add_figure(answer, std::move(request), caption, caption);
}

using Style = report::Series::Style;

struct OperatorRow {
    const StabilityStudy& study;
    const OperatorLimit& limit;
    const ModeGrowth* growth = nullptr;
};
std::vector<OperatorRow> operator_rows(const Studies& studies) {
    std::vector<OperatorRow> rows;
    for (const StabilityStudy& study : studies)
        for (const OperatorLimit* limit : study.operators()) rows.push_back({study, *limit});
    return rows;
}

struct UnitRow {
    const StabilityStudy& study;
    std::string name;
    double lambda;   // [length²]

    StepInUnits units() const { return step_in_units(lambda, study.cotangent.critical(), study.mean_edge); }
};

/// |1 − λμ|ᵗ or what was measured of it, at some fifteen steps of the run.
/// @param first  step to begin with: runs that obey one law would hide each other, so their points alternate
report::Series curve(const std::string& name, const std::string& step, const ModeGrowth& growth, bool measured, double first = 0) {
    report::Series series{.name = name, .style = measured ? Style::points : Style::dashed, .panel = step};
    const int stride = std::max(2, growth.steps() / 15);
    for (int t = static_cast<int>(first * stride); t <= growth.steps(); t += stride)
        add_point(series, t, measured ? growth.factor[t] : growth.predicted(t));
    return series;
}

std::string vertex_text(int vertex) { return vertex >= 0 ? readable_count(vertex) : "–"; }

std::string when(int iteration) { return iteration > 0 ? readable_count(iteration) : "never"; }

const char* end_of(const Smoothed& run) { return run.blew_up ? "blow-up" : run.collapse_iteration > 0 ? "collapse" : "number of steps"; }

}   // namespace

Neighbourhood neighbourhood(const TriangleMesh& mesh, const MeshTopology& topology, int vertex, int rings) {
    std::vector<bool> within(mesh.vertex_count());
    const auto is_within = [&](int v) { return within[v]; };
    std::vector<int> front{vertex}, faces;
    is_within(vertex) = true;
    for (int ring = 1; ring <= rings; ++ring) {
        std::vector<int> next;
        for (const int v : front) {
            for (const int w : std::span(topology.neighbours.begin(v), topology.neighbours.end(v))) {
                if (is_within(w)) continue;
                is_within(w) = true;
                next.push_back(w);
            }
        }
        front = std::move(next);
    }
    for (int t = 0; t < mesh.face_count(); ++t)
        if (std::ranges::all_of(mesh.F.row(t), is_within)) faces.push_back(t);
    const TriangleMesh kept{turned(mesh, vertex), mesh.F(faces, Eigen::all)};
    CompactMesh compact = without_unreferenced_vertices(kept);
    Neighbourhood patch{std::move(compact.mesh), std::move(compact.original), 0};
    while (patch.original[patch.vertex] != vertex) ++patch.vertex;
    return patch;
}

void add_limiting_vertex_figures(Answer& answer, const Studies& studies, const std::string& colormap) {
    constexpr int rings = 4;
    output::FigureRequest whole{.id = "stability_top_modes", .title = words.line("top_modes.title")};
    output::FigureRequest near{.id = "stability_close_ups",
                               .title = words.line("close_ups.title"),
                               .subtitle = words.line("close_ups.subtitle", "rings"_a = rings),
                               .edges = true};
    std::string caption = words.line("close_ups.caption");
    for (const StabilityStudy& study : studies) {
        const LimitingVertex& v = study.limiting;
        const Vector& mode = study.cotangent.certificate.top.mode;
        const Vector height = mode / mode.cwiseAbs().maxCoeff();
        const std::string label = study.name() + ", vertex " + std::to_string(v.vertex);
        const Neighbourhood patch = neighbourhood(study.mesh(), study.topology(), v.vertex, rings);
        whole.panels.push_back(panel_of(moved_to(study.mesh(), turned(study.mesh(), v.vertex)), id_of("stability", study.name(), "mode"),
                                        label, height.cwiseAbs()));
        whole.panels.back().marked_vertices = {v.vertex};
        near.panels.push_back(panel_of(patch.mesh, id_of("stability", study.name(), "patch"), label, height(patch.original)));
        near.panels.back().marked_vertices = {patch.vertex};
        caption +=
            " " + words.line("close_ups.caption.mesh", "mesh"_a = study.name(), "angle"_a = readable(v.smallest_angle * 180 / pi, 2));
    }
    add_multiples(answer, std::move(whole), words.line("top_modes.caption"), colormap, "|φ| / max |φ|", 0);
    // A signed range is white at 0, so edges stay visible.
    add_multiples(answer, std::move(near), caption, "diverging", "φ / max |φ|", -1);
}

report::Table certificate_table(const Studies& studies) {
    return table("stability_certificates", words.line("certificates"), operator_rows(studies))
        .column("mesh", [](auto& r) { return r.study.name(); })
        .column("operator", [](auto& r) { return r.limit.name; })
        .column("vertex", {.digits = 8}, [](auto& r) { return r.limit.certificate.top.vertex; })
        .column("sharing", {.unit = "vertices"}, [](auto& r) { return r.limit.certificate.top.support; })
        .column("stable up to λ", {.unit = "length²", .digits = 10, .rounding = Rounding::down},
                [](auto& r) { return r.limit.certificate.lambda_low(); })
        .column("unstable beyond λ", {.unit = "length²", .digits = 10, .rounding = Rounding::up},
                [](auto& r) { return r.limit.certificate.lambda_high(); })
        .column("width", {.unit = "relative", .digits = 2, .rounding = Rounding::up},
                [](auto& r) { return r.limit.certificate.relative_width(); })
        .column("factorisations", [](auto& r) { return r.limit.certificate.factorisations; })
        .column("below 0", {.unit = "of μ_max", .digits = 2, .rounding = Rounding::up},
                [](auto& r) { return -r.limit.certificate.bottom.mu_low / r.limit.certificate.mu_high; })
        .column("safe λ", {.unit = "length²", .digits = 4, .rounding = Rounding::down},
                [](auto& r) { return r.limit.certificate.lambda_safe(); })
        .column("bound / μ_max", [](auto& r) { return r.limit.certificate.top.upper_bound / r.limit.certificate.top.value; });
}

report::Table unit_table(const Studies& studies) {
    std::vector<UnitRow> rows;
    for (const StabilityStudy& study : studies) {
        rows.push_back({study, words.line("units.limit"), study.cotangent.critical()});
        rows.push_back({study, words.line("units.monotone"), 0.5 * study.cotangent.critical()});
        rows.push_back({study, words.line("units.safe"), study.cotangent.certificate.lambda_safe()});
        rows.push_back({study, words.line("units.hundredth"), 0.01 * study.mean_edge * study.mean_edge});
    }
    return table("stability_units", words.line("units"), rows)
        .column("mesh", [](auto& r) { return r.study.name(); })
        .column("step", &UnitRow::name)
        .column("λ", {.unit = "length²", .digits = 4, .rounding = Rounding::down}, [](auto& r) { return r.units().raw; })
        .column("τ", {.digits = 4}, [](auto& r) { return r.units().tau; })
        .column("λ/h̄²", [](auto& r) { return r.units().h2; })
        .column("ten steps reach", {.unit = "% of box"}, [](auto& r) { return 100 * smoothing_strength(10 * r.lambda, r.study.diagonal); });
}

report::Table growth_table(const Studies& studies) {
    std::vector<OperatorRow> rows;
    for (const auto& [study, limit, none] : operator_rows(studies))
        for (const ModeGrowth* growth : {&limit.below, &limit.beyond}) rows.push_back({study, limit, growth});
    return table("stability_growth", words.line("growths"), rows)
        .column("mesh", [](auto& r) { return r.study.name(); })
        .column("operator", [](auto& r) { return r.limit.name; })
        .column("λ/λ_crit", [](auto& r) { return r.growth->lambda / r.limit.critical(); })
        .column("steps", {.digits = 5}, [](auto& r) { return r.growth->steps(); })
        .column("predicted factor", {.digits = 6}, [](auto& r) { return r.growth->predicted(r.growth->steps()); })
        .column("measured factor", {.digits = 6}, [](auto& r) { return r.growth->factor.back(); })
        .column("measured/predicted − 1", {.digits = 2}, [](auto& r) { return over_predicted(*r.growth) - 1; })
        .column("energy", {.unit = "of start"}, [](auto& r) { return r.growth->energy_ratio; });
}

report::Plot growth_plot(const StabilityStudy& study) {
    const auto end = [](const ModeGrowth& growth, int digits) { return readable(growth.factor.back(), digits); };
    report::Plot plot{.id = id_of("stability", study.name(), "growth"),
                      .caption = words.line("growth", "mesh"_a = study.name(), "steps"_a = study.cotangent.beyond.steps()),
                      .x_label = "step",
                      .y_label = words.line("growth.y"),
                      .log_y = true};
    plot.alt = words.line("growth.alt", "caption"_a = plot.caption, "cotangent_beyond"_a = end(study.cotangent.beyond, 4),
                          "uniform_beyond"_a = end(study.uniform.beyond, 4), "cotangent_below"_a = end(study.cotangent.below, 3),
                          "uniform_below"_a = end(study.uniform.below, 3));
    for (const OperatorLimit* limit : study.operators()) {
        const double first = limit == &study.cotangent ? 0 : 0.5;
        plot.series.push_back(curve(limit->name, "1.01 λ_crit", limit->beyond, true, first));
        plot.series.push_back(curve(limit->name, "0.99 λ_crit", limit->below, true, first));
    }
    plot.series.push_back(curve("predicted", "1.01 λ_crit", study.cotangent.beyond, false));
    plot.series.push_back(curve("predicted", "0.99 λ_crit", study.cotangent.below, false));
    return plot;
}

report::Table flow_table(const RebuiltFlow& flow) {
    return table(id_of("stability", flow.name(), "flow_table"),
                 words.line("flow_runs", "mesh"_a = flow.name(), "diagonals"_a = readable(SmoothingOptions().blow_up_at),
                            "steps"_a = flow.iterations, "share"_a = readable(flow.share, 3), "beyond"_a = readable(flow.beyond, 1),
                            "frozen_steps"_a = flow.frozen.iterations),
                 flow.runs())
        .column("run", [](auto& r) { return r.first; })
        .column("largest λμ_max", {.digits = 4}, [](auto& r) { return largest_product(r.second->run); })
        .column("beyond 2 in step", [](auto& r) { return when(r.second->run.crossing_iteration); })
        .column("at vertex", [](auto& r) { return vertex_text(r.second->run.crossing_vertex); })
        .column(words.line("flow_runs.turned"), [](auto& r) { return when(r.second->turned_iteration); })
        .column("face", [](auto& r) { return vertex_text(r.second->turned_face); })
        .column("blew up in step", [](auto& r) { return when(r.second->run.blow_up_iteration); })
        .column("at vertex", {.unit = "first"}, [](auto& r) { return vertex_text(r.second->run.blow_up_vertex); })
        .column("turned at the end", {.unit = "faces", .digits = 6}, [](auto& r) { return r.second->inverted; });
}

report::Table flow_time_table(const RebuiltFlow& flow) {
    return table(id_of("stability", flow.name(), "flow_time"), words.line("flow_time", "mesh"_a = flow.name()), flow.runs())
        .column("run", [](auto& r) { return r.first; })
        .column("first λ", {.unit = "length²", .digits = 4}, [](auto& r) { return r.second->lambda; })
        .column("last λ", {.unit = "of the first"}, [](auto& r) { return r.second->run.steps.back().lambda / r.second->lambda; })
        .column("steps done", {.digits = 6}, [](auto& r) { return r.second->run.iterations; })
        .column("time reached", {.unit = "length²", .digits = 4}, [](auto& r) { return r.second->run.time; })
        .column("time reached", {.unit = "% of steps × λ", .digits = 4},
                [](auto& r) { return 100 * r.second->run.time / (r.second->lambda * r.second->iterations); })
        .column("ended by", [](auto& r) { return end_of(r.second->run); });
}

report::Plot flow_plot(const RebuiltFlow& flow) {
    const Smoothed &fixed = flow.fixed.run, &frozen = flow.frozen.run;
    const auto largest = [](const Smoothed& run) { return readable(largest_product(run), 3); };
    const std::string until =
        frozen.blew_up ? words.line("flow.until", "step"_a = frozen.blow_up_iteration, "vertex"_a = frozen.blow_up_vertex) : "";
    report::Plot plot{
        .id = id_of("stability", flow.name(), "flow"),
        .caption = words.line("flow", "mesh"_a = flow.name(), "first"_a = readable(fixed.steps.front().top, 3), "fixed"_a = largest(fixed),
                              "adaptive"_a = largest(flow.adaptive.run), "frozen"_a = largest(frozen), "until"_a = until),
        .x_label = "step",
        .y_label = words.line("flow.y"),
        .log_y = true};
    for (const auto& [name, watched] : flow.runs()) {
        report::Series& series = plot.series.emplace_back(report::Series{.name = name, .style = Style::line_and_points});
        for (const StepStability& step : watched->run.steps) add_point(series, double(series.x.size() + 1), step.top);
    }
    plot.series.push_back({.name = "limit 2", .x = {1, double(flow.iterations)}, .y = {2, 2}, .style = Style::dashed});
    return plot;
}

}   // namespace meshfolio::stability
