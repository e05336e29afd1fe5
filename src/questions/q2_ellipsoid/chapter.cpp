// Question 2: first and second fundamental form of the ellipsoid, and the normal curvature at (a, 0, 0).
#include "questions/q2_ellipsoid/parts.h"

namespace meshfolio::q2_ellipsoid {

namespace {

report::Text about_tip(const Tip& tip) {
    const PrincipalCurvatures& k = tip.principal;
    return words.say(tip.largest_along_y() ? "at_tip.b_below_c" : "at_tip.b_above_c", "axes"_a = axes_text(tip.ellipsoid),
                     "least"_a = readable(k.minimum, 2), "largest"_a = readable(k.maximum, 2));
}

void add_discussion(report::Section& section, const Tip& tip, const Oracles& oracles, const DiscreteTips& tips) {
    const Ellipsoid& e = tip.ellipsoid;
    const auto [gap, degrees] = largest_gap(e);
    const double x = tip.forms.normal.x();   // the tip is at +x
    double forms = 0, curvature = 0;
    for (const OracleErrors& errors : oracles) {
        forms = std::max({forms, errors.I, errors.II});
        curvature = std::max({curvature, errors.K, errors.H});
    }
    const DiscreteTip &grid = tips.grid.back(), &icosphere = tips.icosphere.back();
    const bool stalls = icosphere.K_error >= tips.icosphere.front().K_error;
    add_paragraphs(section,
                   {about_tip(tip),
                    words.say("readings", "gap"_a = readable(gap, 2), "degrees"_a = degrees, "angle"_a = readable(tip.at_45_angle, 2),
                              "parameters"_a = readable(tip.at_45_parameters, 2)),
                    words.say("sign", "where"_a = x < 0 ? "inwards" : "outwards", "normal_x"_a = readable(x), "K"_a = readable(tip.K, 2)),
                    paragraph_of({words.say("against_oracles", "points"_a = total_points(oracles), "ellipsoids"_a = oracles.size(),
                                            "forms"_a = readable(forms, 2), "curvature"_a = readable(curvature, 2)),
                                  words.say("poles", "distance"_a = readable(near_pole, 2),
                                            "off"_a = readable(std::abs(curvature_near_pole(e) / pole_limit(e) - 1), 2)),
                                  words.say("on_meshes", "grid_vertices"_a = grid.vertices, "H_error"_a = readable_percent(grid.H_error, 2),
                                            "K_error"_a = readable_percent(grid.K_error, 2), "icosphere_vertices"_a = icosphere.vertices,
                                            "icosphere_H_error"_a = readable_percent(icosphere.H_error, 2),
                                            "icosphere_K_error"_a = readable_percent(icosphere.K_error, 2)),
                                  stalls ? words.say("on_meshes.stall") : report::Text()})});
}

/// Two mistakes of earlier reports at the tip: (u, v) = (0, π), and E = a² with e = abc.
report::Text about_mistakes(const Tip& tip) {
    const Ellipsoid& e = tip.ellipsoid;
    const Vector3 there = ellipsoid_point(e, 0, pi);
    const FundamentalForms differences = ellipsoid_forms_by_differences(e, 0, pi / 2);
    const double wrong = e.a * e.b * e.c / (e.a * e.a), right = normal_curvature(tip.forms, {1, 0});
    return words.say("mistakes", "x"_a = readable(without_rounding(there.x())), "y"_a = readable(there.y()), "z"_a = readable(there.z()),
                     "distance"_a = readable((there - Vector3(e.a, 0, 0)).norm()), "wrong_E"_a = readable(e.a * e.a),
                     "wrong_e"_a = readable(e.a * e.b * e.c), "E"_a = readable(differences.I(0, 0), 4),
                     "e"_a = readable(differences.II(0, 0), 4), "wrong"_a = readable(wrong), "right"_a = readable(right, 4),
                     "off"_a = readable_percent(std::abs(wrong / right - 1)));
}

void add_checks(report::Section& section, const std::vector<Tip>& tips, const Oracles& oracles, const DiscreteTips& discrete) {
    const auto line = [](const char* key, const Ellipsoid& e) { return words.line(key, "axes"_a = axes_text(e)); };
    for (const Tip& tip : tips) {
        const auto [a, b, c] = tip.ellipsoid;
        const auto name = [&](const char* key) { return line(key, tip.ellipsoid); };
        const auto [smaller, larger] = std::minmax({a / (b * b), a / (c * c)});
        add(section, check_near(name("check.tip.smaller"), smaller, tip.principal.minimum, 1e-12),
            check_near(name("check.tip.larger"), larger, tip.principal.maximum, 1e-12),
            check_near(name("check.tip.gaussian"), a * a / (b * b * c * c), tip.K, 1e-11),
            check_at_most(name("check.tip.euler"), 0, tip.worst_euler, 1e-12),
            check_at_most(name("check.tip.parameters"), 0, tip.worst_parameters, 1e-12));
    }
    constexpr double r = 0.8;
    const Tip sphere = tip_of({r, r, r});   // κ_n is 1/r in every direction
    add(section, check_near(words.line("check.sphere.smaller"), 1 / r, sphere.principal.minimum, 1e-12),
        check_near(words.line("check.sphere.larger"), 1 / r, sphere.principal.maximum, 1e-12));
    for (const OracleErrors& e : oracles) {
        const auto name = [&](const char* key) { return line(key, e.ellipsoid); };
        add(section, check_at_most(name("check.oracle.first"), 0, e.I, 1e-8), check_at_most(name("check.oracle.second"), 0, e.II, 1e-8),
            check_at_most(name("check.oracle.gaussian"), 0, e.K, 1e-11), check_at_most(name("check.oracle.mean"), 0, e.H, 1e-11));
    }
    const double limit = pole_limit(tips.front().ellipsoid);
    add(section, check_near(words.line("check.pole"), limit, curvature_near_pole(tips.front().ellipsoid), 1e-6 * limit),
        check_near(words.line("check.discrete.mean"), 2, errors_of(discrete.grid, &DiscreteTip::H_error).order().exponent, 0.2),
        check_near(words.line("check.discrete.gaussian"), 2, errors_of(discrete.grid, &DiscreteTip::K_error).order().exponent, 0.2));
}

}   // namespace

ReadingGap largest_gap(const Ellipsoid& e) {
    ReadingGap largest;
    for (int degrees = 0; degrees <= 90; ++degrees) {
        const double theta = degrees * pi / 180;
        const double gap = std::abs(tip_curvature_by_angle(e, theta) - tip_curvature_by_parameters(e, theta));
        if (gap > largest.gap) largest = {gap, degrees};
    }
    return largest;
}

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
    progress("curvature of an ellipsoid mesh at its tip");
    const DiscreteTips discrete = discrete_tips(flat_ellipsoid, settings.quick);

    section.answer = words.say("answer");
    const PrincipalCurvatures& k = tip.principal;
    add_paragraphs(section, {words.say("lead", "axes"_a = axes_text(tip.ellipsoid), "least"_a = readable(k.minimum, 2),
                                       "least_along"_a = direction_text(k.minimum_direction), "largest"_a = readable(k.maximum, 2),
                                       "largest_along"_a = direction_text(k.maximum_direction))});
    add_words(section, words, "method");
    add(section, angle_diagram(tip));
    add_words(section, words, {"method.tip", "results"});
    add(section, tip_table(tips), tip_plot(tip, "q2_tip_b_above_c"));
    add_discussion(section, tip, oracles, discrete);
    add_checks(section, tips, oracles, discrete);

    begin_appendix(section);
    add_words(section, words, "appendix");
    add(section, forms_table(flat_ellipsoid));
    add_ellipsoid_figure(answer, flat_ellipsoid, settings.quick, settings.colormap);
    add_paragraphs(section, {about_tip(tips[1]), about_mistakes(tip)});
    add(section, discrete_table(tip, discrete));

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
    .cost = {.cpu = {{0.15, 0}, {0.04, 0}}, .memory = {{9, 0}, {1, 0}}},
    .answer = answer,
};

}   // namespace meshfolio::q2_ellipsoid
