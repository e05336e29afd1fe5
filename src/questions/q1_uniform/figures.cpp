#include <Eigen/Geometry>
#include <tuple>

#include "geometry/operators/uniform_laplacian.h"
#include "questions/bench/estimators.h"
#include "questions/bench/one_ring.h"
#include "questions/core/diagram_names.h"
#include "questions/q1_uniform/parts.h"

namespace meshfolio::q1_uniform {

namespace {

using namespace diagram_names;

constexpr double drawn_normal = 0.9;   // length of n in drawings on the unit sphere

/// Returns a parallel projection from aside, in which directions along `right` keep their length.
/// @param elevation  of the eye over the tangent plane [rad]
auto side_view(const Vector3& origin, const Vector3& right, const Vector3& normal, double elevation = 0.8) {
    const Vector3 up = normal * std::cos(elevation) + right.cross(normal).normalized() * std::sin(elevation);
    return [=](const Vector3& p) -> DiagramPoint { return {(p - origin).dot(right), (p - origin).dot(up)}; };
}

/// Draws a ring on a sphere, and Δx with its parts along the normal and along the surface.
Diagram::Panel laplacian_panel() {
    const SampleRing sample = ring_on_a_sphere();
    const auto point = [&](int v) -> Vector3 { return sample.mesh.X.row(v).transpose(); };
    const Vector3 x = point(sample.vertex), normal = vertex_normals(sample.mesh).row(sample.vertex).transpose();
    const Positions laplacian = uniform_laplacian(sample.topology) * sample.mesh.X;
    const Vector3 drift = laplacian.row(sample.vertex).transpose();
    const Vector3 along_surface = drift - drift.dot(normal) * normal;
    const auto seen = side_view(x, along_surface.normalized(), normal);

    Diagram::Panel panel{.title = words.line("diagram.laplacian")};
    std::vector<DiagramPoint> corners;
    for (const int j : ring_in_order(sample.mesh, sample.topology, sample.vertex)) corners.push_back(seen(point(j)));
    panel.paths.push_back(path_through(corners, Style::area, true));
    panel.paths.push_back(path_through(corners, Style::line, true));
    for (const DiagramPoint& corner : corners) panel.paths.push_back(path_through({seen(x), corner}, Style::thin));
    const DiagramPoint tip = seen(x + drift), foot = seen(x + along_surface);
    panel.paths.push_back(path_through({seen(x), foot}, Style::line));
    panel.paths.back().arrow = true;
    panel.paths.push_back(path_through({foot, tip}, Style::dashed));
    panel.paths.push_back(path_through({seen(x), tip}, Style::accent));
    panel.paths.back().arrow = true;
    const DiagramPoint outwards = seen(x + drawn_normal * normal);
    panel.paths.push_back(path_through({seen(x), outwards}, Style::line));
    panel.paths.back().arrow = true;
    panel.labels.push_back({.x = outwards[0], .y = outwards[1], .words = text(math("n")), .side = Side::right});
    panel.labels.push_back({.x = 0, .y = 0, .words = text(math("x_i")), .side = Side::above_left, .dot = true});
    const DiagramPoint left = *std::ranges::min_element(corners, {}, [](const DiagramPoint& p) { return p[0]; });
    panel.labels.push_back({.x = left[0], .y = left[1], .words = text(math("x_j")), .side = Side::left, .dot = true});
    panel.labels.push_back({.x = tip[0], .y = tip[1], .words = text(math("Δx")), .side = Side::below_right, .accent = true});
    panel.labels.push_back({.x = foot[0], .y = foot[1], .words = words.say("diagram.drift"), .side = Side::above_right});
    return panel;
}

/// Draws the ring of laplacian_panel() cut open and laid flat.
Diagram::Panel deficit_panel() {
    const SampleRing sample = ring_on_a_sphere();
    // The gap opens downwards.
    const double gap = flat_ring(sample.mesh, sample.topology, sample.vertex).gap();
    const FlatRing ring = flat_ring(sample.mesh, sample.topology, sample.vertex, -pi / 2 + gap / 2);
    Diagram::Panel panel{.title = words.line("diagram.deficit")};
    std::vector<DiagramPoint> outline = ring.corners;
    outline.push_back({0, 0});
    panel.paths.push_back(path_through(outline, Style::area, true));
    panel.paths.push_back(path_through(outline, Style::line, true));
    const auto first = ring.corners.begin();
    for (auto corner = first + 1; corner + 1 != ring.corners.end(); ++corner)
        panel.paths.push_back(path_through({{0, 0}, *corner}, Style::thin));
    const auto length = [](const DiagramPoint& p) { return std::hypot(p[0], p[1]); };
    const double cut = length(ring.corners.front()), shortest = length(*std::ranges::min_element(ring.corners, {}, length));
    panel.paths.push_back(report::arc({0, 0}, 0.6 * cut, -pi / 2 - gap / 2, -pi / 2 + gap / 2, Style::accent));
    panel.labels.push_back({.x = 0, .y = -0.6 * cut, .words = text(math("2π − Σθ")), .side = Side::below, .accent = true});
    for (int t = 0; t < ring.triangles(); ++t) {
        const DiagramPoint &p = first[t], &q = first[t + 1];
        panel.paths.push_back(report::angle_arc({0, 0}, p, q, 0.25 * shortest, Style::thin));
        // The label stands on the bisector of the angle, inside the triangle.
        const double halving = 2 * length(p) * length(q) * std::cos(ring.angles[t] / 2) / (length(p) + length(q));
        const DiagramPoint at = report::inside_angle({0, 0}, p, q, 0.65 * halving);
        panel.labels.push_back({.x = at[0], .y = at[1], .words = text(math("θ_" + std::to_string(t + 1))), .side = Side::centre});
    }
    return panel;
}

/// Draws the cell of a flat ring for one form of area; obtuse triangles are shaded.
Diagram::Panel area_panel(const FlatRing& ring, AreaForm form) {
    Diagram::Panel panel{.title = area_name(form)};
    const auto corner = ring.corners.begin();
    for (int t = 0; t < ring.triangles(); ++t)
        if (is_obtuse(ring, t)) panel.paths.push_back(path_through({{0, 0}, corner[t], corner[t + 1]}, Style::area, true));
    panel.paths.push_back(path_through(cell_of(ring, form), Style::accent_area, true));
    panel.paths.push_back(path_through({ring.corners.begin(), ring.corners.end() - 1}, Style::line, true));
    for (int t = 0; t < ring.triangles(); ++t) panel.paths.push_back(path_through({{0, 0}, corner[t]}, Style::thin));
    panel.paths.push_back(path_through(cell_of(ring, form), Style::accent, true));
    panel.labels.push_back({.x = 0, .y = 0, .words = {}, .dot = true});
    return panel;
}

struct Shown {
    std::string key;   // the end of its panel's name, and the beginning of its label
    std::string quantity, unit;
    Vector values;
    double floor;   // least width of the colour range
    double least;   // values below are rounding
};

/// Returns the values of the panels of H and of K.
std::array<Shown, 2> H_and_K_of(const MeshCurvature& c) {
    const double area = c.subject.diagonal * c.subject.diagonal;
    return {{{"h", "½‖Δx‖ (signed)", "% of h̄", 100 / c.subject.mean_edge * c.length, 0.1, 100 * visible},
             {"k", "K", "1/length²", c.K, 0.1 / area, 0.01 / area}}};
}

/// Adds a figure of H and K of these meshes side by side. Irregular vertices that the text mentions are ringed.
void add_H_and_K(Answer& answer, const std::vector<const MeshCurvature*>& meshes, const std::string& id, const std::string& key,
                 output::Layout layout) {
    output::FigureRequest figure{.id = id,
                                 .title = words.line(key + ".title"),
                                 .frame_panel = -1,
                                 .layout = layout,
                                 .turnable = layout == output::Layout::six_views,
                                 .in_a_line = 2,
                                 .view_files = layout == output::Layout::six_views,
                                 .states = 2};
    UndefinedVertices masked;
    Names ringed;
    for (const MeshCurvature* c : meshes) {
        for (const Shown& shown : H_and_K_of(*c)) {
            const double most = largest_magnitude(shown.values);
            const std::string label =
                words.line(shown.key + (most > shown.least ? ".label" : ".label.zero"), "mesh"_a = c->name(), "most"_a = readable(most, 2));
            figure.panels.push_back(unit_ball_panel(c->subject, "q1_" + c->name() + "_" + shown.key, label, shown.values));
            set_own_range(figure.panels.back(), diverging_range(shown.values, shown.floor), shown.quantity, shown.unit);
        }
        masked += undefined_vertices(c->subject);
        if (const IrregularVertices odd = irregular_vertices(*c); odd.ringed()) {
            figure.panels.back().marked_vertices = odd.vertices;
            ringed.push_back(c->name());
        }
    }
    const std::string marked = ringed.empty() ? "" : " " + words.line("marked", "meshes"_a = listed(ringed));
    add_figure(answer, std::move(figure), words.line(key + ".caption", "marked"_a = marked, "undefined"_a = undefined_words(masked)));
}

/// Draws a square patch of z = −½(κ₁y² + κ₂x²), seen along y and from above, with the curves of κ₁ and κ₂.
Diagram::Panel patch_panel(double kappa_1, double kappa_2, const std::string& title) {
    constexpr double turn = 0.45, elevation = 0.75, reach = 1, line_spacing = 0.25;
    constexpr int steps = 24;
    const auto seen = side_view({0, 0, 0}, {std::cos(turn), std::sin(turn), 0}, {0, 0, 1}, elevation);
    const auto curve = [&](const Vector3& start, const Vector3& direction) {
        std::vector<DiagramPoint> points;
        for (int i = -steps; i <= steps; ++i) {
            Vector3 p = start + reach * i / steps * direction;
            p.z() = -(kappa_1 * p.y() * p.y() + kappa_2 * p.x() * p.x()) / 2;
            points.push_back(seen(p));
        }
        return points;
    };
    const Vector3 x = Vector3::UnitX(), y = Vector3::UnitY();
    Diagram::Panel panel{.title = title};
    std::vector<DiagramPoint> outline;
    for (const auto& [start, direction] : {std::pair<Vector3, Vector3>{-y, x}, {x, y}, {y, -x}, {-x, -y}}) {
        const auto side = curve(start, direction);
        outline.insert(outline.end(), side.begin(), side.end());
    }
    panel.paths.push_back(path_through(outline, Style::area, true));
    panel.paths.push_back(path_through(outline, Style::line, true));
    for (double at = line_spacing - reach; at < reach; at += line_spacing) {
        panel.paths.push_back(path_through(curve(at * y, x), Style::thin));
        panel.paths.push_back(path_through(curve(at * x, y), Style::thin));
    }
    const auto label = [&](const std::vector<DiagramPoint>& points, const char* name, double kappa, Side side) {
        panel.paths.push_back(path_through(points, Style::accent));
        const std::string value = std::string(name) + " = " + readable(kappa, 1);
        panel.labels.push_back({.x = points.back()[0], .y = points.back()[1], .words = text(math(value)), .side = side, .accent = true});
    };
    label(curve({0, 0, 0}, y), "κ_1", kappa_1, Side::below);
    label(curve({0, 0, 0}, x), "κ_2", kappa_2, Side::right);
    const DiagramPoint tip = seen({0, 0, 0.8});
    panel.paths.push_back(path_through({seen({0, 0, 0}), tip}, Style::line));
    panel.paths.back().arrow = true;
    panel.labels.push_back({.x = tip[0], .y = tip[1], .words = text(math("n")), .side = Side::above});
    return panel;
}

}   // namespace

Diagram ring_diagram() {
    const SampleRing sphere = ring_on_a_sphere(), flat = obtuse_ring_in_a_plane();
    const double share = tangential_shares(sphere.mesh, sphere.topology)[sphere.vertex];
    const double gap = flat_ring(sphere.mesh, sphere.topology, sphere.vertex).gap();
    const FlatRing ring = flat_ring(flat.mesh, flat.topology, flat.vertex);
    Diagram diagram{.id = "q1_ring",
                    .caption = words.line("diagram.caption", "share"_a = readable_percent(share, 2), "gap"_a = readable(gap * 180 / pi, 2)),
                    .alt = words.line("diagram.alt", "gap"_a = readable(gap * 180 / pi, 2)),
                    .panels = {laplacian_panel(), deficit_panel()}};
    for (const AreaForm form : area_forms) diagram.panels.push_back(area_panel(ring, form));
    return diagram;
}

Diagram sign_diagram() {
    Diagram diagram{.id = "q1_signs", .caption = words.line("signs.caption")};
    Names titles;
    for (const auto& [key, kappa_1, kappa_2] :
         {std::tuple{"signs.cap", 1.0, 1.0}, {"signs.saddle", 1.0, -1.0}, {"signs.cylinder", 1.0, 0.0}}) {
        titles.push_back(words.line(key, "H"_a = readable((kappa_1 + kappa_2) / 2, 1), "K"_a = readable(kappa_1 * kappa_2, 1)));
        diagram.panels.push_back(patch_panel(kappa_1, kappa_2, titles.back()));
    }
    diagram.alt = words.line("signs.alt", "patches"_a = joined(titles));
    return diagram;
}

void add_figures(Answer& answer, const Meshes& meshes) {
    std::vector<const MeshCurvature*> all = each_of(meshes, [](const MeshCurvature& c) { return &c; });
    const auto alike = std::ranges::stable_partition(all, [](auto* c) { return !looks_alike_from_all_sides(*c); });
    std::vector<const MeshCurvature*> even(alike.begin(), alike.end());
    if (even.size() == all.size()) even.clear();   // the assignment asks for six views
    all.resize(all.size() - even.size());
    add_H_and_K(answer, all, "q1_h", "h", output::Layout::six_views);
    if (!even.empty()) add_H_and_K(answer, even, "q1_even", "even", output::Layout::multiples);
}

void add_tangential_figure(Answer& answer, const Meshes& meshes, const std::string& colormap) {
    output::FigureRequest figure{.id = "q1_tangential",
                                 .title = words.line("tangential.title"),
                                 .frame_panel = -1,
                                 .layout = output::Layout::multiples,
                                 .turnable = true};
    UndefinedVertices masked;
    for (const MeshCurvature& c : meshes) {
        if (c.subject.plane_normal || summary_of(c.H).count == 0) continue;
        const TangentialPart part = tangential_part(c);
        const std::string label = words.line("tangential.label", "mesh"_a = c.name(), "share"_a = readable_percent(part.share, 2));
        figure.panels.push_back(unit_ball_panel(c.subject, "q1_" + c.name() + "_tangential", label, 100 * part.shares));
        masked += undefined_vertices(c.subject);
    }
    figure.range =
        range_for({.colormap = colormap, .low = 0, .high = 100, .quantity = words.line("tangential.quantity"), .unit = "%"}, figure.panels);
    add_figure(answer, std::move(figure), words.line("tangential.caption", "undefined"_a = undefined_words(masked)));
}

}   // namespace meshfolio::q1_uniform
