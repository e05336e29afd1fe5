#include "geometry/linear/special_values.h"
#include "questions/core/table.h"
#include "questions/q1_uniform/parts.h"

namespace meshfolio::q1_uniform {

namespace {

/// A row of the table of statistics.
struct Spread {
    std::string mesh, quantity, unit;
    ValueSummary values;
};

}   // namespace

report::Table statistics_table(const Meshes& meshes) {
    std::vector<Spread> rows;
    for (const MeshCurvature& c : meshes) {
        rows.push_back({c.subject.name(), "½‖Δx‖", "length", summary_of(c.length)});
        rows.push_back({c.subject.name(), "H scaled", "1/length", summary_of(c.H)});
        rows.push_back({c.subject.name(), "K", "1/length²", summary_of(c.K)});
    }
    return table("q1_statistics", words.line("statistics"), rows)
        .column("mesh", &Spread::mesh)
        .column("quantity", &Spread::quantity)
        .column("unit", &Spread::unit)
        .column("minimum", {.digits = 4}, [](auto& row) { return cell_of(row.values.minimum); })
        .column("median", {.digits = 4}, [](auto& row) { return cell_of(row.values.median); })
        .column("mean", {.digits = 4}, [](auto& row) { return cell_of(row.values.mean); })
        .column("maximum", {.digits = 4}, [](auto& row) { return cell_of(row.values.maximum); })
        .column("standard deviation", [](auto& row) { return cell_of(row.values.standard_deviation); })
        .column("defined", [](auto& row) { return row.values.count; })
        .column("undefined", [](auto& row) { return row.values.undefined; });
}

report::Table error_table(const Refinements& refinements) {
    return table("q1_errors", words.line("errors"), refinements)
        .column("surface", [](auto& r) { return r.surface.name; })
        .column("triangulation", [](auto& r) { return name_of(r.triangulation); })
        .column("vertices", [](auto& r) { return r.finest().vertices; })
        .column("smallest angle", {.unit = "°"}, [](auto& r) { return r.finest().smallest_angle * 180 / pi; })
        .column("H, L2", {.unit = "%"}, [](auto& r) { return 100 * r.finest().H.l2; })
        .column("H, L∞", {.unit = "%"}, [](auto& r) { return 100 * r.finest().H.linf; })
        .column("H, order of L2", {.digits = 2}, [](auto& r) { return uniform_H(r).order(); })
        .column("H normal part, L2", {.unit = "%", .digits = 2}, [](auto& r) { return 100 * r.finest().normal_part.l2; })
        .column("K, L2", {.unit = "%"}, [](auto& r) { return 100 * r.finest().K[barycentric].l2; })
        .column("K, L∞", {.unit = "%"}, [](auto& r) { return 100 * r.finest().K[barycentric].linf; })
        .column("K, order of L2", {.digits = 2}, [](auto& r) { return deficit_K(r).order(); });
}

report::Table area_table(const Refinements& refinements, double FieldError::*norm, const std::string& key, const std::string& name) {
    auto errors = table("q1_area_forms_" + key, words.line("area_forms", "norm"_a = name), std::array{barycentric, voronoi, mixed});
    errors.column("area form", [](std::size_t form) { return area_name(area_forms[form]); });
    for (const UniformRefinement& r : refinements)
        errors.column(r.title(), {.unit = "%", .best = smallest}, [&](std::size_t form) { return 100 * r.finest().K[form].*norm; });
    return errors.column("without K", {.unit = "vertices", .best = smallest}, [&](std::size_t form) {
        int without = 0;
        for (const UniformRefinement& r : refinements) without += r.finest().undefined[form];
        return without;
    });
}

report::Table gauss_bonnet_table(const AngleSums& sums) {
    return table("q1_gauss_bonnet", words.line("gauss_bonnet"), sums)
        .column("mesh", &AngleSum::mesh)
        .column("vertices", &AngleSum::vertices)
        .column("χ", &AngleSum::euler)
        .column("Σ deficit / 2π", {.digits = 6}, &AngleSum::measured)
        .column("difference", {.digits = 2}, [](auto& s) { return s.measured - s.euler; })
        .column("applies", [](auto& s) { return s.applies ? "yes" : words.line("gauss_bonnet.does_not_apply"); });
}

report::Plot convergence_plot(const Refinements& refinements, bool gaussian) {
    const std::string quantity = gaussian ? "K (barycentric areas)" : "uniform H (scaled)";
    report::Plot plot{.id = gaussian ? "q1_k_convergence" : "q1_h_convergence",
                      .caption = words.line("convergence", "quantity"_a = quantity),
                      .alt = words.line("convergence.alt", "quantity"_a = quantity),
                      .x_label = "mean edge [length]",
                      .y_label = "relative L2 error [%]",
                      .log_x = true,
                      .log_y = true};
    for (const UniformRefinement& r : refinements) {
        using enum report::Series::Style;
        plot.series.push_back(
            error_series(r.title(), errors_of(r, gaussian), r.triangulation == Triangulation::regular ? line_and_points : dashed));
        plot.alt += " " + words.line("convergence.alt.series", "series"_a = r.title(), "trend"_a = trend(errors_of(r, gaussian)));
    }
    return plot;
}

}   // namespace meshfolio::q1_uniform
