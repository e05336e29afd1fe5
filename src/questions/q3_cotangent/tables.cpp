#include "base/number_text.h"
#include "questions/core/table.h"
#include "questions/q3_cotangent/parts.h"

namespace meshfolio::q3_cotangent {

namespace {

/// A row of the table of errors: how its estimate is called, its error on a mesh, and the vertices there that have none.
struct Estimate {
    std::string name;
    std::function<FieldError(const CotangentErrors&)> error;
    std::function<int(const CotangentErrors&)> undefined = [](const CotangentErrors&) { return 0; };
};

std::vector<Estimate> estimates() {
    std::vector<Estimate> all{{"uniform, × 4/h²", &CotangentErrors::uniform}};
    for (std::size_t form = 0; form < area_forms.size(); ++form)
        all.push_back({"cotangent, " + area_name(area_forms[form]), [form](const CotangentErrors& e) { return e.H[form]; },
                       [form](const CotangentErrors& e) { return e.undefined[form]; }});
    all.push_back({"cotangent, clamped", &CotangentErrors::clamped});
    return all;
}

}   // namespace

report::Table difference_table(const Comparisons& meshes) {
    const auto in_percent_of_uniform = [](const CotangentComparison& c) {
        const bool curved = (c.drift > 1e-9 || c.precision > 1e-9) && c.rms_uniform > 0;
        return curved ? report::Cell(100 * c.rms_difference / c.rms_uniform) : report::Cell();
    };
    return table("q3_differences", words.line("differences"), meshes)
        .column("mesh", [](auto& c) { return c.subject.name(); })
        .column("uniform, median", {.unit = "1/length", .digits = 4}, [](auto& c) { return cell_of(summary_of(c.uniform).median); })
        .column("uniform, std", {.unit = "1/length"}, [](auto& c) { return cell_of(summary_of(c.uniform).standard_deviation); })
        .column("cotangent, median", {.unit = "1/length", .digits = 4}, [](auto& c) { return cell_of(summary_of(c.cotangent).median); })
        .column("cotangent, std", {.unit = "1/length"}, [](auto& c) { return cell_of(summary_of(c.cotangent).standard_deviation); })
        .column("uniform, jump", {.unit = "1/length"}, &CotangentComparison::jump_uniform)
        .column("cotangent, jump", {.unit = "1/length"}, &CotangentComparison::jump_cotangent)
        .column("difference, rms", {.unit = "1/length"}, &CotangentComparison::rms_difference)
        .column("difference, largest", {.unit = "1/length"}, [](auto& c) { return largest_magnitude(c.difference); })
        .column("difference, rms", {.unit = "% of uniform rms"}, in_percent_of_uniform)
        .column("other sign", {.unit = "% of vertices"}, [](auto& c) { return 100 * c.sign_change; });
}

report::Table variant_table(const Comparisons& meshes) {
    return table("q3_variants", words.line("variants"), parts_within(meshes, &CotangentComparison::variants))
        .column("mesh", [](auto& row) { return row.whole.subject.name(); })
        .column("operator", [](auto& row) { return row.part.name; })
        .column("negative weights, inside", {.unit = "edges"}, [](auto& row) { return row.part.negative_inside; })
        .column("negative weights, boundary", {.unit = "edges"}, [](auto& row) { return row.part.negative_boundary; })
        .column("smallest weight", [](auto& row) { return row.part.smallest_weight; })
        .column("largest inside", [](auto& row) { return row.part.inside; })
        .column("change inside, rms", {.unit = "%"}, [](auto& row) { return cell_of(100 * row.part.change); })
        .column("largest on boundary", [](auto& row) { return row.part.boundary; });
}

report::Table error_table(const Refinements& refinements, double FieldError::*norm, const std::string& key, const std::string& name) {
    auto errors = table("q3_errors_" + key, words.line("errors", "norm"_a = name), estimates());
    errors.column("estimator", &Estimate::name);
    for (const CotangentRefinement& r : refinements)
        errors.column(r.title(), {.unit = "%", .best = smallest}, [&](auto& estimate) { return 100 * estimate.error(r.finest()).*norm; });
    return errors.column("without H", {.unit = "vertices"}, [&](auto& estimate) {
        int undefined = 0;
        for (const CotangentRefinement& r : refinements) undefined += estimate.undefined(r.finest());
        return undefined;
    });
}

report::Table order_table(const Refinements& refinements) {
    const auto order = [](std::size_t form, double FieldError::*norm = &FieldError::l2) {
        return [=](const CotangentRefinement& r) { return cell_of(cotangent_H(r, form, norm).order()); };
    };
    return table("q3_orders", words.line("orders", "meshes"_a = refinements.front().levels.size()), refinements)
        .column("surface", [](auto& r) { return r.surface.name; })
        .column("triangulation", [](auto& r) { return name_of(r.triangulation); })
        .column("from", {.unit = "vertices"}, [](auto& r) { return r.levels.front().vertices; })
        .column("to", {.unit = "vertices"}, [](auto& r) { return r.finest().vertices; })
        .column("smallest angle", {.unit = "°"}, [](auto& r) { return r.finest().smallest_angle * 180 / M_PI; })
        .column("negative weights", {.unit = "% of edges"}, [](auto& r) { return 100 * r.finest().negative_weights; })
        .column("uniform", [](auto& r) { return cell_of(scaled_uniform_H(r).order()); })
        .column("barycentric", order(barycentric))
        .column("barycentric, L∞", order(barycentric, &FieldError::linf))
        .column("Voronoi", order(voronoi))
        .column("mixed", order(mixed));
}

report::Table indicator_table(const std::vector<IndicatorTrial>& trials) {
    return table("q3_indicator", words.line("indicator"), trials)
        .column("mesh", &IndicatorTrial::mesh)
        .column("vertices", &IndicatorTrial::vertices)
        .column("indicated", {.unit = "%"}, [](auto& t) { return 100 * t.indicated; })
        .column("actual", {.unit = "%"}, [](auto& t) { return 100 * t.actual; })
        .column("ratio", [](auto& t) { return cell_of(t.indicated / t.actual, t.actual > 0); })
        .column("worst tenth found", {.unit = "%"}, [](auto& t) { return 100 * t.found; });
}

report::Plot convergence_plot(const Refinements& refinements, Triangulation triangulation) {
    const std::string name = name_of(triangulation);
    report::Plot plot{.id = "q3_convergence_" + name,
                      .caption = words.line("convergence", "triangulation"_a = name),
                      .alt = words.line("convergence.alt", "triangulation"_a = name),
                      .x_label = "mean edge [length]",
                      .y_label = "relative L2 error [%]",
                      .log_x = true,
                      .log_y = true};
    int surface = 0;
    for (const CotangentRefinement& r : refinements) {
        if (r.triangulation != triangulation) continue;
        const auto add = [&](const std::string& estimator, const ErrorHistory& history, report::Series::Style style, std::size_t pattern) {
            plot.series.push_back(error_series(r.surface.name + ", " + estimator, history, style));
            plot.series.back().color = surface;
            plot.series.back().pattern = static_cast<int>(pattern);
            plot.alt += " " + words.line("convergence.alt.series", "series"_a = plot.series.back().name, "trend"_a = trend(history));
        };
        for (std::size_t form = 0; form < area_forms.size(); ++form)
            add(area_name(area_forms[form]), cotangent_H(r, form), report::Series::Style::line_and_points, form);
        add("uniform", scaled_uniform_H(r), report::Series::Style::dashed, area_forms.size());
        ++surface;
    }
    return plot;
}

}   // namespace meshfolio::q3_cotangent
