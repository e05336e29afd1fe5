#include <set>

#include "questions/q6_implicit/parts.h"
#include "questions/q6_implicit/study.h"

namespace meshfolio::q6_implicit {

report::Table grid_table(const Studies& studies) {
    struct Row {
        const ImplicitStudy& study;
        const SmoothingCell& cell;
        double moved() const { return vertex_rms(study.subject.mesh().X, cell.implicit_X); }
        double gap() const { return cell.has_explicit() ? vertex_rms(cell.implicit_X, cell.explicit_X) : NAN; }
        double percent(double length) const { return 100 * length / study.subject.diagonal; }
    };
    std::vector<Row> rows;
    for (const ImplicitStudy& study : studies)
        for (const SmoothingCell& cell : study.grid) rows.push_back({study, cell});
    return table("q6_grid", words.line("grid"), rows)
        .column("mesh", [](auto& r) { return r.study.name(); })
        .column("λ/λ_crit", {.digits = 2}, [](auto& r) { return r.cell.lambda / r.study.subject.critical; })
        .column("t", {.digits = 4}, [](auto& r) { return r.cell.iterations; })
        .column("energy, implicit", {.unit = "% of input"},
                [](auto& r) { return cell_of(100 * r.cell.implicit_energy, !r.cell.collapsed()); })
        .column("explicit", {.unit = "% of input"}, [](auto& r) { return cell_of(100 * r.cell.explicit_energy, r.cell.has_explicit()); })
        .column("moved, implicit", {.unit = "% of box"}, [](auto& r) { return r.percent(r.moved()); })
        .column("gap", {.unit = "% of box"}, [](auto& r) { return cell_of(r.percent(r.gap())); })
        .column("equal λt, apart", {.unit = "% of motion", .digits = 2}, [](auto& r) { return cell_of(100 * r.cell.apart); })
        .column("size, implicit", {.unit = "% of input"}, [](auto& r) { return 100 * r.cell.kept; })
        .column("faces turned", {.digits = 6}, [](auto& r) { return cell_of(r.cell.inverted_faces, !r.cell.collapsed()); })
        .column("blew up in", {.unit = "iteration", .digits = 6},
                [](auto& r) { return cell_of(r.cell.explicit_blow_up, r.cell.explicit_blow_up > 0); })
        .file_only();
}

report::Table cost_table(const Studies& studies) {
    std::vector<const ImplicitStudy*> rows;
    for (const ImplicitStudy& study : studies)
        if (study.good() && study.cost) rows.push_back(&study);
    const bool reached = std::ranges::all_of(rows, [](const ImplicitStudy* study) { return study->cost->reached(); });
    return table("q6_cost", words.line("cost", "unreached"_a = !reached, "most"_a = most_priced_steps), rows)
        .column("mesh", [](auto* s) { return s->name(); })
        .column("λ/λ_crit", {.digits = 2}, [](auto* s) { return s->good()->lambda / s->subject.critical; })
        .column("t", {.digits = 4}, [](auto* s) { return s->good()->iterations; })
        .column("λt", {.unit = "h̄²", .digits = 2}, [](auto* s) { return in_edges(*s, s->good()->time()); })
        .column("energy", {.unit = "% of input"}, [](auto* s) { return 100 * s->good()->implicit_energy; })
        .column("size", {.unit = "% of input"}, [](auto* s) { return 100 * s->good()->kept; })
        .column("face angle: input", {.unit = "°", .digits = 2}, [](auto* s) { return s->roughness; })
        .column("implicit", {.unit = "°", .digits = 2}, [](auto* s) { return s->cost->roughness; })
        .column("explicit", {.unit = "°", .digits = 2}, [](auto* s) { return cell_of(s->cost->explicit_roughness); })
        .column("explicit steps", {.digits = 5}, [](auto* s) { return cell_of(s->cost->explicit_steps, s->cost->reached()); })
        .column("price, explicit", {.unit = "× implicit", .digits = 2}, [](auto* s) { return cell_of(s->cost->ratio); });
}

report::Table price_table(const Studies& studies) {
    struct Row {
        const ImplicitStudy& study;
        std::size_t lambda;
        std::optional<BreakEven> even;
    };
    std::vector<Row> rows;
    std::vector<int> times;   // of all studies: the settings give them
    for (const ImplicitStudy& study : studies) {
        if (!study.prices.counted()) continue;
        times = study.iterations;
        for (std::size_t l = 0; l < study.lambdas.size(); ++l) rows.push_back({study, l, study.break_even(l)});
    }
    auto built = table("q6_prices", words.line("prices", "most"_a = most_priced_steps), rows);
    built.column("mesh", [](auto& r) { return r.study.name(); });
    built.column("λ/λ_crit", {.digits = 2}, [](auto& r) { return r.study.lambdas[r.lambda] / r.study.subject.critical; });
    for (const int t : times)
        built.column(words.line("head.time", "iterations"_a = t), {.digits = 2, .heat = Heat{1, 16}},
                     [&](auto& r) { return cell_of(r.study.price(r.lambda, t)); });
    built.column("pays from t", {.digits = 4}, [](auto& r) { return cell_of(r.even ? r.even->iterations : 0, r.even.has_value()); });
    built.column("size there", {.unit = "% of input"},
                 [](auto& r) { return cell_of(r.even ? 100 * r.even->kept : 0, r.even.has_value()); });
    built.column("too far from t", {.digits = 4},
                 [](auto& r) { return cell_of(r.study.too_far(r.lambda), r.study.too_far(r.lambda) > 0); });
    return built;
}

report::Plot gap_plot(const Studies& studies) {
    constexpr std::size_t most_together = 5;
    std::set<std::string> limits;
    report::Plot plot{.id = "q6_gaps", .x_label = "iteration t", .y_label = words.line("gaps.axis"), .log_x = true, .log_y = true};
    for (const ImplicitStudy& study : studies) {
        report::Series series{.name = study.name(), .style = report::Series::Style::line_and_points};
        for (const SchemeGap& gap : study.gaps()) add_point(series, gap.iterations, 100 * gap.share);
        if (series.x.empty()) continue;
        limits.insert(in_limits(study.subject, study.lambdas[*study.within_limit()]));
        plot.series.push_back(std::move(series));
    }
    if (plot.series.size() > most_together)
        for (report::Series& series : plot.series) series.panel = series.name;
    plot.caption = words.line("gaps", "limits"_a = listed({limits.begin(), limits.end()}));
    return plot;
}

void add_checks(report::Section& section, const Studies& studies) {
    for (const ImplicitStudy& study : studies) {
        const report::Fact mesh = "mesh"_a = study.name();
        add(section, check_near(words.line("check.damping", "modes"_a = study.damped_modes, mesh), 1, 1 + study.worst_damping, 1e-6));
        for (std::size_t l = 0; l < study.lambdas.size(); ++l) {
            const report::Fact limits = "limits"_a = in_limits(study.subject, study.lambdas[l]);
            add(section, energy_check(words.line("check.energy", limits, mesh), study.implicit_runs[l]));
        }
        add(section, check_at_most(words.line("check.huge_step", mesh), 1, study.huge_step_energy, 0));
    }
}

void add_record(report::Section& section, const Studies& studies) {
    const ImplicitStudy& last = studies.back();
    const Names times = each_of(last.iterations, [&](const int t) { return std::to_string(t); });
    section.parameters = {{"iterations", {listed(times), last.iterations}}, {"operator", smoothing_words.line("parameter.operator")}};
    section.extent =
        words.line("extent", "steps"_a = last.lambdas.size(), "counts"_a = listed(times), "meshes"_a = listed(names_of(studies)));
}

}   // namespace meshfolio::q6_implicit
