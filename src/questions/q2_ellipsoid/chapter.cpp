// Question 2: first and second fundamental form of the ellipsoid, and the normal curvature at (a, 0, 0).
#include <algorithm>
#include <array>
#include <cmath>

#include "base/number_text.h"
#include "geometry/curvature/analytic_surfaces.h"
#include "mesh/samples/sample_shapes.h"
#include "questions/bench/ellipsoid_study.h"
#include "questions/core/chapter.h"
#include "questions/core/section_tools.h"
#include "questions/core/six_view_figure.h"

namespace meshfolio::q2_ellipsoid {

namespace {

using report::check_at_most;
using report::check_near;
using report::math;
using report::ref;

// ---- the forms against two oracles -----------------------------------------------------------------------------------

void add_oracle_table(report::Section& section, const std::vector<OracleErrors>& all) {
    report::Table table;
    table.id = "q2_oracles";
    table.caption =
        "Largest deviation of the closed forms at " + std::to_string(all.front().points) +
        " random (u, v) of each ellipsoid: I and II from central differences of p(u, v) (over the largest entry), K and H from the "
        "implicit equation.";
    table.columns = {{"a", "length"}, {"b", "length"}, {"c", "length"}, {"I", "", 2}, {"II", "", 2}, {"K", "", 2}, {"H", "", 2}};
    for (const OracleErrors& e : all) {
        table.rows.push_back({e.ellipsoid.a, e.ellipsoid.b, e.ellipsoid.c, e.I, e.II, e.K, e.H});
        const std::string on = ", " + axes_text(e.ellipsoid);
        section.checks.push_back(check_at_most("I against central differences" + on, 0, e.I, 1e-8));
        section.checks.push_back(check_at_most("II against central differences" + on, 0, e.II, 1e-8));
        section.checks.push_back(check_at_most("K against h⁴/(abc)²" + on, 0, e.K, 1e-11));
        section.checks.push_back(check_at_most("H against the implicit form" + on, 0, e.H, 1e-11));
    }
    section.blocks.push_back(std::move(table));
}

// ---- the forms at a few points ----------------------------------------------------------------------------------------

void add_forms_table(report::Section& section, const Ellipsoid& ellipsoid) {
    report::Table table;
    table.id = "q2_forms";
    table.caption = "First and second fundamental form of the ellipsoid " + axes_text(ellipsoid) +
                    ", and the curvatures that follow, normal inwards. F = 0 on the symmetry planes only; f = 0 everywhere.";
    table.columns = {{"u/π", "", 3},      {"v/π", "", 3},        {"x", "length", 3},    {"y", "length", 3},   {"z", "length", 3},
                     {"E", "length²", 4}, {"F", "length²", 4},   {"G", "length²", 4},   {"e", "length", 4},   {"f", "length", 4},
                     {"g", "length", 4},  {"κ₁", "1/length", 4}, {"κ₂", "1/length", 4}, {"H", "1/length", 4}, {"K", "1/length²", 4}};
    constexpr std::array<std::array<double, 2>, 7> over_pi{
        {{0, 0.5}, {0.5, 0.5}, {1, 0.5}, {0.25, 0.5}, {0, 0.25}, {0.25, 0.25}, {0.7, 0.8}}};
    for (const auto& [u, v] : over_pi) {
        const FundamentalForms forms = ellipsoid_forms(ellipsoid, M_PI * u, M_PI * v);
        const PrincipalCurvatures principal = principal_curvatures(forms);
        const Vector3 p = ellipsoid_point(ellipsoid, M_PI * u, M_PI * v);
        const auto rounded = [](double x) { return std::abs(x) < 1e-15 ? 0.0 : x; };   // cos(π/2) = 6e-17
        table.rows.push_back({u, v, rounded(p.x()), rounded(p.y()), rounded(p.z()), forms.I(0, 0), rounded(forms.I(0, 1)),
                              rounded(forms.I(1, 1)), forms.II(0, 0), forms.II(0, 1), forms.II(1, 1), principal.minimum, principal.maximum,
                              mean_curvature(forms), gaussian_curvature(forms)});
    }
    section.blocks.push_back(std::move(table));
}

// ---- the tip (a, 0, 0) ------------------------------------------------------------------------------------------------

std::string direction_text(const Vector3& t) { return std::abs(t.y()) > std::abs(t.z()) ? "±y" : "±z"; }

void add_tip_table(report::Section& section, const std::vector<Tip>& tips) {
    report::Table table;
    table.id = "q2_tip";
    table.caption =
        "At (a, 0, 0), that is (u, v) = (0, π/2): I = diag(b², c²), II = diag(a, a), hence principal curvatures a/b² along ±y and a/c² "
        "along ±z.";
    table.columns = {{"a", "length"},    {"b", "length"},      {"c", "length"},       {"E", "length²", 4}, {"G", "length²", 4},
                     {"e", "length", 4}, {"g", "length", 4},   {"κ₁", "1/length", 4}, {"along", ""},       {"κ₂", "1/length", 4},
                     {"along", ""},      {"H", "1/length", 4}, {"K", "1/length²", 4}};
    for (const Tip& tip : tips) {
        const PrincipalCurvatures& k = tip.principal;
        table.rows.push_back({tip.ellipsoid.a, tip.ellipsoid.b, tip.ellipsoid.c, tip.forms.I(0, 0), tip.forms.I(1, 1), tip.forms.II(0, 0),
                              tip.forms.II(1, 1), k.minimum, direction_text(k.minimum_direction), k.maximum,
                              direction_text(k.maximum_direction), tip.H, tip.K});
    }
    section.blocks.push_back(std::move(table));
}

void check_tip(report::Section& section, const Tip& tip) {
    const auto [a, b, c] = tip.ellipsoid;
    const std::string on = " at (a, 0, 0), " + axes_text(tip.ellipsoid);
    section.checks.push_back(
        check_near("smaller principal curvature" + on, std::min(a / (b * b), a / (c * c)), tip.principal.minimum, 1e-12));
    section.checks.push_back(
        check_near("larger principal curvature" + on, std::max(a / (b * b), a / (c * c)), tip.principal.maximum, 1e-12));
    section.checks.push_back(check_near("K = a²/(b²c²)" + on, a * a / (b * b * c * c), tip.K, 1e-11));
    section.checks.push_back(check_at_most("II(t, t)/I(t, t) against Euler's formula" + on, 0, tip.worst_euler, 1e-12));
    section.checks.push_back(check_at_most("II/I in (du, dv) against a/(b²cos²θ + c²sin²θ)" + on, 0, tip.worst_parameters, 1e-12));
}

report::Series curve_of(const Ellipsoid& ellipsoid, double (*curvature)(const Ellipsoid&, double), std::string name,
                        report::Series::Style style) {
    report::Series series{std::move(name), {}, {}, {}, {}, style};
    for (int i = 0; i <= 240; ++i) {
        series.x.push_back(i / 120.0);
        series.y.push_back(curvature(ellipsoid, i * M_PI / 120));
    }
    return series;
}

/// The places of the extrema are those of the sampled curve, not of the formula.
void mark_extrema(report::Plot& plot, const report::Series& curve) {
    const std::size_t n = curve.y.size() - 1;   // the last point repeats the first
    for (std::size_t i = 0; i <= n; ++i) {
        const double before = curve.y[(i + n - 1) % n], here = curve.y[i], after = curve.y[(i + 1) % n];
        const bool maximum = here > before && here > after, minimum = here < before && here < after;
        if (!maximum && !minimum) continue;
        const std::string at = curve.x[i] == 0 ? "0" : readable(curve.x[i], 2) + "π";
        plot.markers.push_back({curve.x[i], here, std::string(maximum ? "maximum " : "minimum ") + readable(here, 4) + " at " + at});
    }
}

/// Where the two readings of θ are farthest apart, to a degree between 0 and 90.
struct ReadingGap {
    double gap = 0;   // [1/length]
    int degrees = 0;
};

double difference_of_readings(const Ellipsoid& e, double theta) {
    return std::abs(tip_curvature_by_angle(e, theta) - tip_curvature_by_parameters(e, theta));
}

ReadingGap largest_gap(const Ellipsoid& e) {
    ReadingGap largest;
    for (int degrees = 0; degrees <= 90; ++degrees) {
        const double gap = difference_of_readings(e, degrees * M_PI / 180);
        if (gap > largest.gap) largest = {gap, degrees};
    }
    return largest;
}

void add_tip_plot(report::Section& section, const Tip& tip, const std::string& id) {
    const Ellipsoid& e = tip.ellipsoid;
    report::Plot plot;
    plot.id = id;
    plot.x_label = "direction θ [π rad]";
    plot.y_label = "normal curvature κ_n [1/length]";
    plot.series = {curve_of(e, tip_curvature_by_angle, "unit tangent at angle θ from +y (Euler)", report::Series::Style::line),
                   curve_of(e, tip_curvature_by_parameters, "(du, dv) = (cos θ, sin θ)", report::Series::Style::dashed)};
    mark_extrema(plot, plot.series.front());
    std::string extrema;
    for (const report::Marker& marker : plot.markers) extrema += (extrema.empty() ? "" : "; ") + marker.label;
    plot.caption = "Normal curvature at (a, 0, 0) for " + axes_text(e) +
                   ", over the direction in two readings of θ. Extrema of both: " + extrema + ".";
    const ReadingGap largest = largest_gap(e);
    plot.alt = "Two curves of period π between " + readable(tip.principal.minimum) + " and " + readable(tip.principal.maximum) +
               " that touch at their extrema and differ most, by " + readable(largest.gap) + ", at " + std::to_string(largest.degrees) +
               "°; at 45° they read " + readable(tip.at_45_angle) + " and " + readable(tip.at_45_parameters) + ".";
    section.blocks.push_back(std::move(plot));
}

// ---- the pole ---------------------------------------------------------------------------------------------------------

void add_pole_table(report::Section& section, const Ellipsoid& e, const std::vector<PoleStep>& steps) {
    report::Table table;
    table.id = "q2_pole";
    table.caption =
        "Towards the south pole (0, 0, −c) of the ellipsoid " + axes_text(e) + " along u = 0: I loses its rank, the curvature stays.";
    table.columns = {{"π − v", "rad", 3}, {"EG − F²", "length⁴", 4}, {"K", "1/length²", 8}};
    for (const PoleStep& step : steps) table.rows.push_back({step.distance, step.area_element_squared, step.K});
    section.blocks.push_back(std::move(table));
    const double limit = e.c * e.c / (e.a * e.a * e.b * e.b);
    section.checks.push_back(check_near("K towards the south pole tends to c²/(a²b²)", limit, steps.back().K, 1e-6 * limit));
}

report::Text pole_words(const Ellipsoid& e, const std::vector<PoleStep>& steps) {
    const double limit = e.c * e.c / (e.a * e.a * e.b * e.b);
    const double power =
        std::log(steps[1].area_element_squared / steps.back().area_element_squared) / std::log(steps[1].distance / steps.back().distance);
    return report::text("The poles are singular points of the coordinates, not of the surface: from ",
                        math("π − v = " + readable(steps[1].distance)), " to ", readable(steps.back().distance), " ", math("EG − F²"),
                        " falls from ", readable(steps[1].area_element_squared), " to ", readable(steps.back().area_element_squared),
                        " (with the power ", readable(power, 3), " of the distance, for ", math("p_u → 0"), "), while K tends to ",
                        readable(steps.back().K, 6), ", ", readable(std::abs(steps.back().K / limit - 1), 2), " relative from ",
                        math("c²/(a²b²)"), ". At v = π itself I has no inverse and κ_n no direction to be taken in.");
}

/// What an earlier report had at the tip: (u, v) = (0, π), E = a² and e = abc.
report::Text mistake_words(const Tip& tip) {
    const Ellipsoid& e = tip.ellipsoid;
    const Vector3 there = ellipsoid_point(e, 0, M_PI), tip_point(e.a, 0, 0);
    const FundamentalForms differences = ellipsoid_forms_by_differences(e, 0, M_PI / 2);
    const double wrong = e.a * e.b * e.c / (e.a * e.a), right = normal_curvature(tip.forms, {1, 0});
    report::Text t = report::text("An earlier report put (a, 0, 0) at (u, v) = (0, π). That is the point (",
                                  readable(std::abs(there.x()) < 1e-15 ? 0 : there.x()), ", ", readable(there.y()), ", ",
                                  readable(there.z()), "), the south pole, ", readable((there - tip_point).norm()), " away. ");
    report::extend(t, "Another gave ", math("E = a²"), " = ", readable(e.a * e.a), " and ", math("e = abc"), " = ",
                   readable(e.a * e.b * e.c), ": central differences at (0, π/2) give E = ", readable(differences.I(0, 0), 4),
                   " = b² and e = ", readable(differences.II(0, 0), 4), " = a. With the wrong pair κ_n along ±y would be ", math("e/E"),
                   " = ", readable(wrong), " instead of ", readable(right, 4), ", ", readable_percent(std::abs(wrong / right - 1)),
                   " off.");
    return t;
}

// ---- the same on a mesh -----------------------------------------------------------------------------------------------

void add_discrete_table(report::Section& section, const Tip& exact, const DiscreteTips& tips) {
    report::Table table;
    table.id = "q2_discrete";
    table.caption = "Cotangent H and angle-deficit K (Voronoi areas) at the vertex nearest (a, 0, 0) of meshes of the ellipsoid " +
                    axes_text(exact.ellipsoid) + ". Closed form: H = " + readable(exact.H, 5) + ", K = " + readable(exact.K, 5) + ".";
    table.columns = {{"mesh", ""},
                     {"vertices", ""},
                     {"mean edge", "length", 3},
                     {"vertex to tip", "length", 2},
                     {"H", "1/length", 5},
                     {"error of H", "%", 3, report::Column::Best::smallest},
                     {"K", "1/length²", 5},
                     {"error of K", "%", 3, report::Column::Best::smallest}};
    const auto add_rows = [&](const char* mesh, const std::vector<DiscreteTip>& rows) {
        for (const DiscreteTip& t : rows) {
            table.rows.push_back({mesh, double(t.vertices), t.mean_edge, t.distance, t.H, 100 * t.H_error, t.K, 100 * t.K_error});
        }
    };
    add_rows("(u, v) grid around the tip", tips.grid);
    add_rows("stretched icosphere", tips.icosphere);
    section.blocks.push_back(std::move(table));
    section.checks.push_back(
        check_near("order of cotangent H at the tip, (u, v) grid", 2, order_of(tips.grid, &DiscreteTip::H_error), 0.2));
    section.checks.push_back(
        check_near("order of angle-deficit K at the tip, (u, v) grid", 2, order_of(tips.grid, &DiscreteTip::K_error), 0.2));
}

void add_ellipsoid_figure(Answer& answer, const Ellipsoid& ellipsoid, bool quick, const std::string& colormap) {
    TriangleMesh mesh = ellipsoid_mesh(quick ? 4 : 5, axes_of(ellipsoid));
    Vector H(mesh.vertex_count());
    for (int i = 0; i < mesh.vertex_count(); ++i) H[i] = ellipsoid_curvature(axes_of(ellipsoid), mesh.X.row(i)).H;
    const double tip = ellipsoid_curvature(axes_of(ellipsoid), {ellipsoid.a, 0, 0}).H,
                 pole = ellipsoid_curvature(axes_of(ellipsoid), {0, 0, ellipsoid.c}).H;
    SixViewFigure figure;
    figure.id = "q2_ellipsoid_h";
    figure.title = "Mean curvature of the ellipsoid, closed form";
    figure.subtitle = axes_text(ellipsoid);
    figure.caption = "Mean curvature of the ellipsoid " + axes_text(ellipsoid) + " from its fundamental forms: " + readable(tip) +
                     " at (a, 0, 0), which the ±x views face, " + readable(pole) + " at the poles (±z views).";
    figure.panels = {panel_of(std::move(mesh), "q2_ellipsoid_h", "H", H)};
    figure.range = output::robust_range(figure.panels, colormap, "mean curvature H", "1/length", 0.01, 0);
    add_figure(answer, std::move(figure));
}

// ---- discussion -------------------------------------------------------------------------------------------------------

report::Text tip_words(const Tip& tip) {
    const auto& [a, b, c] = tip.ellipsoid;
    const PrincipalCurvatures& k = tip.principal;
    report::Text t = report::text("For ", axes_text(tip.ellipsoid), " the normal curvature at (a, 0, 0) lies between ", math("κ₁"), " = ",
                                  readable(k.minimum, 4), " (along ", direction_text(k.minimum_direction), ") and ", math("κ₂"), " = ",
                                  readable(k.maximum, 4), " (along ", direction_text(k.maximum_direction), "). ");
    report::extend(t, "Here ", math(b < c ? "b < c" : "b > c"), ", so the maxima are at θ = ",
                   tip.largest_along_y() ? "0, π and 2π and the minima at π/2 and 3π/2" : "π/2 and 3π/2 and the minima at 0, π and 2π",
                   tip.largest_along_y() ? ", as an earlier report has it." : ", the reverse of what holds for b < c.");
    return t;
}

report::Text readings_words(const Tip& tip) {
    const double at_axes = std::max(difference_of_readings(tip.ellipsoid, 0), difference_of_readings(tip.ellipsoid, M_PI / 2));
    const auto [gap, at] = largest_gap(tip.ellipsoid);
    return report::text("“Direction θ” has two readings. As the angle of the unit tangent from +y it gives Euler's formula; as ",
                        math("(du, dv) = (cos θ, sin θ)"), " it names the tangent ", math("cos θ p_u + sin θ p_v"),
                        ", which is neither of unit length nor at angle θ because ", math("|p_u| = b"), " = ", readable(tip.ellipsoid.b),
                        " and ", math("|p_v| = c"), " = ", readable(tip.ellipsoid.c), ". At θ = 0 and π/2 the two agree ",
                        at_axes == 0 ? "exactly" : "to " + readable(at_axes, 2), "; in between they differ, by up to ", readable(gap),
                        " at ", std::to_string(at), "°; at 45° they are ", readable(tip.at_45_angle), " and ",
                        readable(tip.at_45_parameters), ".");
}

report::Text sign_words(const Tip& tip) {
    const Vector3& n = tip.forms.normal;
    const double toward_centre = -n.x();   // the tip is at +x
    return report::text("The sign is a convention. ", math("n = p_u × p_v/|p_u × p_v|"), " points ",
                        toward_centre > 0 ? "inwards" : "outwards", " here (its x-component is ", readable(n.x()),
                        " at the tip), which makes κ_n positive; with the outward normal the same values read ",
                        readable(-tip.principal.maximum, 4), " to ", readable(-tip.principal.minimum, 4), ". K = ", readable(tip.K, 4),
                        " is the same with either normal.");
}

report::Text oracle_words(const std::vector<OracleErrors>& all) {
    double I = 0, II = 0, K = 0;
    int points = 0;
    for (const OracleErrors& e : all) {
        I = std::max(I, e.I);
        II = std::max(II, e.II);
        K = std::max(K, std::max(e.K, e.H));
        points += e.points;
    }
    return report::text("At ", std::to_string(points), " random points of ", std::to_string(all.size()),
                        " ellipsoids the closed forms deviate from central differences by at most ", readable(I, 2), " (I) and ",
                        readable(II, 2), " (II), and K and H from the implicit equation, which knows nothing of (u, v), by ",
                        readable(K, 2), " (", ref("q2_oracles"), ").");
}

/// Which of H and K the last refinement of the stretched icosphere did not bring closer.
std::string stretched_words(const DiscreteTips& tips) {
    const double H = order_of(tips.icosphere, &DiscreteTip::H_error), K = order_of(tips.icosphere, &DiscreteTip::K_error);
    const std::string why = ": the one-ring of that vertex is not symmetric";
    if (H <= 0 && K <= 0)
        return ", and neither gets closer with the last refinement (orders " + readable(H, 2) + " and " + readable(K, 2) + ")" + why;
    if (H > 0 && K > 0) return "";
    return std::string(H <= 0 ? ", and H" : ", and K") + " does not get closer with the last refinement (order " +
           readable(std::min(H, K), 2) + ")" + why;
}

report::Text discrete_words(const DiscreteTips& tips) {
    const DiscreteTip& grid = tips.grid.back();
    const DiscreteTip& icosphere = tips.icosphere.back();
    const double H_order = order_of(tips.grid, &DiscreteTip::H_error), K_order = order_of(tips.grid, &DiscreteTip::K_error);
    report::Text t = report::text("The discrete operators of the other questions meet these numbers: on a (u, v) grid of ",
                                  std::to_string(grid.vertices), " vertices around the tip cotangent H = ", readable(grid.H, 5),
                                  " and angle-deficit K = ", readable(grid.K, 5), ", ", readable_percent(grid.H_error, 2), " and ",
                                  readable_percent(grid.K_error, 2), " off, with orders ", readable(H_order, 3), " and ",
                                  readable(K_order, 3), " in the mean edge. ");
    report::extend(t, "On a stretched icosphere of ", std::to_string(icosphere.vertices), " vertices the errors at the same point are ",
                   readable_percent(icosphere.H_error, 2), " and ", readable_percent(icosphere.K_error, 2));
    report::extend(t, stretched_words(tips), " (", ref("q2_discrete"), ").");
    return t;
}

void add_method(report::Section& section) {
    add_heading(section, "Method");
    add_paragraph(section,
                  "The ellipsoid and its tangents are differentiated by hand; with the unit normal these give the two forms at any point "
                  "but the poles ",
                  ref("docarmo_1976"), ".");
    add_formula(section, "ellipsoid_parametrisation", "q2_eq_ellipsoid");
    add_formula(section, "first_form", "q2_eq_first");
    add_formula(section, "second_form", "q2_eq_second");
    add_formula(section, "ellipsoid_EFG", "q2_eq_first_ellipsoid");
    add_formula(section, "ellipsoid_efg", "q2_eq_second_ellipsoid");
    add_paragraph(section,
                  "A tangent direction t has the normal curvature II(t, t)/I(t, t); at (a, 0, 0), that is (u, v) = (0, π/2), it depends on "
                  "the direction by Euler's formula "
                  "when θ is the angle of the unit tangent, and differently when (du, dv) = (cos θ, sin θ):");
    add_formula(section, "normal_curvature", "q2_eq_normal_curvature");
    add_formula(section, "gaussian_and_mean_from_forms");
    add_formula(section, "euler_formula", "q2_eq_euler");
    add_formula(section, "tip_by_parameters", "q2_eq_parameters");
}

}   // namespace

Answer answer(const MeshLibrary&, const QuestionSettings& settings, const Progress& progress) {
    Answer answer;
    report::Section& section = answer.section;
    section = section_of("q2");
    add_method(section);

    add_heading(section, "Results");
    progress("fundamental forms of the ellipsoid");
    const std::vector<Tip> tips{tip_of(flat_ellipsoid), tip_of(tall_ellipsoid)};
    const Tip& tip = tips.front();
    add_forms_table(section, flat_ellipsoid);
    add_tip_table(section, tips);
    add_tip_plot(section, tips[0], "q2_tip_b_above_c");
    add_tip_plot(section, tips[1], "q2_tip_b_below_c");
    for (const Tip& each : tips) check_tip(section, each);
    const std::vector<OracleErrors> oracles = all_oracle_errors(settings);
    add_oracle_table(section, oracles);
    const std::vector<PoleStep> pole = towards_the_pole(flat_ellipsoid);
    add_pole_table(section, flat_ellipsoid, pole);
    progress("curvature of an ellipsoid mesh at its tip");
    const DiscreteTips discrete = discrete_tips(flat_ellipsoid, settings.quick);
    add_discrete_table(section, tip, discrete);
    add_ellipsoid_figure(answer, flat_ellipsoid, settings.quick, settings.colormap);

    add_heading(section, "Discussion");
    for (report::Text& words :
         std::vector<report::Text>{tip_words(tips[0]), tip_words(tips[1]), readings_words(tip), sign_words(tip), oracle_words(oracles),
                                   pole_words(flat_ellipsoid, pole), mistake_words(tip), discrete_words(discrete)}) {
        section.blocks.push_back(report::Paragraph{std::move(words)});
    }

    section.parameters = {{"ellipsoids", axes_text(flat_ellipsoid) + "; " + axes_text(tall_ellipsoid)},
                          {"random points", std::to_string(oracles.front().points) + " each, seed " + std::to_string(settings.seed)}};
    section.extent = "I and II in closed form at any (u, v), checked at " +
                     std::to_string(oracles.size() * static_cast<std::size_t>(oracles.front().points)) + " random points of " +
                     std::to_string(oracles.size()) + " ellipsoids; κ_n at (a, 0, 0) over all directions, in both readings of θ";
    section.findings = {
        {report::text("Q2: at (a, 0, 0) of the ellipsoid ", axes_text(tip.ellipsoid), " the normal curvature runs from ",
                      readable(tip.principal.minimum, 4), " to ", readable(tip.principal.maximum, 4), "; at θ = 45° it is ",
                      readable(tip.at_45_angle), " or ", readable(tip.at_45_parameters), ", depending on what θ means."),
         60},
        {report::text("Q2: a mesh of ", std::to_string(discrete.grid.back().vertices), " vertices meets the closed-form H at the tip to ",
                      readable_percent(discrete.grid.back().H_error, 2), "."),
         25}};
    return answer;
}

extern const Chapter chapter{
    .id = "q2",
    .code = {{"ellipsoid_forms", "src/geometry/curvature/fundamental_forms.cpp"},
             {"ellipsoid_forms_by_differences", "src/geometry/curvature/fundamental_forms.cpp"},
             {"normal_curvature", "src/geometry/curvature/fundamental_forms.cpp"},
             {"principal_curvatures", "src/geometry/curvature/fundamental_forms.cpp"},
             {"ellipsoid_curvature", "src/geometry/curvature/analytic_surfaces.cpp"},
             {"answer", "src/questions/q2_ellipsoid/chapter.cpp"}},
    .answer = answer,
};

}   // namespace meshfolio::q2_ellipsoid
