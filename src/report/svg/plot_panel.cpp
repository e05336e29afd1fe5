#include "report/svg/plot_panel.h"

#include <algorithm>
#include <cmath>

#include "report/escape.h"

namespace meshfolio::report {

namespace {

constexpr const char* halo =
    " font-size=\"12\" paint-order=\"stroke\" stroke=\"var(--plot-ground, #ffffff)\" stroke-width=\"3.5\" stroke-linejoin=\"round\"";

std::string stroke_of(const Look& look) {
    const std::string dash = look.dashes.empty() ? "" : " stroke-dasharray=\"" + look.dashes + "\"";
    return "fill=\"none\" stroke=\"" + look.color + "\" stroke-width=\"2\" stroke-linejoin=\"round\"" + dash;
}

/// Returns a thin line from a marker to its label; empty if they are next to each other.
std::string leader(Point p, const Box& box) {
    const Point end{std::clamp(p.x, box.left, box.right), std::clamp(p.y, box.top, box.bottom)};
    const double distance = std::hypot(end.x - p.x, end.y - p.y);
    if (distance < 16) return "";
    const Point start{p.x + (end.x - p.x) * 6 / distance, p.y + (end.y - p.y) * 6 / distance};
    return line_element(start, end, "stroke=\"var(--plot-line, #6b7280)\" stroke-width=\"1\"");
}

}   // namespace

std::vector<std::string> panel_names(const Plot& plot) {
    std::vector<std::string> names;
    for (const Series& series : plot.series)
        if (std::find(names.begin(), names.end(), series.panel) == names.end()) names.push_back(series.panel);
    return names.empty() ? std::vector<std::string>{""} : names;
}

std::string curve_sample(const Look& look, Point left, double width) {
    return (look.has_line ? line_element(left, {left.x + width, left.y}, stroke_of(look)) : "") +
           (look.has_points ? point_shape({left.x + 0.5 * width, left.y}, look.pattern, look.color) : "");
}

PlotPanel::PlotPanel(const Plot& plot, std::string name, const Axis& x, const Axis& y) : plot_(plot), name_(std::move(name)), x_(x), y_(y) {
    std::vector<std::string> names;   // of all panels: a name has one look
    for (std::size_t i = 0; i < plot.series.size(); ++i) {
        const Series& series = plot.series[i];
        const bool is_known = !series.panel.empty() && std::find(names.begin(), names.end(), series.name) != names.end();
        if (!is_known) names.push_back(series.name);
        const auto place = is_known ? std::find(names.begin(), names.end(), series.name) - names.begin() : std::ssize(names) - 1;
        if (series.panel == name_) curves_.push_back({&series, look_of(series, static_cast<std::size_t>(place))});
    }
}

std::string PlotPanel::svg(bool with_y_numbers, bool with_line_labels) const {
    std::string svg = grid(with_y_numbers);
    const auto has_no_point = [&](const PlotCurve& curve) { return runs_of(*curve.series).empty(); };
    if (std::ranges::all_of(curves_, has_no_point) && markers().empty() && plot_.vertical_lines.empty())
        return svg + text_element({0.5 * (frame_.left + frame_.right), 0.5 * (frame_.top + frame_.bottom)}, "middle", "no data");
    for (const PlotCurve& curve : curves_) svg += band(curve);
    for (const auto& line : plot_.vertical_lines) {
        if (!x_.shows(line.x)) continue;
        svg += line_element({at_x(line.x), frame_.top}, {at_x(line.x), frame_.bottom},
                            "stroke=\"var(--plot-line, #6b7280)\" stroke-width=\"1.4\" stroke-dasharray=\"3 3\"");
    }
    for (const bool lines : {false, true})   // over the points
        for (const PlotCurve& curve : curves_) svg += curve.look.has_line == lines ? drawn(curve) : "";
    return svg + labels(with_line_labels);
}

std::vector<Stretch> PlotPanel::runs_of(const Series& series) const {
    return stretches(std::min(series.x.size(), series.y.size()), [&](std::size_t i) {
        return shows(series.x[i], series.y[i]) ? std::optional(at(series.x[i], series.y[i])) : std::nullopt;
    });
}

std::vector<Marker> PlotPanel::markers() const {
    std::vector<Marker> markers;
    for (const Marker& marker : plot_.markers)
        if (marker.panel == name_ && shows(marker.x, marker.y)) markers.push_back(marker);
    return markers;
}

bool PlotPanel::has_end(const PlotCurve& curve) const {
    const Series& series = *curve.series;
    return (curve.look.has_line || std::is_sorted(series.x.begin(), series.x.end())) && !runs_of(series).empty();
}

std::optional<Point> PlotPanel::end_of(const PlotCurve& curve) const {
    if (curve.series->name.empty() || !has_end(curve)) return {};
    // A curve may run to the left: its name stands at the end farther to the right.
    std::optional<Point> end;
    for (const Stretch& run : runs_of(*curve.series)) {
        for (const Point& p : {run.front(), run.back()})
            if (!end || p.x >= end->x) end = p;
    }
    return end;
}

double PlotPanel::height_of_names(double width) const {
    double height = 0;
    for (const PlotCurve& curve : curves_)
        if (end_of(curve)) height += EndName{{}, wrapped(safe_text(curve.series->name), width), "", ""}.height();
    return height;
}

std::string PlotPanel::end_names(double width) const {
    std::vector<EndName> beside;
    std::string inside;
    LabelPlacer placer(frame_, data_points());
    for (const PlotCurve& curve : curves_) {
        const std::optional<Point> end = end_of(curve);
        if (!end) continue;
        const std::string name = safe_text(curve.series->name);
        const bool ends_early = end->x < frame_.right - 0.3 * (frame_.right - frame_.left);
        if (!ends_early) {
            beside.push_back({*end, wrapped(name, width), curve_sample(curve.look, {0, 0}, end_sample_width), curve.look.color});
            continue;
        }
        const Box box = placer.place(around(*end, text_width(name), line_height));
        inside +=
            leader(*end, box) + text_element({box.left, box.bottom - 5}, "start", name, halo + (" fill=\"" + curve.look.color + "\""));
    }
    return inside + drawn_names(beside, frame_.right, frame_.top - 6, frame_.bottom + 10);
}

std::string PlotPanel::grid(bool with_numbers) const {
    const std::string faint = "stroke=\"var(--plot-grid, #d9dce1)\" stroke-width=\"1\"";
    std::string svg;
    for (const Tick& tick : y_.ticks()) {
        const double y = at_y(tick.value);
        if (tick.label.empty()) {
            if (with_numbers) svg += line_element({frame_.left - 3, y}, {frame_.left, y}, firm);
            continue;
        }
        svg += line_element({frame_.left, y}, {frame_.right, y}, faint);
        if (with_numbers) svg += text_element({frame_.left - tick_length - 3, y + 0.35 * font_size}, "end", tick.label);
    }
    svg += ticks_below(x_, frame_) + line_element({frame_.left, frame_.bottom}, {frame_.right, frame_.bottom}, firm) +
           line_element({frame_.left, frame_.top}, {frame_.left, frame_.bottom}, firm);
    if (!x_.zero_apart()) return svg;
    // Two strokes across the axis, between its zero and its logarithmic part.
    const double x = frame_.left + 0.5 * Axis::zero_share * (frame_.right - frame_.left) + 2;
    return svg + "<path d=\"M" + px(x - 3) + " " + px(frame_.bottom) + "H" + px(x + 3) +
           "\" stroke=\"var(--plot-ground, #ffffff)\" stroke-width=\"3\"/>\n" +
           line_element({x - 5, frame_.bottom + 4}, {x - 1, frame_.bottom - 4}, firm) +
           line_element({x + 1, frame_.bottom + 4}, {x + 5, frame_.bottom - 4}, firm);
}

std::string PlotPanel::band(const PlotCurve& curve) const {
    const Series& s = *curve.series;
    const auto edge = [&](const std::vector<double>& y) {
        return stretches(std::min({s.x.size(), s.y_low.size(), s.y_high.size()}), [&](std::size_t i) {
            const bool shown = shows(s.x[i], s.y_low[i]) && shows(s.x[i], s.y_high[i]);
            return shown ? std::optional(at(s.x[i], y[i])) : std::nullopt;
        });
    };
    const std::vector<Stretch> upper = edge(s.y_high), lower = edge(s.y_low);
    std::string path;
    for (std::size_t i = 0; i < upper.size(); ++i) {
        path += line_data(upper[i]);
        for (auto p = lower[i].rbegin(); p != lower[i].rend(); ++p) path += "L" + px(p->x) + " " + px(p->y);
        path += "Z";
    }
    return path.empty() ? "" : "<path d=\"" + path + "\" fill=\"" + curve.look.color + "\" opacity=\"0.18\"/>\n";
}

std::string PlotPanel::drawn(const PlotCurve& curve) const {
    const Look& look = curve.look;
    std::string path, points;
    const double least = look.has_line ? 16 : 0;   // [pixels] between points, so that they do not hide their line
    const double size = !look.has_line && curve.series->x.size() > 60 ? 0.6 : 1;   // of a cloud of points
    Point last{-1e9, 0};
    for (const Stretch& run : runs_of(*curve.series)) {
        if (look.has_line && run.size() > 1) path += line_data(run);
        // A value between two gaps leaves no trace in a line.
        const bool all = look.has_points || run.size() == 1;
        for (const Point& p : run)
            if (all && std::hypot(p.x - last.x, p.y - last.y) >= least) points += point_shape(last = p, look.pattern, look.color, size);
    }
    return (path.empty() ? "" : "<path d=\"" + path + "\" " + stroke_of(look) + "/>\n") + points;
}

std::vector<Point> PlotPanel::data_points() const {
    std::vector<Point> points;
    for (const PlotCurve& curve : curves_) {
        for (const Stretch& run : runs_of(*curve.series)) {
            for (std::size_t k = 0; k < run.size(); ++k) {
                points.push_back(run[k]);
                if (k == 0 || !curve.look.has_line) continue;
                const Point a = run[k - 1], b = run[k];
                const int steps = static_cast<int>(std::hypot(b.x - a.x, b.y - a.y) / 6);
                for (int s = 1; s < steps; ++s) points.push_back({a.x + (b.x - a.x) * s / steps, a.y + (b.y - a.y) * s / steps});
            }
        }
    }
    for (const auto& line : plot_.vertical_lines) {
        if (!x_.shows(line.x)) continue;
        for (int i = 0; frame_.top + 6 * i < frame_.bottom; ++i) points.push_back({at_x(line.x), frame_.top + 6 * i});
    }
    return points;
}

std::string PlotPanel::labels(bool of_lines) const {
    LabelPlacer placer(frame_, data_points());
    std::string rings, svg;
    const std::vector<Marker> marked = markers();
    for (const Marker& m : marked) {
        const Point p = at(m.x, m.y);
        placer.block({p.x - 6, p.y - 6, p.x + 6, p.y + 6});
        rings += "<circle cx=\"" + px(p.x) + "\" cy=\"" + px(p.y) +
                 "\" r=\"5.5\" fill=\"none\" stroke=\"currentColor\" stroke-width=\"1.6\"/>\n";
    }
    for (const auto& line : plot_.vertical_lines) {
        if (!of_lines || !x_.shows(line.x) || line.label.empty()) continue;
        const double w = text_width(line.label), x = at_x(line.x);
        std::vector<Box> boxes;
        for (int row = 0; frame_.top + 2 + (row + 1) * line_height < frame_.bottom; ++row) {
            const double y = frame_.top + 2 + row * line_height;
            boxes.push_back({x + 6, y, x + 6 + w, y + line_height});
            boxes.push_back({x - 6 - w, y, x - 6, y + line_height});
        }
        const Box box = placer.place(boxes);
        svg += text_element({box.left, box.bottom - 5}, "start", line.label, halo);
    }
    for (const Marker& m : marked) {
        if (m.label.empty()) continue;
        const Point p = at(m.x, m.y);
        const Box box = placer.place(around(p, text_width(m.label), line_height));
        svg += leader(p, box) + text_element({box.left, box.bottom - 5}, "start", m.label, halo);
    }
    return rings + svg;
}

}   // namespace meshfolio::report
