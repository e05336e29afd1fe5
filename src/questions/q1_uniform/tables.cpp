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
        rows.push_back({c.name(), "½‖Δx‖", "length", summary_of(c.length)});
        rows.push_back({c.name(), "H scaled", "1/length", summary_of(c.H)});
        rows.push_back({c.name(), "K", "1/length²", summary_of(c.K)});
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

report::Table error_table(const BenchRuns& runs) {
    const auto error = [](std::string_view estimator, Norm norm = &EstimateError::l2) {
        return [=](const BenchRun& run) { return 100 * run.finest().error(estimator).*norm; };
    };
    const auto order = [](std::string_view estimator) {
        return [=](const BenchRun& run) { return cell_of(run.errors(estimator).order().exponent); };
    };
    int vertices = 0;
    for (const BenchRun& run : runs) vertices = std::max(vertices, run.finest().vertices);
    return table("q1_errors", words.line("errors", "vertices"_a = vertices), runs)
        .column("surface", &BenchRun::surface)
        .column("triangulation", [](auto& run) { return name_of(run.kind); })
        .column("uniform H", {.unit = "%"}, error(uniform_H))
        .column("order of H", {.rounding = Rounding::tenths}, order(uniform_H))
        .column("normal part", {.unit = "%", .digits = 2}, error(normal_H))
        .column("K barycentric", {.unit = "%", .digits = 2}, error(deficit_K))
        .column("order of K", {.rounding = Rounding::tenths}, order(deficit_K))
        .column("worst vertex", {.unit = "%", .digits = 2}, error(deficit_K, &EstimateError::linf))
        .column("K Voronoi", {.unit = "%", .digits = 2}, error("K.voronoi"))
        .column("K mixed", {.unit = "%", .digits = 2}, error("K.mixed"));
}

report::Table area_table(const BenchRuns& runs) {
    auto errors = table("q1_area_forms", words.line("area_forms"), area_forms);
    errors.column("area form", area_name);
    for (const BenchRun& run : runs)
        errors.column(run.title(), {.unit = "%", .best = Best::smallest},
                      [&](AreaForm form) { return 100 * run.finest().error(K_with(form)).linf; });
    const bool all_defined = std::ranges::all_of(area_forms, [&](AreaForm form) { return without_K(runs, form) == 0; });
    if (!all_defined)
        errors.column("without K", {.unit = "vertices", .best = Best::smallest}, [&](AreaForm form) { return without_K(runs, form); });
    return errors;
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

report::Plot convergence_plot(const BenchRuns& runs) {
    return meshfolio::convergence_plot("q1_convergence", words, runs, {{uniform_H, "convergence.h"}, {deficit_K, "convergence.k"}});
}

}   // namespace meshfolio::q1_uniform
