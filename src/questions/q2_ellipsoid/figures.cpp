#include "geometry/curvature/analytic_surfaces.h"
#include "mesh/samples/sample_shapes.h"
#include "questions/core/diagram_names.h"
#include "questions/q2_ellipsoid/parts.h"

namespace meshfolio::q2_ellipsoid {

namespace {

using namespace diagram_names;

constexpr double drawn_angle = 0.7;   // θ of the drawing [rad]

/// Returns 120 points of an ellipse about the origin.
std::vector<DiagramPoint> ellipse(double half_width, double half_height) {
    std::vector<DiagramPoint> points;
    for (int i = 0; i < 120; ++i) {
        const double t = 2 * pi * i / 120;
        points.push_back({half_width * std::cos(t), half_height * std::sin(t)});
    }
    return points;
}

/// Adds an arrow from the origin with its name, and perhaps its axis, at the head.
void add_arrow(Diagram::Panel& panel, DiagramPoint head, const char* name, Side side, Style style, const char* axis = "") {
    panel.paths.push_back(path_through({{0, 0}, head}, style));
    panel.paths.back().arrow = true;
    panel.labels.push_back({.x = head[0], .y = head[1], .words = text(math(name), axis), .side = side, .accent = style == Style::accent});
}

/// Draws the tangent plane at the tip, seen along −n with the outline of the ellipsoid: p_u to the right, −p_v upwards.
Diagram::Panel tangent_plane(const Tip& tip) {
    const double b = tip.forms.p_u.norm(), c = tip.forms.p_v.norm();
    Diagram::Panel panel{.title = words.line("diagram.tangent_plane")};
    panel.paths.push_back(path_through(ellipse(b, c), Style::area, true));
    panel.paths.push_back(path_through(ellipse(b, c), Style::thin, true));
    add_arrow(panel, {b, 0}, "p_u", Side::below_right, Style::line, " (+y)");
    add_arrow(panel, {0, c}, "−p_v", Side::above, Style::line, " (+z)");
    add_arrow(panel, {std::cos(drawn_angle), std::sin(drawn_angle)}, "t", Side::above_right, Style::accent);
    panel.paths.push_back(report::arc({0, 0}, 0.4, 0, drawn_angle, Style::accent));
    panel.labels.push_back({.x = 0.5 * std::cos(drawn_angle / 2),
                            .y = 0.5 * std::sin(drawn_angle / 2),
                            .words = text(math("θ")),
                            .side = Side::centre,
                            .accent = true});
    panel.labels.push_back({.x = 0, .y = 0, .words = {}, .dot = true});
    return panel;
}

/// Draws the section by the plane of the normal and a tangent, and its osculating circle at the tip.
Diagram::Panel normal_section(const Tip& tip, const Eigen::Vector2d& du_dv, const char* title, const char* radius_name) {
    const double a = tip.ellipsoid.a, reach = (du_dv[0] * tip.forms.p_u + du_dv[1] * tip.forms.p_v).norm();
    const double radius = 1 / normal_curvature(tip.forms, du_dv);
    Diagram::Panel panel{.title = words.line(title)};
    panel.paths.push_back(path_through(ellipse(a, reach), Style::area, true));
    panel.paths.push_back(path_through(ellipse(a, reach), Style::line, true));
    panel.paths.push_back(report::arc({a - radius, 0}, radius, 0, 2 * pi, Style::accent));
    panel.paths.push_back(path_through({{a - radius, 0}, {a, 0}}, Style::accent));
    panel.labels.push_back({.x = a - radius, .y = radius, .words = text(math(radius_name)), .side = Side::above, .accent = true});
    panel.labels.push_back({.x = a, .y = 0, .words = text(math("(a, 0, 0)")), .side = Side::right, .dot = true});
    return panel;
}

}   // namespace

Diagram angle_diagram(const Tip& tip) {
    const double along_y = 1 / normal_curvature(tip.forms, {1, 0}), along_z = 1 / normal_curvature(tip.forms, {0, 1});
    return {.id = "q2_angle",
            .caption = words.line("diagram.caption", "axes"_a = axes_text(tip.ellipsoid), "along_y"_a = readable(along_y, 2),
                                  "along_z"_a = readable(along_z, 2)),
            .alt = words.line("diagram.alt", "along_y"_a = readable(along_y, 2), "along_z"_a = readable(along_z, 2)),
            .panels = {tangent_plane(tip), normal_section(tip, {1, 0}, "diagram.along_y", "b²/a"),
                       normal_section(tip, {0, 1}, "diagram.along_z", "c²/a")}};
}

void add_ellipsoid_figure(Answer& answer, const Ellipsoid& ellipsoid, bool quick, const std::string& colormap) {
    const auto curvature = [axes = axes_of(ellipsoid)](const Vector3& p) { return ellipsoid_curvature(axes, p).H; };
    TriangleMesh mesh = ellipsoid_mesh(quick ? 4 : 5, axes_of(ellipsoid));
    Vector H(mesh.vertex_count());
    for (int i = 0; i < mesh.vertex_count(); ++i) H[i] = curvature(mesh.X.row(i));
    output::FigureRequest figure{.id = "q2_ellipsoid_h",
                                 .title = words.line("ellipsoid.title"),
                                 .subtitle = axes_text(ellipsoid),
                                 .panels = {panel_of(std::move(mesh), "q2_ellipsoid_h", "H", H)}};
    figure.range = output::robust_range(figure.panels, colormap, "mean curvature H", "1/length", 0.01, 0);
    add_figure(answer, std::move(figure),
               words.line("ellipsoid.caption", "axes"_a = axes_text(ellipsoid), "tip"_a = readable(curvature({ellipsoid.a, 0, 0})),
                          "pole"_a = readable(curvature({0, 0, ellipsoid.c}))));
}

}   // namespace meshfolio::q2_ellipsoid
