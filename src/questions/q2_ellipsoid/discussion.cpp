#include "questions/q2_ellipsoid/parts.h"

namespace meshfolio::q2_ellipsoid {

namespace {

report::Text about_tip(const Tip& tip) {
    const PrincipalCurvatures& k = tip.principal;
    return words.say(tip.largest_along_y() ? "at_tip.b_below_c" : "at_tip.b_above_c", "axes"_a = axes_text(tip.ellipsoid),
                     "least"_a = readable(k.minimum, 2), "largest"_a = readable(k.maximum, 2));
}

report::Text about_readings(const Tip& tip) {
    const Ellipsoid& e = tip.ellipsoid;
    const auto [gap, degrees] = largest_gap(e);
    return words.say("readings", "gap"_a = readable(gap, 2), "degrees"_a = degrees, "angle"_a = readable(tip.at_45_angle, 2),
                     "parameters"_a = readable(tip.at_45_parameters, 2));
}

report::Text about_sign(const Tip& tip) {
    const double x = tip.forms.normal.x();   // the tip is at +x
    return words.say("sign", "where"_a = x < 0 ? "inwards" : "outwards", "normal_x"_a = readable(x), "K"_a = readable(tip.K, 2));
}

report::Text about_oracles(const Oracles& oracles) {
    double forms = 0, curvature = 0;
    for (const OracleErrors& e : oracles) {
        forms = std::max({forms, e.I, e.II});
        curvature = std::max({curvature, e.K, e.H});
    }
    return words.say("against_oracles", "points"_a = total_points(oracles), "ellipsoids"_a = oracles.size(), "forms"_a = readable(forms, 2),
                     "curvature"_a = readable(curvature, 2));
}

report::Text about_poles(const Ellipsoid& e, const PoleSteps& steps) {
    const PoleStep& last = steps.back();
    return words.say("poles", "distance"_a = readable(last.distance, 2), "off"_a = readable(std::abs(last.K / pole_limit(e) - 1), 2));
}

/// What earlier reports had at the tip: (u, v) = (0, π), E = a² and e = abc.
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

report::Text about_meshes(const DiscreteTips& tips) {
    const DiscreteTip &grid = tips.grid.back(), &icosphere = tips.icosphere.back();
    report::Text t = words.say("on_meshes", "grid_vertices"_a = grid.vertices, "H_error"_a = readable_percent(grid.H_error, 2),
                               "K_error"_a = readable_percent(grid.K_error, 2), "icosphere_vertices"_a = icosphere.vertices,
                               "icosphere_H_error"_a = readable_percent(icosphere.H_error, 2),
                               "icosphere_K_error"_a = readable_percent(icosphere.K_error, 2));
    if (icosphere.K_error >= tips.icosphere.front().K_error) go_on(t, words.say("on_meshes.stall"));
    return t;
}

}   // namespace

double difference_of_readings(const Ellipsoid& e, double theta) {
    return std::abs(tip_curvature_by_angle(e, theta) - tip_curvature_by_parameters(e, theta));
}

ReadingGap largest_gap(const Ellipsoid& e) {
    ReadingGap largest;
    for (int degrees = 0; degrees <= 90; ++degrees) {
        const double gap = difference_of_readings(e, degrees * pi / 180);
        if (gap > largest.gap) largest = {gap, degrees};
    }
    return largest;
}

report::Text lead_of(const Tip& tip) {
    const PrincipalCurvatures& k = tip.principal;
    return words.say("lead", "axes"_a = axes_text(tip.ellipsoid), "least"_a = readable(k.minimum, 2),
                     "least_along"_a = direction_text(k.minimum_direction), "largest"_a = readable(k.maximum, 2),
                     "largest_along"_a = direction_text(k.maximum_direction));
}

void add_discussion(report::Section& section, const Tip& tip, const Oracles& oracles, const PoleSteps& pole, const DiscreteTips& discrete) {
    add_paragraphs(section, {about_tip(tip), about_readings(tip), about_sign(tip),
                             paragraph_of({about_oracles(oracles), about_poles(tip.ellipsoid, pole), about_meshes(discrete)})});
}

void add_remarks(report::Section& section, const Tip& other, const Tip& tip) {
    add_paragraphs(section, {about_tip(other), about_mistakes(tip)});
}

}   // namespace meshfolio::q2_ellipsoid
