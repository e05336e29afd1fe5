#include "sheet/view_label.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <string>

#include "color/srgb.h"
#include "scene/camera.h"
#include "sheet/text.h"

namespace render {

namespace {

struct Axis {
    std::string_view name;
    glm::dvec3 direction;
    Rgba color;
};

using Tripod = std::array<Axis, 3>;

/// The usual colours of the axes, for light and for dark backgrounds.
constexpr Tripod dark_axes{
    {{"x", {1, 0, 0}, {190, 45, 40, 255}}, {"y", {0, 1, 0}, {40, 130, 50, 255}}, {"z", {0, 0, 1}, {40, 85, 190, 255}}}};
constexpr Tripod light_axes{
    {{"x", {1, 0, 0}, {255, 128, 120, 255}}, {"y", {0, 1, 0}, {122, 210, 128, 255}}, {"z", {0, 0, 1}, {130, 172, 255, 255}}}};

/// Lengths in the tripod, in em.
constexpr double letter = 0.82, arm = 1.0, letter_gap = 0.36, side = 3.2, gap = 0.2;

/// Returns the name with a minus sign for the hyphen, and "three-quarter view" for "hero".
std::string shown_name(std::string_view name) {
    if (name == three_quarter_view().name) return "three-quarter view";
    return name.starts_with('-') ? "\u2212" + std::string(name.substr(1)) : std::string(name);
}

void add_letter(Drawing& drawing, glm::dvec2 middle, const Axis& axis, double em) {
    const double size = letter * em;
    drawing.add_text(middle.x, middle.y + 0.27 * size, std::string(axis.name), {size, axis.color, Align::centre, Weight::bold});
}

/// Adds an axis in the picture plane.
void add_arrow(Drawing& drawing, glm::dvec2 from, glm::dvec2 direction, double em, const Axis& axis) {
    const double width = std::max(1.2, 0.085 * em), head = 0.24 * em;
    const glm::dvec2 tip = from + arm * em * direction, across(-direction.y, direction.x);
    drawing.add_line(from, tip, width, axis.color);
    drawing.add_line(tip, tip - head * (direction + 0.62 * across), width, axis.color);
    drawing.add_line(tip, tip - head * (direction - 0.62 * across), width, axis.color);
    add_letter(drawing, tip + letter_gap * 1.25 * em * direction, axis, em);
}

/// Adds an axis along the line of sight: a ringed dot if it points to the viewer, a ringed cross if it points away.
void add_end_on(Drawing& drawing, glm::dvec2 at, bool towards, double em, const Axis& axis) {
    const double width = std::max(1.2, 0.085 * em), radius = 0.22 * em;
    drawing.items.emplace_back(Drawing::Ring{at, radius, width, axis.color});
    if (towards) {
        drawing.add_line(at, at, 0.2 * em, axis.color);
    } else {
        const double d = radius / std::sqrt(2.0);
        drawing.add_line(at - d, at + d, width, axis.color);
        drawing.add_line(at + glm::dvec2(-d, d), at + glm::dvec2(d, -d), width, axis.color);
    }
}

/// Adds the three axes in a square of `side` em with its middle at `middle`.
void add_tripod(Drawing& drawing, glm::dvec2 middle, const View& view, const Tripod& axes, double em) {
    glm::dvec2 sum(0);
    const auto on_screen = [&](const Axis& a) { return glm::dvec2(glm::dot(a.direction, view.right()), -glm::dot(a.direction, view.up)); };
    for (const Axis& a : axes) sum += on_screen(a);   // the diagonal into which the two visible axes open
    const glm::dvec2 origin = middle - 0.5 * arm * em * sum;
    for (const Axis& a : axes) {
        const double depth = glm::dot(a.direction, view.from);
        if (std::abs(depth) < 0.5) {
            add_arrow(drawing, origin + 0.22 * em * on_screen(a), on_screen(a), em, a);
        } else {
            add_end_on(drawing, origin, depth > 0, em, a);
            add_letter(drawing, origin - 0.5 * em * sum, a, em);
        }
    }
}

}   // namespace

double view_label_width(std::string_view view, double em) {
    const double name = text_width(shown_name(view), {em});
    return is_name_of_six(view) ? name + (side + gap) * em : name;
}

double view_label_height(double em) { return side * em; }

void add_view_label(Drawing& drawing, double x, double y, std::string_view view, double em, Rgba ink, Up up) {
    double left = x - view_label_width(view, em) / 2;
    if (is_name_of_six(view)) {
        const Tripod& axes = lab_of(ink).x > 50 ? light_axes : dark_axes;
        add_tripod(drawing, {left + side * em / 2, y}, view_named(std::string(view), up), axes, em);
        left += (side + gap) * em;
    }
    drawing.add_text(left, y + 0.27 * em, shown_name(view), {em, ink});
}

}   // namespace render
