#include "base/number_text.h"
#include "geometry/linear/special_values.h"
#include "questions/core/study_list.h"
#include "questions/core/table.h"
#include "questions/q5_explicit/parts.h"

namespace meshfolio::q5_explicit {

namespace {

/// The top mode starts a thousandth of an edge high: factors below 10⁻⁸ are rounding and count as 0.
double above_rounding(double factor) { return factor < 1e-8 ? 0 : factor; }

/// A row of the table of a sweep.
struct Trial {
    const SmoothingRun& run;
    const Amplification& growth;
    std::string outcome;
};

std::vector<Trial> trials_of(const ExplicitStudy& study) {
    std::vector<Trial> trials;
    for (std::size_t i = 0; i < study.runs.size(); ++i) {
        const SmoothingRun& run = study.runs[i];
        const bool best = study.recommended && study.recommended->run == i;
        const int stop = best ? study.recommended->stopped.iterations : 0;
        const char* outcome = run.result.blew_up       ? "outcome.blew_up"
                              : !study.stable(i)       ? "outcome.growing"
                              : !best                  ? "outcome.stable"
                              : stop == run.iterations ? "outcome.recommended"
                                                       : "outcome.recommended.stopped";
        trials.push_back({run, study.amplification[i], words.line(outcome, "iteration"_a = run.result.blow_up_iteration, "stop"_a = stop)});
    }
    return trials;
}

/// The energy over the iterations. Beyond twenty the curve has made its point and would flatten all others.
report::Series energy_series(const ExplicitStudy& study, const SmoothingRun& run) {
    report::Series series{.name = words.line("energy.series", "limits"_a = in_limits(study.subject, run.lambda))};
    for (std::size_t t = 0; t < run.energy.size() && run.energy[t] < 20; ++t) {
        series.x.push_back(static_cast<double>(t));
        series.y.push_back(run.energy[t]);
    }
    return series;
}

}   // namespace

report::Table limit_table(const Studies& studies) {
    return table("q5_limits", words.line("limits"), studies)
        .column("mesh", &ExplicitStudy::name)
        .column("μ_max", {.unit = "1/length²", .digits = 4}, [](auto& s) { return s.subject.top.value; })
        .column("λ_crit", {.unit = "length²", .digits = 4}, [](auto& s) { return s.subject.critical; })
        .column("safe λ (Gershgorin)", {.unit = "length²", .digits = 4, .rounding = report::Column::Rounding::down},
                [](auto& s) { return s.subject.safe(); })
        .column("λ_crit/h̄²", &ExplicitStudy::critical_in_edges)
        .column("vertex", {.digits = 8}, [](auto& s) { return s.subject.top.vertex; })
        .column("vertices as large", [](auto& s) { return s.peaks.size(); })
        .column("vertices sharing the mode", {.digits = 2}, [](auto& s) { return s.subject.top.support; })
        .column("uniform μ_max", {.digits = 4}, [](auto& s) { return s.uniform.top; })
        .column("uniform λ_crit", {.digits = 4}, [](auto& s) { return s.uniform.critical; });
}

report::Table sweep_table(const ExplicitStudy& study) {
    const SmoothingSubject& s = study.subject;
    const bool closed = s.source->prepared->preflight.closed();
    const std::string caption = words.line("sweep", "mesh"_a = study.name()) + (closed ? "" : " " + words.line("sweep.open"));
    return table(id_of("q5", study.name(), "sweep_table"), caption, trials_of(study))
        .column("λ", {.unit = "length²"}, [](auto& t) { return t.run.lambda; })
        .column("λ/λ_crit", [&](auto& t) { return t.run.lambda / s.critical; })
        .column("λ/h̄²", [&](auto& t) { return t.run.lambda / (s.mean_edge * s.mean_edge); })
        .column("iterations", {.digits = 4}, [](auto& t) { return t.run.result.iterations; })
        .column("top mode ×, predicted", {.digits = 4}, [](auto& t) { return above_rounding(t.growth.predicted); })
        .column("top mode ×, measured", {.digits = 4}, [](auto& t) { return above_rounding(t.growth.measured); })
        .column("energy", {.unit = "of input"}, [](auto& t) { return t.run.energy.back(); })
        .column("rms moved", {.unit = "% of box"}, [&](auto& t) { return 100 * t.run.moved.rms / s.diagonal; })
        .column("volume", {.unit = "% of input", .digits = 4}, [](auto& t) { return cell_of(100 * t.run.volume_ratio); })
        .column("smallest angle", {.unit = "°"}, [](auto& t) { return t.run.smallest_angle * 180 / pi; })
        .column("inverted faces", {.digits = 6}, [](auto& t) { return t.run.moved.inverted_faces; })
        .column("outcome", &Trial::outcome);
}

report::Plot energy_plot(const ExplicitStudy& study) {
    report::Plot plot{
        .id = id_of("q5", study.name(), "energy"), .x_label = "iteration", .y_label = words.line("energy.axis"), .log_y = true};
    std::vector<std::string> falling, rising, cut;
    for (const SmoothingRun& run : study.runs) {
        const std::string limits = in_limits(study.subject, run.lambda);
        plot.series.push_back(energy_series(study, run));
        if (plot.series.back().y.size() < run.energy.size()) cut.push_back(limits);
        (run.energy.back() < 1 ? falling : rising).push_back(limits);
    }
    plot.caption = words.line(rising.empty()    ? "energy.falling"
                              : falling.empty() ? "energy.rising"
                                                : "energy.both",
                              "mesh"_a = study.name(), "falling"_a = listed(falling), "rising"_a = listed(rising));
    if (!cut.empty()) plot.caption += " " + words.line("energy.cut", "cut"_a = listed(cut));
    plot.alt = plot.caption;
    return plot;
}

}   // namespace meshfolio::q5_explicit
