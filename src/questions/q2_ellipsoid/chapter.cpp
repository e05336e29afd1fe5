// Question 2: first and second fundamental form of the ellipsoid, and the normal curvature at (a, 0, 0).
#include "questions/q2_ellipsoid/parts.h"

namespace meshfolio::q2_ellipsoid {

namespace {

void check_tip(report::Section& section, const Tip& tip) {
    const auto [a, b, c] = tip.ellipsoid;
    const auto name = [&](const char* key) { return words.line(key, "axes"_a = axes_text(tip.ellipsoid)); };
    const auto [smaller, larger] = std::minmax({a / (b * b), a / (c * c)});
    append_checks(section, {check_near(name("check.tip.smaller"), smaller, tip.principal.minimum, 1e-12),
                            check_near(name("check.tip.larger"), larger, tip.principal.maximum, 1e-12),
                            check_near(name("check.tip.gaussian"), a * a / (b * b * c * c), tip.K, 1e-11),
                            check_at_most(name("check.tip.euler"), 0, tip.worst_euler, 1e-12),
                            check_at_most(name("check.tip.parameters"), 0, tip.worst_parameters, 1e-12)});
}

/// On a sphere κ_n is 1/r in every direction.
void check_sphere(report::Section& section, double r) {
    const Tip tip = tip_of({r, r, r});
    append_checks(section, {check_near(words.line("check.sphere.smaller"), 1 / r, tip.principal.minimum, 1e-12),
                            check_near(words.line("check.sphere.larger"), 1 / r, tip.principal.maximum, 1e-12)});
}

void check_oracles(report::Section& section, const OracleErrors& e) {
    const auto name = [&](const char* key) { return words.line(key, "axes"_a = axes_text(e.ellipsoid)); };
    append_checks(section,
                  {check_at_most(name("check.oracle.first"), 0, e.I, 1e-8), check_at_most(name("check.oracle.second"), 0, e.II, 1e-8),
                   check_at_most(name("check.oracle.gaussian"), 0, e.K, 1e-11), check_at_most(name("check.oracle.mean"), 0, e.H, 1e-11)});
}

void add_checks(report::Section& section, const std::vector<Tip>& tips, const Oracles& oracles, const PoleSteps& pole,
                const DiscreteTips& discrete) {
    for (const Tip& tip : tips) check_tip(section, tip);
    check_sphere(section, 0.8);
    for (const OracleErrors& e : oracles) check_oracles(section, e);
    const double limit = pole_limit(tips.front().ellipsoid);
    append_checks(
        section,
        {check_near(words.line("check.pole"), limit, pole.back().K, 1e-6 * limit),
         check_near(words.line("check.discrete.mean"), 2, errors_of(discrete.grid, &DiscreteTip::H_error).order().exponent, 0.2),
         check_near(words.line("check.discrete.gaussian"), 2, errors_of(discrete.grid, &DiscreteTip::K_error).order().exponent, 0.2)});
}

}   // namespace

std::string direction_text(const Vector3& t) { return std::abs(t.y()) > std::abs(t.z()) ? "±y" : "±z"; }

int total_points(const Oracles& oracles) {
    int points = 0;
    for (const OracleErrors& e : oracles) points += e.points;
    return points;
}

Answer answer(const MeshLibrary&, const QuestionSettings& settings, const Progress& progress) {
    Answer answer{section_of("q2")};
    report::Section& section = answer.section;
    progress("fundamental forms of the ellipsoid");
    const std::vector<Tip> tips{tip_of(flat_ellipsoid), tip_of(tall_ellipsoid)};
    const Tip& tip = tips.front();
    const Oracles oracles = all_oracle_errors(settings);
    const PoleSteps pole = towards_the_pole(flat_ellipsoid);
    progress("curvature of an ellipsoid mesh at its tip");
    const DiscreteTips discrete = discrete_tips(flat_ellipsoid, settings.quick);

    section.answer = words.say("answer");
    add_paragraphs(section, {lead_of(tip)});
    add_words(section, words, "method");
    add(section, angle_diagram(tip));
    add_words(section, words, {"method.tip", "results"});
    add(section, tip_table(tips), tip_plot(tips[0], "q2_tip_b_above_c"));
    add_discussion(section, tip, oracles, pole, discrete);
    add_checks(section, tips, oracles, pole, discrete);

    begin_appendix(section);
    add_words(section, words, "appendix");
    add(section, forms_table(flat_ellipsoid));
    add_ellipsoid_figure(answer, flat_ellipsoid, settings.quick, settings.colormap);
    add(section, tip_plot(tips[1], "q2_tip_b_below_c"));
    add_remarks(section, tips[1], tip);
    add(section, oracle_table(oracles), pole_table(flat_ellipsoid, pole), discrete_table(tip, discrete));

    const int points = oracles.front().points;
    const Ellipsoid &flat = flat_ellipsoid, &tall = tall_ellipsoid;
    section.parameters = {
        {"ellipsoids", {axes_text(flat) + "; " + axes_text(tall), std::vector{flat.a, flat.b, flat.c, tall.a, tall.b, tall.c}, "length"}},
        {"random points",
         {words.line("parameter.points", "points"_a = points, "seed"_a = std::to_string(settings.seed)), static_cast<double>(points)}}};
    section.extent = words.line("extent", "points"_a = total_points(oracles), "ellipsoids"_a = oracles.size());
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
