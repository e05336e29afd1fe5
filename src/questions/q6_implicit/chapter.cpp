// Question 6: implicit (backward Euler) smoothing after Desbrun et al. 1999, eq. 9, beside the explicit method.
#include <set>

#include "questions/q6_implicit/parts.h"

namespace meshfolio::q6_implicit {

namespace {

report::Table grid_table(const ImplicitStudy& study) {
    const double percent = 100 / study.subject.diagonal;
    const Positions& X = study.subject.mesh().X;
    const auto gap = [=](const SmoothingCell& c) {
        return c.has_explicit() ? cell_of(percent * vertex_rms(c.implicit_X, c.explicit_X)) : report::Cell();
    };
    return table(id_of("q6", study.name(), "grid"), words.line("grid", "mesh"_a = study.name()), study.grid)
        .column("λ", {.unit = "length²"}, &SmoothingCell::lambda)
        .column("λ/λ_crit", [&](auto& c) { return c.lambda / study.subject.critical; })
        .column("iterations", {.digits = 4}, &SmoothingCell::iterations)
        .column("energy, implicit", {.unit = "% of input"}, [](auto& c) { return cell_of(100 * c.implicit_energy, !c.collapsed()); })
        .column("energy, explicit", {.unit = "% of input"}, [](auto& c) { return cell_of(100 * c.explicit_energy, c.has_explicit()); })
        .column("moved, implicit (rms)", {.unit = "% of box"}, [&](auto& c) { return percent * vertex_rms(X, c.implicit_X); })
        .column("gap", {.unit = "% of box"}, gap)
        .column("equal λt, apart", {.unit = "% of motion", .digits = 2}, [](auto& c) { return cell_of(100 * c.apart); })
        .column("volume, implicit", {.unit = "% of input", .digits = 4}, [](auto& c) { return cell_of(100 * c.volume_ratio); })
        .column("inverted faces, implicit", {.digits = 6}, [](auto& c) { return cell_of(c.inverted_faces, !c.collapsed()); })
        .column("explicit blew up in", {.unit = "iteration", .digits = 6},
                [](auto& c) { return cell_of(c.explicit_blow_up, c.explicit_blow_up > 0); });
}

/// What is recommended, how smooth it is, and its price.
report::Table cost_table(const Studies& studies) {
    std::vector<const ImplicitStudy*> rows;
    for (const ImplicitStudy& study : studies)
        if (study.good() && study.cost) rows.push_back(&study);
    const bool reached = std::ranges::all_of(rows, [](const ImplicitStudy* study) { return study->cost->reached(); });
    return table("q6_cost", words.line("cost") + (reached ? "" : " " + words.line("cost.unreached", "most"_a = most_priced_steps)), rows)
        .column("mesh", [](auto* s) { return s->name(); })
        .column("λ/λ_crit", {.digits = 2}, [](auto* s) { return s->good()->lambda / s->subject.critical; })
        .column("t", {.digits = 4}, [](auto* s) { return s->good()->iterations; })
        .column("λt", {.unit = "h̄²", .digits = 2}, [](auto* s) { return in_edges(*s, s->good()->time()); })
        .column("energy", {.unit = "% of input"}, [](auto* s) { return 100 * s->good()->implicit_energy; })
        .column("size", {.unit = "% of input"}, [](auto* s) { return 100 * s->good()->kept; })
        .column("faces turned", {.digits = 6}, [](auto* s) { return s->good()->inverted_faces; })
        .column("face angle: input", {.unit = "°", .digits = 2}, [](auto* s) { return s->roughness; })
        .column("implicit", {.unit = "°", .digits = 2}, [](auto* s) { return s->cost->roughness; })
        .column("explicit", {.unit = "°", .digits = 2}, [](auto* s) { return cell_of(s->cost->explicit_roughness); })
        .column("explicit steps", {.digits = 5}, [](auto* s) { return cell_of(s->cost->explicit_steps, s->cost->reached()); })
        .column("price, explicit", {.unit = "× implicit", .digits = 2}, [](auto* s) { return cell_of(s->cost->ratio); });
}

/// The price of every λ × t, and from where on the implicit steps of each λ pay; no rows where nothing is counted.
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
    built.column("λt", {.unit = "h̄²", .digits = 2},
                 [](auto& r) { return cell_of(r.even ? in_edges(r.study, r.even->time()) : 0, r.even.has_value()); });
    built.column("size", {.unit = "% of input"}, [](auto& r) { return cell_of(r.even ? 100 * r.even->kept : 0, r.even.has_value()); });
    return built;
}

void add_checks(report::Section& section, const ImplicitStudy& study) {
    const report::Fact mesh = "mesh"_a = study.name();
    add(section, check_near(words.line("check.damping", "modes"_a = study.damped_modes, mesh), 1, 1 + study.worst_damping, 1e-6));
    for (std::size_t l = 0; l < study.lambdas.size(); ++l) {
        const report::Fact limits = "limits"_a = in_limits(study.subject, study.lambdas[l]);
        add(section, energy_check(words.line("check.energy", limits, mesh), study.implicit_runs[l]));
    }
    add(section, check_at_most(words.line("check.huge_step", mesh), 1, study.huge_step_energy, 0));
}

}   // namespace

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

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer{section_of("q6")};
    report::Section& section = answer.section;
    const auto meshes = meshes_for(library, settings, {"cube", "plane_ns", "fandisk_ns"}, section);
    const auto studies = studies_of(meshes, "implicit smoothing", settings, progress, section, implicit_study);
    section.answer = answer_of(studies);
    add_paragraphs(section, {summary_of(studies)});
    add_words(section, words, {"method", "results"});
    const bool has_views = std::ranges::any_of(studies, [](const ImplicitStudy& study) { return study.good() != nullptr; });
    const output::ColorRange colours = colours_of(studies);
    const auto pictured = studies.begin() + std::min<std::size_t>(3, studies.size());
    add_paragraphs(section, {rule_of(studies)});
    if (report::Table costs = cost_table(studies); !costs.rows.empty()) add(section, std::move(costs));
    for (auto study = studies.begin(); study != studies.end(); ++study) {
        if (study < pictured) add_matrix(answer, *study, colours, !has_views);
        add_paragraphs(section, {reading_of(*study)});
    }
    add_views(answer, studies, colours);
    add_paragraphs(section, {comparison_of(studies), larger_steps_of(studies)});
    if (report::Table prices = price_table(studies); !prices.rows.empty()) add(section, std::move(prices));
    add_paragraphs(section, {price_of(studies), quality_of(studies), verdict_of(studies)});

    begin_appendix(section);
    if (report::Plot gaps = gap_plot(studies); !gaps.series.empty()) add(section, std::move(gaps));
    for (auto study = pictured; study != studies.end(); ++study) add_matrix(answer, *study, colours, !has_views);
    for (const ImplicitStudy& study : studies) {
        add(section, grid_table(study));
        add_checks(section, study);
    }

    const ImplicitStudy& last = studies.back();
    const Names times = each_of(last.iterations, [&](const int t) { return std::to_string(t); });
    section.parameters = {{"iterations", {listed(times), last.iterations}}, {"operator", smoothing_words.line("parameter.operator")}};
    section.extent =
        words.line("extent", "steps"_a = last.lambdas.size(), "counts"_a = listed(times), "meshes"_a = listed(names_of(studies)));
    return answer;
}

extern const Chapter chapter{
    .id = "q6",
    .code = {{"smooth", "src/geometry/smoothing/laplacian_smoothing.cpp"},
             {"implicit_step", "src/geometry/smoothing/laplacian_smoothing.cpp"},
             {"ImplicitSolver::prepare", "src/geometry/smoothing/implicit_solver.cpp"},
             {"answer", "src/questions/q6_implicit/chapter.cpp"}},
    .answer = answer,
};

}   // namespace meshfolio::q6_implicit
