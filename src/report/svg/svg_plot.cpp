// Plots as inline SVG. Dashes and shapes of points distinguish the series without colour.
#include <algorithm>
#include <cmath>

#include "report/escape.h"
#include "report/svg/plot_axis.h"
#include "report/svg/plot_labels.h"
#include "report/svg/svg_elements.h"
#include "report/writers.h"

namespace meshfolio::report {

namespace {

constexpr double plot_height = 290, right_margin = 18;

/// Points of a curve without a gap.
using Stretch = std::vector<Point>;

class PlotDrawing {
public:
    explicit PlotDrawing(const Plot& plot) : plot_(plot), x_(x_values(plot), plot.log_x), y_(y_values(plot), plot.log_y) {
        frame_.left = std::ceil(widest_label(y_)) + tick_length + 10;
        frame_.right = drawing_width - right_margin;
        place_legend();
        frame_.top = legend_bottom_ + line_height * title_lines(plot.y_label) + 10;
        frame_.bottom = frame_.top + plot_height;
    }

    std::string svg() {
        std::string body = legend_ + axis_titles() + grid();
        if (is_empty()) {
            return head() + body +
                   text_element({0.5 * (frame_.left + frame_.right), 0.5 * (frame_.top + frame_.bottom)}, "middle", "no data") + "</svg>\n";
        }
        for (std::size_t i = 0; i < plot_.series.size(); ++i) body += band(i);
        body += vertical_lines();
        for (std::size_t i = 0; i < plot_.series.size(); ++i) body += curve(i);
        return head() + body + labels() + "</svg>\n";
    }

private:
    static std::vector<double> x_values(const Plot& plot) {
        std::vector<double> values;
        for (const Series& s : plot.series) values.insert(values.end(), s.x.begin(), s.x.end());
        for (const Marker& m : plot.markers) values.push_back(m.x);
        for (const auto& line : plot.vertical_lines) values.push_back(line.x);
        return values;
    }

    static std::vector<double> y_values(const Plot& plot) {
        std::vector<double> values;
        for (const Series& s : plot.series) {
            for (const auto* part : {&s.y, &s.y_low, &s.y_high}) values.insert(values.end(), part->begin(), part->end());
        }
        for (const Marker& m : plot.markers) values.push_back(m.y);
        return values;
    }

    bool shows(double x, double y) const { return x_.shows(x) && y_.shows(y); }
    Point at(double x, double y) const {
        return {frame_.left + x_.position(x) * (frame_.right - frame_.left), frame_.bottom - y_.position(y) * (frame_.bottom - frame_.top)};
    }
    double at_x(double x) const { return frame_.left + x_.position(x) * (frame_.right - frame_.left); }

    /// The points of a series, broken where a value is undefined or the axis cannot show it.
    std::vector<Stretch> runs_of(const Series& series, const std::vector<double>& y) const {
        std::vector<Stretch> runs(1);
        for (std::size_t i = 0; i < std::min(series.x.size(), y.size()); ++i) {
            if (shows(series.x[i], y[i])) {
                runs.back().push_back(at(series.x[i], y[i]));
            } else if (!runs.back().empty()) {
                runs.emplace_back();
            }
        }
        if (runs.back().empty()) runs.pop_back();
        return runs;
    }

    bool is_empty() const {
        const auto none = [&](const Series& s) { return runs_of(s, s.y).empty(); };
        return std::all_of(plot_.series.begin(), plot_.series.end(), none) && plot_.markers.empty() && plot_.vertical_lines.empty();
    }

    std::string head() const { return svg_head(plot_.id, plot_.y_label + " against " + plot_.x_label, plot_.alt, drawing_width, height()); }

    double height() const { return frame_.bottom + 24 + line_height * title_lines(plot_.x_label) + 4; }

    /// Names of the series with a sample of each, in rows above the plot.
    void place_legend() {
        double x = 4, y = 14;
        for (std::size_t i = 0; i < plot_.series.size(); ++i) {
            const Series& series = plot_.series[i];
            if (series.name.empty()) continue;
            const auto lines = wrapped(safe_text(series.name), drawing_width - 60);
            double widest = 0;
            for (const std::string& line : lines) widest = std::max(widest, text_width(line));
            if (x > 4 && x + 36 + widest > drawing_width) {
                x = 4;
                y += line_height + 2;
            }
            legend_ += sample(i, {x, y - 4.5});
            for (std::size_t k = 0; k < lines.size(); ++k) {
                if (k > 0) y += line_height;
                legend_ += text_element({x + 34, y}, "start", lines[k]);
            }
            x += 34 + widest + 20;
            legend_bottom_ = y + 8;
        }
    }

    std::string sample(std::size_t i, Point left) const {
        const Look look = look_of(plot_.series[i], i);
        return (look.has_line ? line_element(left, {left.x + 28, left.y}, stroke(look)) : "") +
               (look.has_points ? point_shape({left.x + 14, left.y}, look.pattern, look.color) : "");
    }

    static std::string stroke(const Look& look) {
        const std::string dash = look.dashes.empty() ? "" : " stroke-dasharray=\"" + look.dashes + "\"";
        return "fill=\"none\" stroke=\"" + look.color + "\" stroke-width=\"2\" stroke-linejoin=\"round\"" + dash;
    }

    std::string axis_titles() const {
        Point above{4, legend_bottom_ + line_height - 3};
        Point below{0.5 * (frame_.left + frame_.right), frame_.bottom + 24 + line_height - 4};
        return title_element(above, "start", plot_.y_label) + title_element(below, "middle", plot_.x_label);
    }

    std::string grid() const {
        const std::string faint = "stroke=\"var(--plot-grid, #d9dce1)\" stroke-width=\"1\"";
        std::string svg;
        for (const Tick& tick : y_.ticks()) {
            const double y = frame_.bottom - y_.position(tick.value) * plot_height;
            if (tick.label.empty()) {
                svg += line_element({frame_.left - 3, y}, {frame_.left, y}, firm);
                continue;
            }
            svg += line_element({frame_.left, y}, {frame_.right, y}, faint);
            svg += text_element({frame_.left - tick_length - 3, y + 0.35 * font_size}, "end", tick.label);
        }
        svg += ticks_below(x_, frame_);
        return svg + line_element({frame_.left, frame_.bottom}, {frame_.right, frame_.bottom}, firm) +
               line_element({frame_.left, frame_.top}, {frame_.left, frame_.bottom}, firm);
    }

    std::string band(std::size_t i) const {
        const Series& series = plot_.series[i];
        std::string path;
        Stretch lower, upper;
        const auto close = [&] {
            for (std::size_t k = 0; k < upper.size(); ++k) path += (k == 0 ? "M" : "L") + px(upper[k].x) + " " + px(upper[k].y);
            for (auto p = lower.rbegin(); p != lower.rend(); ++p) path += "L" + px(p->x) + " " + px(p->y);
            if (!upper.empty()) path += "Z";
            lower.clear();
            upper.clear();
        };
        for (std::size_t k = 0; k < std::min({series.x.size(), series.y_low.size(), series.y_high.size()}); ++k) {
            const bool shown = shows(series.x[k], series.y_low[k]) && shows(series.x[k], series.y_high[k]);
            if (!shown) {
                close();
                continue;
            }
            lower.push_back(at(series.x[k], series.y_low[k]));
            upper.push_back(at(series.x[k], series.y_high[k]));
        }
        close();
        return path.empty() ? "" : "<path d=\"" + path + "\" fill=\"" + look_of(series, i).color + "\" opacity=\"0.18\"/>\n";
    }

    std::string curve(std::size_t i) const {
        const Series& series = plot_.series[i];
        const Look look = look_of(series, i);
        std::string path, points;
        std::size_t count = 0;
        const auto runs = runs_of(series, series.y);
        for (const Stretch& run : runs) count += run.size();
        const std::size_t stride = series.style == Series::Style::line_and_points ? 1 + count / 40 : 1;
        std::size_t index = 0;
        for (const Stretch& run : runs) {
            for (std::size_t k = 0; look.has_line && run.size() > 1 && k < run.size(); ++k) {
                path += (k == 0 ? "M" : "L") + px(run[k].x) + " " + px(run[k].y);
            }
            // A value between two gaps would leave no trace in a line.
            const bool all = look.has_points || run.size() == 1;
            for (const Point& p : run) {
                if (all && index++ % stride == 0) points += point_shape(p, look.pattern, look.color);
            }
        }
        return (path.empty() ? "" : "<path d=\"" + path + "\" " + stroke(look) + "/>\n") + points;
    }

    std::string vertical_lines() const {
        std::string svg;
        for (const auto& line : plot_.vertical_lines) {
            if (!x_.shows(line.x)) continue;
            svg += line_element({at_x(line.x), frame_.top}, {at_x(line.x), frame_.bottom},
                                "stroke=\"var(--plot-line, #6b7280)\" stroke-width=\"1.4\" stroke-dasharray=\"3 3\"");
        }
        return svg;
    }

    /// Points along all curves and lines, for the labels to keep clear of.
    std::vector<Point> data_points() const {
        std::vector<Point> points;
        for (const Series& series : plot_.series) {
            for (const Stretch& run : runs_of(series, series.y)) {
                for (std::size_t k = 0; k < run.size(); ++k) {
                    points.push_back(run[k]);
                    if (k == 0 || series.style == Series::Style::points) continue;
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

    std::string labels() const {
        const std::string halo =
            " font-size=\"12\" paint-order=\"stroke\" stroke=\"var(--plot-ground, #ffffff)\" stroke-width=\"3.5\" "
            "stroke-linejoin=\"round\"";
        LabelPlacer placer(frame_, data_points());
        std::string rings, svg;
        for (const Marker& m : plot_.markers) {
            if (!shows(m.x, m.y)) continue;
            const Point p = at(m.x, m.y);
            placer.block({p.x - 6, p.y - 6, p.x + 6, p.y + 6});
            rings += "<circle cx=\"" + px(p.x) + "\" cy=\"" + px(p.y) +
                     "\" r=\"5.5\" fill=\"none\" stroke=\"currentColor\" stroke-width=\"1.6\"/>\n";
        }
        for (const auto& line : plot_.vertical_lines) {
            if (!x_.shows(line.x) || line.label.empty()) continue;
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
        for (const Marker& m : plot_.markers) {
            if (!shows(m.x, m.y) || m.label.empty()) continue;
            const Point p = at(m.x, m.y);
            const Box box = placer.place(around(p, text_width(m.label), line_height));
            svg += leader(p, box) + text_element({box.left, box.bottom - 5}, "start", m.label, halo);
        }
        return rings + svg;
    }

    /// A thin line from a marker to its label when that is not right beside it.
    static std::string leader(Point p, const Box& box) {
        const Point end{std::clamp(p.x, box.left, box.right), std::clamp(p.y, box.top, box.bottom)};
        const double distance = std::hypot(end.x - p.x, end.y - p.y);
        if (distance < 16) return "";
        const Point start{p.x + (end.x - p.x) * 6 / distance, p.y + (end.y - p.y) * 6 / distance};
        return line_element(start, end, "stroke=\"var(--plot-line, #6b7280)\" stroke-width=\"1\"");
    }

    const Plot& plot_;
    Axis x_, y_;
    Box frame_;
    double legend_bottom_ = 0;
    std::string legend_;
};

}   // namespace

std::string svg_of(const Plot& plot) { return PlotDrawing(plot).svg(); }

std::string svg_file_of(const Plot& plot) { return svg_on_white(svg_of(plot)); }

}   // namespace meshfolio::report
