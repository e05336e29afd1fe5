// Diagrams as inline SVG, like the plots. Accents differ by width and shade, not by colour alone.
#include <algorithm>
#include <cmath>

#include "report/svg/svg_elements.h"
#include "report/writers.h"

namespace meshfolio::report {

namespace {

constexpr double largest_coordinate = 1e100, panel_gap = 20, highest_panel = 230, label_distance = 7, dot_radius = 3.6, line_margin = 3;
constexpr const char* accent_color = "var(--plot-1, #0b5fa5)";

bool is_shown(double x, double y) { return std::abs(x) < largest_coordinate && std::abs(y) < largest_coordinate; }   // false for NaN

/// The bounds of all boxes added.
struct Bounds {
    Box box = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    void add(const Box& b) {
        box = {std::min(box.left, b.left), std::min(box.top, b.top), std::max(box.right, b.right), std::max(box.bottom, b.bottom)};
    }
    double width() const { return std::max(box.right - box.left, 0.0); }
    double height() const { return std::max(box.bottom - box.top, 0.0); }
};

/// Returns the direction of a label from its point: −1, 0 or 1 in x to the right and y downwards.
Point direction_of(Diagram::Side side) {
    constexpr Point in_order[] = {{0, 0}, {0, -1}, {0, 1}, {-1, 0}, {1, 0}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
    return in_order[static_cast<std::size_t>(side)];
}

class DiagramPanel {
public:
    explicit DiagramPanel(const Diagram::Panel& panel) : panel_(panel) {}

    /// Chooses the largest scale at which lines and labels fit into a box of this size.
    void fit(double width, double height) {
        widest_ = width;
        double low = 1e-120, high = 1e120;
        for (int i = 0; i < 600 && high > 1.001 * low; ++i) {
            scale_ = std::sqrt(low) * std::sqrt(high);
            const Bounds bounds = bounds_of_all();
            (bounds.width() <= width && bounds.height() <= height ? low : high) = scale_;
        }
        scale_ = low > 1e119 ? 1 : low;   // a single point fits at any scale
        bounds_ = bounds_of_all();
    }

    double height() const { return bounds_.height(); }

    /// Draws the panel in the middle of `frame`.
    std::string svg(const Box& frame) {
        const Point middle{0.5 * (frame.left + frame.right), 0.5 * (frame.top + frame.bottom)};
        if (bounds_.width() <= 0) return text_element(middle, "middle", "no data");
        shift_ = {0.5 * (frame.left + frame.right - bounds_.box.left - bounds_.box.right),
                  0.5 * (frame.top + frame.bottom - bounds_.box.top - bounds_.box.bottom)};
        std::string svg;
        for (const Diagram::Path& path : panel_.paths) svg += drawn(path);
        for (const Diagram::Label& label : panel_.labels) {
            if (!label.dot || !is_shown(label.x, label.y)) continue;
            const Point p = at(label.x, label.y);
            svg += "<circle cx=\"" + px(p.x) + "\" cy=\"" + px(p.y) + "\" r=\"" + px(dot_radius) + "\" fill=\"" + fill_of(label) +
                   "\" stroke=\"var(--plot-ground, #ffffff)\" stroke-width=\"1.2\"/>\n";
        }
        for (const Diagram::Label& label : panel_.labels) svg += words(label);
        return svg;
    }

private:
    Point at(double x, double y) const { return {shift_.x + scale_ * x, shift_.y - scale_ * y}; }

    Box box_of(const Diagram::Label& label) const {
        const Point p = at(label.x, label.y), towards = direction_of(label.side);
        const double width = std::min(text_width(label.words), widest_), distance = label_distance + (label.dot ? dot_radius - 1 : 0);
        const double near = towards.x != 0 && towards.y != 0 ? 0.6 * distance : distance;   // to a corner of its box
        const double left = p.x + towards.x * near - 0.5 * (1 - towards.x) * width;
        const double top = p.y + towards.y * near - 0.5 * (1 - towards.y) * line_height;
        return {left, top, left + width, top + line_height};
    }

    Bounds bounds_of_all() const {
        Bounds bounds;
        const auto add_point = [&](double x, double y, double margin) {
            const Point p = at(x, y);
            if (is_shown(x, y)) bounds.add({p.x - margin, p.y - margin, p.x + margin, p.y + margin});
        };
        for (const Diagram::Path& path : panel_.paths)
            for (std::size_t i = 0; i < std::min(path.x.size(), path.y.size()); ++i) add_point(path.x[i], path.y[i], line_margin);
        for (const Diagram::Label& label : panel_.labels) {
            if (label.dot) add_point(label.x, label.y, dot_radius + 1);
            if (is_shown(label.x, label.y) && !label.words.empty()) bounds.add(box_of(label));
        }
        return bounds;
    }

    static std::string attributes_of(Diagram::Style style) {
        const std::string stroke = "\" fill=\"none\" stroke-linejoin=\"round\" stroke-linecap=\"round\" stroke=", accent = accent_color;
        const std::string in_order[] = {stroke + "\"currentColor\" stroke-width=\"1.5\"",
                                        stroke + "\"var(--plot-line, #6b7280)\" stroke-width=\"1\"",
                                        stroke + "\"var(--plot-line, #6b7280)\" stroke-width=\"1.3\" stroke-dasharray=\"5 4\"",
                                        "\" fill=\"currentColor\" fill-opacity=\"0.1\"",
                                        stroke + "\"" + accent + "\" stroke-width=\"2.6\"",
                                        "\" fill=\"" + accent + "\" fill-opacity=\"0.28\""};
        return in_order[static_cast<std::size_t>(style)];
    }

    std::string drawn(const Diagram::Path& path) const {
        const auto point_of = [&](std::size_t i) {
            return is_shown(path.x[i], path.y[i]) ? std::optional(at(path.x[i], path.y[i])) : std::nullopt;
        };
        const std::vector<Stretch> runs = stretches(std::min(path.x.size(), path.y.size()), point_of);
        if (runs.empty()) return "";
        std::string d;
        for (const Stretch& run : runs) d += line_data(run) + (path.closed && run.size() > 2 ? "Z" : "");
        const Stretch& last = runs.back();
        return "<path d=\"" + d + attributes_of(path.style) + "/>\n" +
               (path.arrow && last.size() > 1 ? head(last[last.size() - 2], last.back(), path.style) : "");
    }

    /// Draws the head of an arrow from `before` to `tip`.
    static std::string head(Point before, Point tip, Diagram::Style style) {
        const double length = std::hypot(tip.x - before.x, tip.y - before.y);
        if (length < 1e-3) return "";
        const Point along{(tip.x - before.x) / length, (tip.y - before.y) / length};
        const auto corner = [&](double back, double aside) {
            return px(tip.x - back * along.x - aside * along.y) + " " + px(tip.y - back * along.y + aside * along.x);
        };
        const std::string color = style == Diagram::Style::accent ? accent_color : "currentColor";
        return "<path d=\"M" + corner(-2, 0) + "L" + corner(8, 4) + "L" + corner(8, -4) + "Z\" fill=\"" + color + "\"/>\n";
    }

    static std::string fill_of(const Diagram::Label& label) { return label.accent ? accent_color : "currentColor"; }

    std::string words(const Diagram::Label& label) const {
        if (label.words.empty() || !is_shown(label.x, label.y)) return "";
        const Box box = box_of(label);
        const double aside = direction_of(label.side).x;
        const char* anchor = aside < 0 ? "end" : aside > 0 ? "start" : "middle";
        return text_element({0.5 * ((1 - aside) * box.right + (1 + aside) * box.left), box.bottom - 4.5}, anchor, label.words,
                            " fill=\"" + fill_of(label) + "\" paint-order=\"stroke\" stroke=\"var(--plot-ground, #ffffff)\" " +
                                "stroke-width=\"3\" stroke-linejoin=\"round\"");
    }

    const Diagram::Panel& panel_;
    double scale_ = 1, widest_ = 0;
    Point shift_;
    Bounds bounds_;
};

}   // namespace

std::string svg_of(const Diagram& diagram) {
    const auto count = static_cast<double>(std::max<std::size_t>(diagram.panels.size(), 1));
    const double width = (drawing_width - panel_gap * (count - 1)) / count;
    std::vector<DiagramPanel> panels;
    double title_rows = 0, height = 0;
    for (const Diagram::Panel& panel : diagram.panels) {
        panels.emplace_back(panel).fit(width, highest_panel);
        height = std::max(height, panels.back().height());
        if (!panel.title.empty()) title_rows = std::max(title_rows, title_lines(panel.title, width));
    }
    const double top = 4 + title_rows * line_height + (title_rows > 0 ? 4 : 0), bottom = top + std::max(height, line_height);
    std::string subject, body;
    for (std::size_t i = 0; i < panels.size(); ++i) {
        const double left = double(i) * (width + panel_gap);
        const std::string& title = diagram.panels[i].title;
        subject += (subject.empty() || title.empty() ? "" : ", ") + title;
        Point above{left + 0.5 * width, line_height - 0.5};
        if (!title.empty()) body += title_element(above, "middle", title, width);
        body += panels[i].svg({left, top, left + width, bottom});
    }
    return svg_head(diagram.id, subject.empty() ? "Diagram" : subject, diagram.alt, drawing_width, bottom + 4) + body + "</svg>\n";
}

}   // namespace meshfolio::report
