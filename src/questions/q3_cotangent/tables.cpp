
#include "questions/bench/estimators.h"
#include "questions/q3_cotangent/parts.h"

namespace meshfolio::q3_cotangent {

namespace {

/// Returns the estimators that have a column in the errors of this question.
std::vector<const Estimator*> compared_estimators() {
    std::vector<const Estimator*> chosen;
    for (const Estimator& e : estimators())
        if (!e.in_q3.empty()) chosen.push_back(&e);
    return chosen;
}

}   // namespace

report::Table difference_table(const Comparisons& meshes) {
    const auto in_percent_of_uniform = [](const CotangentComparison& c) {
        const bool curved = (c.drift > 1e-9 || c.precision > 1e-9) && c.rms_uniform > 0;
        return curved ? report::Cell(100 * c.rms_difference / c.rms_uniform) : report::Cell();
    };
    return table("q3_differences", words.line("differences"), meshes)
        .column("mesh", [](auto& c) { return c.name(); })
        .column("uniform, median", {.unit = "1/length", .digits = 4}, [](auto& c) { return cell_of(summary_of(c.uniform).median); })
        .column("uniform, std", {.unit = "1/length"}, [](auto& c) { return cell_of(summary_of(c.uniform).standard_deviation); })
        .column("cotangent, median", {.unit = "1/length", .digits = 4}, [](auto& c) { return cell_of(summary_of(c.cotangent).median); })
        .column("cotangent, std", {.unit = "1/length"}, [](auto& c) { return cell_of(summary_of(c.cotangent).standard_deviation); })
        .column("uniform, jump", {.unit = "1/length"}, &CotangentComparison::jump_uniform)
        .column("cotangent, jump", {.unit = "1/length"}, &CotangentComparison::jump_cotangent)
        .column("difference, rms", {.unit = "1/length"}, &CotangentComparison::rms_difference)
        .column("difference, largest", {.unit = "1/length"}, [](auto& c) { return largest_magnitude(c.difference); })
        .column("difference, rms", {.unit = "% of uniform rms"}, in_percent_of_uniform)
        .column("other sign", {.unit = "% of vertices"}, [](auto& c) { return 100 * c.sign_change; })
        .file_only();
}

report::Table variant_table(const Comparisons& meshes) {
    return table("q3_variants", words.line("variants"), parts_within(meshes, &CotangentComparison::variants))
        .column("mesh", [](auto& row) { return row.whole.name(); })
        .column("operator", [](auto& row) { return row.part.name; })
        .column("negative weights, inside", {.unit = "edges"}, [](auto& row) { return row.part.negative_inside; })
        .column("negative weights, boundary", {.unit = "edges"}, [](auto& row) { return row.part.negative_boundary; })
        .column("smallest weight", [](auto& row) { return row.part.smallest_weight; })
        .column("largest inside", [](auto& row) { return row.part.inside; })
        .column("change inside, rms", {.unit = "%"}, [](auto& row) { return cell_of(100 * row.part.change); })
        .column("largest on boundary", [](auto& row) { return row.part.boundary; })
        .file_only();
}

report::Table error_table(const BenchRuns& runs, Norm norm, const std::string& key, const std::string& name) {
    const auto undefined_of = [](const BenchRun& run) {
        int undefined = 0;
        for (const Estimator* e : compared_estimators()) undefined += run.finest().error(e->key).undefined;
        return undefined;
    };
    const bool some_undefined = std::ranges::any_of(runs, undefined_of);
    std::string caption = words.line("errors", "norm"_a = name, "largest"_a = norm == &EstimateError::linf);
    if (some_undefined) caption += " " + words.line("errors.undefined");
    auto errors = table("q3_errors_" + key, caption, runs);
    errors.column("surface", &BenchRun::surface).column("triangulation", [](auto& run) { return name_of(run.kind); });
    for (const Estimator* e : compared_estimators()) {
        errors.column(std::string(e->in_q3), {.unit = "%"}, [=](auto& run) { return 100 * run.finest().error(e->key).*norm; });
        if (e->key == H_with(areas_used))
            errors.column("order", {.rounding = Rounding::tenths},
                          [=](auto& run) { return cell_of(run.errors(e->key, norm).order().exponent); });
    }
    if (some_undefined) errors.column("without H", {.unit = "vertices"}, undefined_of);
    return errors;
}

report::Plot error_curves(const BenchRuns& runs) {
    return convergence_plot("q3_convergence", words, runs,
                            {{"H.uniform", "convergence.uniform"}, {H_with(areas_used), "convergence.cotangent"}});
}

void add_checks(report::Section& section, const BenchRuns& runs, const PlaneTest& plane, const Comparisons& meshes) {
    for (const AreaForm form : area_forms) {
        const Order order = run_on(runs, "torus", MeshKind::regular).errors(H_with(form)).order();
        add(section, check_near(words.line("check.order", "areas"_a = area_name(form)), 2, order.exponent, 0.2));
    }
    add(section, pentagon_check(runs), check_at_most(words.line("check.linear_precision"), 0, plane.cotangent, 1e-10));
    for (const CotangentComparison& c : meshes) {
        if (!c.subject.plane_normal || c.subject.interior == 0) continue;
        const report::Check flat =
            check_at_most(words.line("check.flat", "mesh"_a = c.name()), 0, c.precision, 1e-5, words.line("check.flat.note"));
        const bool has_area = c.subject.preflight().zero_area_faces == 0;
        add(section, has_area || !flat.failed() ? flat : undecided(flat, words.line("check.flat.without_area")));
    }
}

void add_trust(report::Section& section, const std::vector<IndicatorTrial>& trials) {
    double off = 0, found = 1;
    int large = 0;
    for (const auto& [mesh, on] : trials) {
        if (on.actual < 0.05) continue;
        ++large;
        off = std::max(off, std::abs(on.indicated / on.actual - 1));
        found = std::min(found, on.found);
    }
    const IndicatorTrial& best = *std::ranges::min_element(trials, {}, [](const IndicatorTrial& t) { return t.indicator.actual; });
    add_words(section, words, "trust", "large"_a = large, "off"_a = readable_percent(rounded_up(off, 2), 2),
              "found"_a = readable_percent(rounded_down(found, 2), 2), "best"_a = best.mesh,
              "indicated"_a = readable_percent(best.indicator.indicated, 2), "actual"_a = readable_percent(best.indicator.actual, 2));
    add(section, table("q3_indicator", words.line("indicator"), trials)
                     .column("mesh", &IndicatorTrial::mesh)
                     .column("vertices", [](auto& t) { return t.indicator.vertices; })
                     .column("indicated", {.unit = "%"}, [](auto& t) { return 100 * t.indicator.indicated; })
                     .column("actual", {.unit = "%"}, [](auto& t) { return 100 * t.indicator.actual; })
                     .column("ratio", [](auto& t) { return cell_of(t.indicator.indicated / t.indicator.actual, t.indicator.actual > 0); })
                     .column("worst tenth found", {.unit = "%"}, [](auto& t) { return 100 * t.indicator.found; }));
    const ErrorIndicator& random = trials.back().indicator;
    add(section, check_near(words.line("check.indicator", "mesh"_a = trials.back().mesh), 1, random.indicated / random.actual, 0.05));
}

}   // namespace meshfolio::q3_cotangent
