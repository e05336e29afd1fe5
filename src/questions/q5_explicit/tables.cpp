#include "geometry/measures/mesh_facts.h"
#include "questions/q5_explicit/parts.h"
#include "questions/q5_explicit/study.h"

namespace meshfolio::q5_explicit {

namespace {

/// Returns a table with a row for each step on each mesh: λ, growth of the top mode, energy, size, motion, outcome.
report::Table steps_table(const Studies& studies) {
    struct Trial {
        const ExplicitStudy& study;
        const SmoothingRun& run;
        const Amplification& growth;
        std::string outcome;
    };
    std::vector<Trial> trials;
    for (const ExplicitStudy& study : studies) {
        for (std::size_t i = 0; i < study.runs.size(); ++i) {
            const SmoothingRun& run = study.runs[i];
            const bool recommended = study.recommended && study.recommended->run == i;
            const char* key = run.result.blew_up ? "outcome.blew_up"
                              : !study.stable(i) ? "outcome.growing"
                              : recommended      ? "outcome.recommended"
                                                 : "outcome.stable";
            trials.push_back({study, run, study.amplification[i], words.line(key, "iteration"_a = run.result.blow_up_iteration)});
        }
    }
    // The top mode starts a thousandth of an edge high: smaller factors are rounding.
    const auto factor = [](double x) { return x < 1e-8 ? 0 : x; };
    const auto unless_blown = [](const Trial& t, double x) { return cell_of(x, !t.run.result.blew_up); };
    const auto left = [=](const Trial& t, double share) { return unless_blown(t, std::abs(share) < 1e-12 ? 0 : share); };
    return table("q5_steps", words.line("steps", "iterations"_a = studies.front().runs.front().iterations), trials)
        .column("mesh", [](auto& t) { return t.study.name(); })
        .column("λ", {.unit = "length²"}, [](auto& t) { return t.run.lambda; })
        .column("λ/λ_crit", [](auto& t) { return t.run.lambda / t.study.subject.critical; })
        .column("top mode ×, predicted", [=](auto& t) { return factor(t.growth.predicted); })
        .column("measured", [=](auto& t) { return factor(t.growth.measured); })
        .column("energy", {.unit = "of input"}, [=](auto& t) { return left(t, t.run.energy.back()); })
        .column("size", {.unit = "% of input"}, [=](auto& t) { return left(t, 100 * t.run.size.back()); })
        .column("rms moved", {.unit = "% of box"},
                [=](auto& t) { return unless_blown(t, 100 * t.run.moved.rms / t.study.subject.diagonal); })
        .column("faces turned over", {.digits = 6}, [=](auto& t) { return unless_blown(t, t.run.moved.inverted_faces); })
        .column("outcome", &Trial::outcome);
}

report::Table bounds_table(const Studies& studies) {
    return table("q5_bounds", words.line("bounds"), studies)
        .column("mesh", &ExplicitStudy::name)
        .column("μ_max", {.unit = "1/length²", .digits = 4}, [](auto& s) { return s.subject.top.value; })
        .column("safe λ (Gershgorin)", {.unit = "length², rounded down", .digits = 4, .rounding = Rounding::down},
                [](auto& s) { return s.subject.safe(); })
        .column("vertex", {.digits = 8}, [](auto& s) { return s.subject.top.vertex; })
        .column("vertices as large", [](auto& s) { return s.peaks.size(); })
        .column("uniform μ_max", {.digits = 4}, &ExplicitStudy::uniform_top)
        .column("uniform λ_crit", {.digits = 4}, &ExplicitStudy::uniform_critical);
}

}   // namespace

report::Plot damping_plot() {
    constexpr double end = 2.4, low = 1 - end;
    report::Series explicit_factor{.name = "1 − λμ"}, implicit_factor{.name = "1/(1 + λμ)"};
    for (int i = 0; i <= 48; ++i) {
        const double x = end * i / 48;
        add_point(explicit_factor, x, 1 - x);
        add_point(implicit_factor, x, 1 / (1 + x));
    }
    for (const double x : explicit_factor.x) {
        explicit_factor.y_low.push_back(x < 2 ? undefined : low);
        explicit_factor.y_high.push_back(x < 2 ? undefined : 1);
    }
    return {.id = "q5_damping",
            .caption = words.line("damping"),
            .x_label = "λμ",
            .y_label = words.line("damping.axis"),
            .series = {std::move(explicit_factor), std::move(implicit_factor)},
            .vertical_lines = {{1, "½ λ_crit"}, {2, "λ_crit"}}};
}

report::Table limit_table(const Studies& studies) {
    const auto of_best = [](auto value_of) {
        return [=](const ExplicitStudy& s) { return s.recommended ? cell_of(value_of(s, *s.recommended)) : report::Cell(); };
    };
    return table("q5_limits", words.line("limits"), studies)
        .column("mesh", &ExplicitStudy::name)
        .column("λ_crit", {.unit = "length²"}, [](auto& s) { return s.subject.critical; })
        .column("λ_crit/h̄²", &ExplicitStudy::critical_in_edges)
        .column("top mode on", {.unit = "vertices", .digits = 2}, [](auto& s) { return s.subject.top.support; })
        .column("our λ", {.unit = "length²"}, of_best([](auto&, auto& best) { return best.stopped.lambda; }))
        .column("iterations", {.digits = 6}, of_best([](auto&, auto& best) { return best.stopped.iterations; }))
        .column("λt", {.unit = "h̄²", .digits = 2}, of_best([](auto& s, auto& best) { return s.in_edges(best.time()); }))
        .column("face angle before", {.unit = "°", .digits = 2}, of_best([](auto&, auto& best) { return best.roughness_before; }))
        .column("after", {.unit = "°", .digits = 2}, of_best([](auto&, auto& best) { return best.roughness_after; }))
        .column("size", {.unit = "% of input"}, of_best([](auto&, auto& best) { return 100 * best.stopped.size.back(); }));
}

report::Plot energy_plot(const Studies& studies) {
    constexpr double shown = 5;
    constexpr std::size_t most = 5;
    report::Plot plot{
        .id = "q5_energy", .caption = words.line("energy"), .x_label = "iteration", .y_label = words.line("energy.axis"), .log_y = true};
    for (const ExplicitStudy& study : studies) {
        const std::size_t count = study.runs.size();
        for (std::size_t i = 0; i < std::min(count, most); ++i) {
            // Evenly through the order of the steps, from the smallest to the largest.
            const SmoothingRun& run = study.runs[count <= most ? i : i * (count - 1) / (most - 1)];
            const int color = static_cast<int>(i);
            report::Series& series = plot.series.emplace_back(
                report::Series{.name = words.line("energy.series", "limits"_a = in_limits(study.subject, run.lambda)),
                               .color = color,
                               .pattern = color,
                               .panel = studies.size() > 1 ? study.name() : ""});
            for (std::size_t t = 0; t < run.energy.size() && run.energy[t] < shown; ++t) add_point(series, double(t), run.energy[t]);
        }
    }
    return plot;
}

void add_checks(report::Section& section, const Studies& studies) {
    for (const ExplicitStudy& study : studies) {
        const SmoothingSubject& subject = study.subject;
        const report::Fact mesh = "mesh"_a = subject.name();
        add(section, check_at_least(words.line("check.bound", mesh), subject.top.value, subject.top.upper_bound, 1e-9 * subject.top.value));
        const report::Check semidefinite =
            check_at_least(words.line("check.semidefinite", mesh), 0, subject.bottom.mu_low / subject.top.value, 1e-10);
        add(section, subject.bottom.semidefinite() || subject.bottom.indefinite()
                         ? semidefinite
                         : undecided(semidefinite, words.line("check.semidefinite.undecided")));
        for (std::size_t i = 0; i < study.runs.size(); ++i) {
            const SmoothingRun& run = study.runs[i];
            const report::Fact limits = "limits"_a = in_limits(subject, run.lambda);
            if (run.lambda > 0.9 * subject.critical) {
                const Amplification& a = study.amplification[i];
                add(section, check_near(words.line("check.top_mode", limits, mesh), 1, a.measured / a.predicted, 1e-4));
            }
            if (!study.stable(i)) continue;
            add(section, energy_check(words.line("check.energy", limits, mesh), run),
                report::within_rounding(
                    check_at_most(words.line("check.barycentre", limits, mesh), 0, barycentre_drift(subject, run.result.X), 1e-10),
                    coordinate_spacing(subject.mesh()) / subject.diagonal));
        }
    }
}

void add_appendix(report::Section& section, const Studies& studies) {
    add(section, steps_table(studies), bounds_table(studies));
    for (const ExplicitStudy& study : studies)
        if (study.subject.critical_floored > 0)
            add_words(section, words, "without_area", "triangles"_a = study.subject.preflight().zero_area_faces, "mesh"_a = study.name(),
                      "critical"_a = readable(study.subject.critical, 4), "floored"_a = readable(study.subject.critical_floored, 4));
}

void add_record(report::Section& section, const Studies& studies) {
    for (const ExplicitStudy& study : studies)
        section.parameters[words.line("parameter.critical", "mesh"_a = study.name())] = {plain_text(study.subject.critical, 6),
                                                                                         study.subject.critical, "length²"};
    section.parameters["iterations"] = studies.front().runs.front().iterations;
    section.parameters["operator"] = smoothing_words.line("parameter.operator");
    const bool all = std::ranges::all_of(studies, [](const ExplicitStudy& study) { return study.recommended.has_value(); });
    section.extent = words.line("extent", "meshes"_a = listed(names_of(studies)), "all"_a = all);
}

}   // namespace meshfolio::q5_explicit
