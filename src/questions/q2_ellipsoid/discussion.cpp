#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "geometry/linear/special_values.h"
#include "questions/q2_ellipsoid/parts.h"

namespace meshfolio::q2_ellipsoid {

namespace {

report::Text about_tip(const Tip& tip) {
    const PrincipalCurvatures& k = tip.principal;
    return words.say(tip.largest_along_y() ? "at_tip.b_below_c" : "at_tip.b_above_c", "axes"_a = axes_text(tip.ellipsoid),
                     "least"_a = readable(k.minimum, 4), "least_along"_a = direction_text(k.minimum_direction),
                     "largest"_a = readable(k.maximum, 4), "largest_along"_a = direction_text(k.maximum_direction));
}

report::Text about_readings(const Tip& tip) {
    const Ellipsoid& e = tip.ellipsoid;
    const double at_axes = std::max(difference_of_readings(e, 0), difference_of_readings(e, pi / 2));
    const auto [gap, degrees] = largest_gap(e);
    return words.say("readings", "b"_a = readable(e.b), "c"_a = readable(e.c),
                     "agreement"_a = at_axes == 0 ? words.line("readings.exactly")
                                                  : words.line("readings.almost", "difference"_a = readable(at_axes, 2)),
                     "gap"_a = readable(gap), "degrees"_a = degrees, "angle"_a = readable(tip.at_45_angle),
                     "parameters"_a = readable(tip.at_45_parameters));
}

report::Text about_sign(const Tip& tip) {
    const double x = tip.forms.normal.x();   // the tip is at +x
    return words.say("sign", "where"_a = x < 0 ? "inwards" : "outwards", "normal_x"_a = readable(x),
                     "least"_a = readable(-tip.principal.maximum, 4), "largest"_a = readable(-tip.principal.minimum, 4),
                     "K"_a = readable(tip.K, 4));
}

report::Text about_oracles(const Oracles& oracles) {
    double I = 0, II = 0, curvature = 0;
    for (const OracleErrors& e : oracles) {
        I = std::max(I, e.I);
        II = std::max(II, e.II);
        curvature = std::max({curvature, e.K, e.H});
    }
    return words.say("against_oracles", "points"_a = total_points(oracles), "ellipsoids"_a = oracles.size(), "I"_a = readable(I, 2),
                     "II"_a = readable(II, 2), "curvature"_a = readable(curvature, 2));
}

report::Text about_poles(const Ellipsoid& e, const PoleSteps& steps) {
    const PoleStep &first = steps[1], &last = steps.back();
    const double power = std::log(first.area_element_squared / last.area_element_squared) / std::log(first.distance / last.distance);
    return words.say("poles", "from"_a = readable(first.distance), "to"_a = readable(last.distance),
                     "area_from"_a = readable(first.area_element_squared), "area_to"_a = readable(last.area_element_squared),
                     "power"_a = readable(power, 3), "K"_a = readable(last.K, 6),
                     "off"_a = readable(std::abs(last.K / pole_limit(e) - 1), 2));
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

/// Which of H and K the last refinement of the stretched icosphere did not bring closer.
std::string about_stretched(const DiscreteTips& tips) {
    const std::vector<DiscreteTip> last{tips.icosphere.end() - 2, tips.icosphere.end()};
    const Order H = errors_of(last, &DiscreteTip::H_error).order(), K = errors_of(last, &DiscreteTip::K_error).order();
    if (H.exponent > 0 && K.exponent > 0) return "";
    if (H.exponent <= 0 && K.exponent <= 0) return words.line("on_meshes.neither", "H_order"_a = words_of(H), "K_order"_a = words_of(K));
    const bool of_H = H.exponent <= 0;
    return words.line("on_meshes.one", "quantity"_a = of_H ? "H" : "K", "order"_a = words_of(of_H ? H : K));
}

report::Text about_meshes(const DiscreteTips& tips) {
    const DiscreteTip &grid = tips.grid.back(), &icosphere = tips.icosphere.back();
    return words.say("on_meshes", "grid_vertices"_a = grid.vertices, "H"_a = readable(grid.H, 5), "K"_a = readable(grid.K, 5),
                     "H_error"_a = readable_percent(grid.H_error, 2), "K_error"_a = readable_percent(grid.K_error, 2),
                     "H_order"_a = words_of(errors_of(tips.grid, &DiscreteTip::H_error).order()),
                     "K_order"_a = words_of(errors_of(tips.grid, &DiscreteTip::K_error).order()),
                     "icosphere_vertices"_a = icosphere.vertices, "icosphere_H_error"_a = readable_percent(icosphere.H_error, 2),
                     "icosphere_K_error"_a = readable_percent(icosphere.K_error, 2), "stretched"_a = about_stretched(tips));
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

void add_discussion(report::Section& section, const std::vector<Tip>& tips, const Oracles& oracles, const PoleSteps& pole,
                    const DiscreteTips& discrete) {
    const Tip& tip = tips.front();
    add_words(section, words, "discussion");
    for (const Tip& each : tips) add_paragraph(section, about_tip(each));
    add_paragraph(section, about_readings(tip));
    add_paragraph(section, about_sign(tip));
    add_paragraph(section, about_oracles(oracles));
    add_paragraph(section, about_poles(tip.ellipsoid, pole));
    add_paragraph(section, about_mistakes(tip));
    add_paragraph(section, about_meshes(discrete));
}

}   // namespace meshfolio::q2_ellipsoid
