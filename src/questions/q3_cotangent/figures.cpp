#include "questions/bench/one_ring.h"
#include "questions/core/diagram_names.h"
#include "questions/q3_cotangent/parts.h"

namespace meshfolio::q3_cotangent {

namespace {

using namespace diagram_names;

/// Draws the outline of a ring, with thin lines to its vertex.
Diagram::Panel ring_panel(const FlatRing& ring, const char* title) {
    Diagram::Panel panel{.title = words.line(title)};
    const std::vector<DiagramPoint> outline{ring.corners.begin(), ring.corners.end() - 1};
    panel.paths.push_back(path_through(outline, Style::line, true));
    for (const DiagramPoint& corner : outline) panel.paths.push_back(path_through({{0, 0}, corner}, Style::thin));
    return panel;
}

void add_arrow(Diagram::Panel& panel, DiagramPoint from, DiagramPoint to) {
    panel.paths.push_back(path_through({from, to}, Style::accent));
    panel.paths.back().arrow = true;
}

/// Returns the mean of the neighbours of the vertex at the origin.
DiagramPoint ring_mean(const FlatRing& ring) {
    DiagramPoint mean{0, 0};
    for (int t = 0; t < ring.triangles(); ++t)
        for (const std::size_t axis : {0u, 1u}) mean[axis] += ring.corners[t][axis] / ring.triangles();
    return mean;
}

/// Draws the edge from the vertex to corner 1, and the angles opposite it.
Diagram::Panel weight_panel(const FlatRing& ring) {
    Diagram::Panel panel = ring_panel(ring, "diagram.weight");
    const DiagramPoint before = ring.corners[0], end = ring.corners[1], behind = ring.corners[2];
    const double radius = 0.3 * std::min(std::hypot(before[0], before[1]), std::hypot(behind[0], behind[1]));
    panel.paths.insert(panel.paths.begin(), path_through({{0, 0}, before, end, behind}, Style::area, true));
    panel.paths.push_back(path_through({{0, 0}, end}, Style::accent));
    const std::array angles{std::pair{before, "α_ij"}, std::pair{behind, "β_ij"}};
    for (const auto& [corner, name] : angles) {
        panel.paths.push_back(report::angle_arc(corner, {0, 0}, end, radius, Style::accent));
        const DiagramPoint at = report::inside_angle(corner, {0, 0}, end, 1.9 * radius);
        panel.labels.push_back({.x = at[0], .y = at[1], .words = text(math(name)), .side = Side::centre, .accent = true});
    }
    panel.labels.push_back({.x = 0, .y = 0, .words = text(math("x_i")), .side = Side::below_left, .dot = true});
    panel.labels.push_back({.x = end[0], .y = end[1], .words = text(math("x_j")), .side = Side::above, .dot = true});
    return panel;
}

/// Draws the pull of uniform weights, towards the mean of the neighbours.
Diagram::Panel uniform_panel(const FlatRing& ring) {
    Diagram::Panel panel = ring_panel(ring, "diagram.uniform");
    const DiagramPoint mean = ring_mean(ring);
    add_arrow(panel, {0, 0}, mean);
    panel.labels.push_back({.x = 0, .y = 0, .words = {}, .dot = true});
    panel.labels.push_back(
        {.x = mean[0], .y = mean[1], .words = text(math("Δx")), .side = mean[0] > 0 ? Side::right : Side::left, .accent = true});
    return panel;
}

/// Returns the corners of the Voronoi cell, the circumcentres of the triangles.
std::vector<DiagramPoint> circumcentres(const FlatRing& ring) {
    std::vector<DiagramPoint> centres;
    for (int t = 0; t < ring.triangles(); ++t) centres.push_back(cell_in_triangle(ring, t, AreaForm::voronoi)[2]);
    return centres;
}

/// Draws the pulls w_ij (x_j − x_i) at the vertex: each is a side of the Voronoi cell, turned back by a quarter turn.
Diagram::Panel cotangent_panel(const FlatRing& ring) {
    Diagram::Panel panel = ring_panel(ring, "diagram.cotangent");
    const std::vector<DiagramPoint> centres = circumcentres(ring);
    for (std::size_t t = 0; t < centres.size(); ++t) {
        const DiagramPoint &from = centres[(t + centres.size() - 1) % centres.size()], &to = centres[t];
        add_arrow(panel, {0, 0}, {to[1] - from[1], from[0] - to[0]});
    }
    panel.labels.push_back({.x = 0, .y = 0, .words = {}, .dot = true});
    return panel;
}

/// Draws the arrows of cotangent_panel() turned on by a quarter turn, around the Voronoi cell.
Diagram::Panel cell_panel(const FlatRing& ring) {
    Diagram::Panel panel = ring_panel(ring, "diagram.cell");
    const std::vector<DiagramPoint> centres = circumcentres(ring);
    panel.paths.insert(panel.paths.begin(), path_through(centres, Style::accent_area, true));
    for (std::size_t t = 0; t < centres.size(); ++t) add_arrow(panel, centres[t], centres[(t + 1) % centres.size()]);
    panel.labels.push_back({.x = 0, .y = 0, .words = {}, .dot = true});
    return panel;
}

}   // namespace

Diagram weight_diagram() {
    const SampleRing sample = uneven_ring_in_a_plane();
    const FlatRing ring = flat_ring(sample.mesh, sample.topology, sample.vertex);
    const DiagramPoint mean = ring_mean(ring);
    double edge = 0;
    for (int t = 0; t < ring.triangles(); ++t) edge += std::hypot(ring.corners[t][0], ring.corners[t][1]) / ring.triangles();
    const std::string drift = readable_percent(std::hypot(mean[0], mean[1]) / edge, 2);
    return {.id = "q3_weights",
            .caption = words.line("diagram.caption", "drift"_a = drift),
            .alt = words.line("diagram.alt", "drift"_a = drift),
            .panels = {weight_panel(ring), uniform_panel(ring), cotangent_panel(ring), cell_panel(ring)}};
}

double cotangent_range(const CotangentComparison& c) { return diverging_range(c.subject.mean_edge * c.cotangent, 0.01); }

void add_comparison_figure(Answer& answer, const Comparisons& meshes, const Disagreements& with_jets) {
    output::FigureRequest figure{
        .id = "q3_h", .title = words.line("comparison.title"), .frame_panel = -1, .turnable = true, .view_files = true, .states = 2};
    const bool is_short = std::ranges::count_if(meshes, is_curved) <= 2;   // fits on a page with further panels
    bool has_own = false;
    UndefinedVertices masked;
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        const CotangentComparison& c = meshes[m];
        if (!is_curved(c)) continue;
        const CurvatureSubject& s = c.subject;
        const auto add = [&](const std::string& name, const Vector& H, double range) {
            const std::string label = words.line("comparison." + name, "mesh"_a = s.name());
            figure.panels.push_back(unit_ball_panel(s, "q3_" + s.name() + "_h_" + name, label, s.mean_edge * H));
            set_own_range(figure.panels.back(), range, words.line("comparison.quantity"), "");
        };
        const double range = cotangent_range(c);
        add("uniform", c.uniform, range);
        add("cotangent", c.cotangent, range);
        if (is_short && summary_of(with_jets[m].jet).count > 0 && share_beyond(s.mean_edge * c.uniform, range) > 0.2) {
            add("own", c.uniform, diverging_range(s.mean_edge * c.uniform, 0.01));
            add("jet", with_jets[m].jet, range);
            has_own = true;
        }
        masked += undefined_vertices(s);
    }
    if (figure.panels.empty()) return;
    add_figure(answer, std::move(figure), words.line("comparison.caption", "own"_a = has_own, "undefined"_a = undefined_words(masked)));
}

// Shows |H|: on a flat surface the sign of H is rounding.
void add_plane_figure(Answer& answer, const Comparisons& meshes, const PlaneTest& plane, const std::string& colormap) {
    output::FigureRequest figure{
        .id = "q3_h_irregular_plane", .title = words.line("plane.title"), .edges = true, .layout = output::Layout::multiples};
    const auto show = [&](const TriangleMesh& mesh, const std::string& file, const std::string& name, const std::string& key, Vector H) {
        const std::string label = words.line("plane." + key, "mesh"_a = name, "most"_a = readable(largest_magnitude(H), 2));
        figure.panels.push_back(panel_of(in_unit_box(mesh, mesh.X), "q3_" + key + "_" + file, label, std::move(H)));
    };
    UndefinedVertices masked;
    for (const CotangentComparison& c : meshes) {
        if (is_curved(c)) continue;
        const CurvatureSubject& s = c.subject;
        show(s.mesh(), s.name(), s.name(), "uniform", s.mean_edge * c.uniform.cwiseAbs());
        show(s.mesh(), s.name(), s.name(), "cotangent", s.mean_edge * c.cotangent.cwiseAbs());
        masked += undefined_vertices(s);
    }
    const std::string square = words.line("plane.square");
    show(plane.mesh, "irregular_plane", square, "uniform", plane.uniform_H.cwiseAbs());
    show(plane.mesh, "irregular_plane", square, "cotangent", plane.cotangent_H.cwiseAbs());
    for (const double h : plane.uniform_H) masked.boundary += std::isfinite(h) ? 0 : 1;
    figure.range = range_from_zero(figure.panels, colormap, "|H| × mean edge", 0.01);
    add_figure(answer, std::move(figure),
               words.line("plane.caption", "vertices"_a = plane.mesh.vertex_count(), "undefined"_a = undefined_words(masked)));
}

void add_disagreement(Answer& answer, const CotangentComparison& c, const Disagreement& d, const std::string& colormap) {
    const CurvatureSubject& s = c.subject;
    const std::string id = "q3_" + s.name() + "_disagreement";
    output::FigureRequest figure{.id = id,
                                 .title = words.line("disagreement.title"),
                                 .subtitle = subtitle_of(*s.source),
                                 .panels = {panel_of(*s.source, id, s.name(), s.mean_edge * d.size)}};
    figure.range = range_from_zero(figure.panels, colormap, words.line("disagreement.quantity"), 0.001);
    add_figure(answer, std::move(figure), words.line("disagreement.caption", "mesh"_a = s.name(), "undefined"_a = undefined_words(s)));
    add_words(answer.section, words, "trust.mesh", "mesh"_a = s.name(), "rms"_a = readable_percent(d.rms, 2),
              "median"_a = readable_percent(rounded_up(d.median, 2), 2), "concentration"_a = readable_percent(d.concentration, 2),
              "without_jet"_a = d.without_jet);
}

}   // namespace meshfolio::q3_cotangent
