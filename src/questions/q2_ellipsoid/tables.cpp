#include "questions/q2_ellipsoid/parts.h"

namespace meshfolio::q2_ellipsoid {

namespace {

/// Adds the columns a, b and c to a table; its rows have a field `ellipsoid`.
template <class Builder> void add_axes(Builder& table) {
    table.column("a", {.unit = "length"}, [](auto& row) { return row.ellipsoid.a; })
        .column("b", {.unit = "length"}, [](auto& row) { return row.ellipsoid.b; })
        .column("c", {.unit = "length"}, [](auto& row) { return row.ellipsoid.c; });
}

/// Samples a curvature over a full turn of the direction.
report::Series curve_of(const Ellipsoid& ellipsoid, double (*curvature)(const Ellipsoid&, double), std::string name,
                        report::Series::Style style) {
    report::Series series{.name = std::move(name), .style = style};
    for (int i = 0; i <= 240; ++i) add_point(series, i / 120.0, curvature(ellipsoid, i * pi / 120));
    return series;
}

/// Marks the extrema of a sampled closed curve. The first maximum and the first minimum have a label.
std::vector<report::Marker> extrema_of(const report::Series& curve) {
    std::vector<report::Marker> extrema;
    const std::size_t n = curve.y.size() - 1;   // the last point repeats the first
    bool has_maximum = false, has_minimum = false;
    for (std::size_t i = 0; i <= n; ++i) {
        const double before = curve.y[(i + n - 1) % n], here = curve.y[i], after = curve.y[(i + 1) % n];
        const bool maximum = here > before && here > after, minimum = here < before && here < after;
        if (!maximum && !minimum) continue;
        bool& has_label = maximum ? has_maximum : has_minimum;
        const char* key = maximum ? "tip_curves.maximum" : "tip_curves.minimum";
        extrema.push_back({curve.x[i], here, std::exchange(has_label, true) ? "" : words.line(key, "value"_a = readable(here, 4))});
    }
    return extrema;
}

}   // namespace

report::Table forms_table(const Ellipsoid& ellipsoid) {
    struct Place {
        double u, v;   // over π
        Vector3 p = {};
        FundamentalForms forms = {};
        PrincipalCurvatures principal = {};
    };
    std::vector<Place> places{{0, 0.5}, {0.5, 0.5}, {1, 0.5}, {0.25, 0.5}, {0, 0.25}, {0.25, 0.25}, {0.7, 0.8}};
    for (Place& place : places) {
        place.p = ellipsoid_point(ellipsoid, pi * place.u, pi * place.v);
        place.forms = ellipsoid_forms(ellipsoid, pi * place.u, pi * place.v);
        place.principal = principal_curvatures(place.forms);
    }
    using Form = Eigen::Matrix2d FundamentalForms::*;
    const auto entry = [](Form form, int i, int j) { return [=](const Place& place) { return (place.forms.*form)(i, j); }; };
    const auto rounded = [](auto number_of) { return [=](const Place& place) { return without_rounding(number_of(place)); }; };
    const auto coordinate = [=](int i) { return rounded([=](const Place& place) { return place.p[i]; }); };
    return table("q2_forms", words.line("forms", "axes"_a = axes_text(ellipsoid)), places)
        .column("u/π", &Place::u)
        .column("v/π", &Place::v)
        .column("x", {.unit = "length"}, coordinate(0))
        .column("y", {.unit = "length"}, coordinate(1))
        .column("z", {.unit = "length"}, coordinate(2))
        .column("E", {.unit = "length²", .digits = 4}, entry(&FundamentalForms::I, 0, 0))
        .column("F", {.unit = "length²", .digits = 4}, rounded(entry(&FundamentalForms::I, 0, 1)))
        .column("G", {.unit = "length²", .digits = 4}, rounded(entry(&FundamentalForms::I, 1, 1)))
        .column("e", {.unit = "length", .digits = 4}, entry(&FundamentalForms::II, 0, 0))
        .column("f", {.unit = "length", .digits = 4}, entry(&FundamentalForms::II, 0, 1))
        .column("g", {.unit = "length", .digits = 4}, entry(&FundamentalForms::II, 1, 1))
        .column("least κ_n", {.unit = "1/length", .digits = 4}, [](auto& place) { return place.principal.minimum; })
        .column("largest κ_n", {.unit = "1/length", .digits = 4}, [](auto& place) { return place.principal.maximum; })
        .column("H", {.unit = "1/length", .digits = 4}, [](auto& place) { return mean_curvature(place.forms); })
        .column("K", {.unit = "1/length²", .digits = 4}, [](auto& place) { return gaussian_curvature(place.forms); });
}

report::Table tip_table(const std::vector<Tip>& tips) {
    auto at_tip = table("q2_tip", words.line("tip"), tips);
    add_axes(at_tip);
    return at_tip.column("least κ_n", {.unit = "1/length", .digits = 4}, [](auto& tip) { return tip.principal.minimum; })
        .column("along", [](auto& tip) { return direction_text(tip.principal.minimum_direction); })
        .column("largest κ_n", {.unit = "1/length", .digits = 4}, [](auto& tip) { return tip.principal.maximum; })
        .column("along", [](auto& tip) { return direction_text(tip.principal.maximum_direction); })
        .column("H", {.unit = "1/length", .digits = 4}, &Tip::H)
        .column("K", {.unit = "1/length²", .digits = 4}, &Tip::K);
}

report::Plot tip_plot(const Tip& tip, const std::string& id) {
    const Ellipsoid& e = tip.ellipsoid;
    using enum report::Series::Style;
    const auto by_angle = curve_of(e, tip_curvature_by_angle, words.line("tip_curves.angle"), line);
    const auto by_parameters = curve_of(e, tip_curvature_by_parameters, words.line("tip_curves.parameters"), dashed);
    const auto extrema = extrema_of(by_angle);
    const ReadingGap largest = largest_gap(e);
    return {.id = id,
            .caption = words.line("tip_curves", "axes"_a = axes_text(e)),
            .alt = words.line("tip_curves.alt", "least"_a = readable(tip.principal.minimum), "largest"_a = readable(tip.principal.maximum),
                              "gap"_a = readable(largest.gap), "degrees"_a = largest.degrees, "angle"_a = readable(tip.at_45_angle),
                              "parameters"_a = readable(tip.at_45_parameters)),
            .x_label = "direction θ [π rad]",
            .y_label = "normal curvature κ_n [1/length]",
            .series = {by_angle, by_parameters},
            .markers = extrema};
}

report::Table discrete_table(const Tip& exact, const DiscreteTips& tips) {
    struct Mesh {
        std::string name;
        std::vector<DiscreteTip> levels;
    };
    const std::vector<Mesh> meshes{{words.line("discrete.grid"), tips.grid}, {words.line("discrete.icosphere"), tips.icosphere}};
    const std::string caption =
        words.line("discrete", "axes"_a = axes_text(exact.ellipsoid), "H"_a = readable(exact.H, 5), "K"_a = readable(exact.K, 5));
    return table("q2_discrete", caption, parts_within(meshes, &Mesh::levels))
        .column("mesh", [](auto& row) { return row.whole.name; })
        .column("vertices", [](auto& row) { return row.part.vertices; })
        .column("mean edge", {.unit = "length"}, [](auto& row) { return row.part.mean_edge; })
        .column("vertex to tip", {.unit = "length", .digits = 2}, [](auto& row) { return row.part.distance; })
        .column("H", {.unit = "1/length", .digits = 5}, [](auto& row) { return row.part.H; })
        .column("error of H", {.unit = "%", .best = Best::smallest}, [](auto& row) { return 100 * row.part.H_error; })
        .column("K", {.unit = "1/length²", .digits = 5}, [](auto& row) { return row.part.K; })
        .column("error of K", {.unit = "%", .best = Best::smallest}, [](auto& row) { return 100 * row.part.K_error; });
}

}   // namespace meshfolio::q2_ellipsoid
