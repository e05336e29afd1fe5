// Maps as inline SVG, like the plots. The cells keep their colours on any page; lines over them are black with a white casing, which is
// readable on every colour, in the dark and in grey.
#include <algorithm>
#include <cmath>

#include "report/escape.h"
#include "report/svg/map_scale.h"
#include "report/svg/plot_axis.h"
#include "report/svg/svg_elements.h"
#include "report/writers.h"

namespace meshfolio::report {

namespace {

constexpr double panel_height = 200, gap = 22, bar_width = 13;

/// Returns an axis of the cells, without a margin.
Axis axis_of(const std::vector<double>& edges, bool logarithmic) {
    return edges.empty() ? Axis({}, logarithmic) : Axis::exactly(edges.front(), edges.back(), logarithmic);
}

class MapDrawing {
public:
    explicit MapDrawing(const Map& map)
        : map_(map),
          scale_(map),
          x_edges_(cell_edges(map.x, map.log_x)),
          y_edges_(cell_edges(map.y, map.log_y)),
          x_(axis_of(x_edges_, map.log_x)),
          y_(axis_of(y_edges_, map.log_y)),
          values_(Axis::exactly(scale_.low(), scale_.high(), map.log_values)) {
        place_legend();
        Point above{4, legend_.bottom() + line_height - 3};
        // The titles of the colour bar and of the y axis share a line if there is room.
        const std::string colour = "colour: " + map.value_label;
        Point over_bar{drawing_width - 4, above.y};
        const bool one_line = text_width(colour) + text_width(map.y_label) + 40 < drawing_width;
        titles_ = one_line ? title_element(over_bar, "end", colour) : title_element(above, "start", colour);
        titles_ += title_element(above, "start", map.y_label);
        const bool titled = std::ranges::any_of(map.panels, [](const Map::Panel& panel) { return !panel.title.empty(); });
        top_ = above.y + 4 + (titled ? 7 : 0);   // between titles of panels and of axes
        bottom_ = top_ + panel_height;
        const double bar = bar_width + std::ceil(widest_label(values_)) + tick_length + 10;
        first_left_ = std::ceil(widest_label(y_)) + tick_length + 10;
        const auto count = static_cast<double>(std::max<std::size_t>(map.panels.size(), 1));
        panel_width_ = (drawing_width - first_left_ - bar - gap * count) / count;
        last_right_ = first_left_ + count * panel_width_ + (count - 1) * gap;
    }

    std::string svg() const {
        std::string body = hatching() + legend_.svg() + titles_;
        for (std::size_t p = 0; p < map_.panels.size(); ++p) body += panel(p);
        Point below{0.5 * (first_left_ + last_right_), bottom_ + 24 + line_height - 4};
        const std::string x_title = title_element(below, "middle", map_.x_label);
        const double height = bottom_ + 24 + line_height * title_lines(map_.x_label) + 4;
        return svg_head(map_.id, map_.value_label + " over " + map_.x_label + " and " + map_.y_label, map_.alt, drawing_width, height) +
               body + (map_.panels.empty() ? "" : ticks_beside(y_, frame_of(0))) + x_title + color_bar() + "</svg>\n";
    }

private:
    Box frame_of(std::size_t p) const {
        const double left = first_left_ + double(p) * (panel_width_ + gap);
        return {left, top_, left + panel_width_, bottom_};
    }

    bool shows(double x, double y) const {
        return x_.shows(x) && y_.shows(y) && x >= x_.low() && x <= x_.high() && y >= y_.low() && y <= y_.high();
    }
    Point at(const Box& frame, double x, double y) const {
        return {frame.left + x_.position(x) * (frame.right - frame.left), frame.bottom - y_.position(y) * (frame.bottom - frame.top)};
    }
    Box cell(const Box& frame, std::size_t column, std::size_t row) const {
        const Point low = at(frame, x_edges_[column], y_edges_[row]), high = at(frame, x_edges_[column + 1], y_edges_[row + 1]);
        return {low.x, high.y, high.x, low.y};
    }

    /// Returns the band of a cell; −1 if it is undefined.
    int band_of(const Map::Panel& panel, std::size_t column, std::size_t row) const {
        const std::size_t i = row * map_.x.size() + column;
        const double value = i < panel.values.size() ? panel.values[i] : std::nan("");
        return std::isfinite(value) ? scale_.band(value) : -1;
    }
    bool any_undefined() const {
        const auto undefined = [](double x) { return !std::isfinite(x); };
        return std::ranges::any_of(map_.panels, [&](const Map::Panel& p) {
            return p.values.size() < map_.x.size() * map_.y.size() || std::ranges::any_of(p.values, undefined);
        });
    }

    std::string hatch_name() const { return xml_escape(url_path(safe_text(map_.id))) + "-hatch"; }
    std::string hatching() const {
        if (!any_undefined()) return "";
        return "<defs><pattern id=\"" + hatch_name() + "\" width=\"7\" height=\"7\" patternUnits=\"userSpaceOnUse\" " +
               "patternTransform=\"rotate(45)\"><rect width=\"7\" height=\"7\" fill=\"var(--plot-grid, #d9dce1)\"/>" +
               "<rect width=\"1.6\" height=\"7\" fill=\"var(--plot-line, #6b7280)\"/></pattern></defs>\n";
    }
    std::string hatched() const { return "fill=\"url(#" + hatch_name() + ")\""; }

    /// Draws the cells. Neighbours of one band are one rectangle, and each band is one path, so that fine grids stay small.
    std::string cells(const Map::Panel& panel, const Box& frame) const {
        std::vector<std::string> paths(MapScale::bands + 1);
        const std::size_t columns = map_.x.size(), rows = map_.y.size();
        for (std::size_t row = 0; row < rows; ++row) {
            for (std::size_t first = 0, end; first < columns; first = end) {
                const int band = band_of(panel, first, row), path = 1 + band;   // the first: undefined
                for (end = first + 1; end < columns && band_of(panel, end, row) == band;) ++end;
                const Box a = cell(frame, first, row), b = cell(frame, end - 1, row);
                paths[static_cast<std::size_t>(path)] +=
                    "M" + px(a.left) + " " + px(a.top) + "H" + px(b.right) + "V" + px(a.bottom) + "H" + px(a.left) + "Z";
            }
        }
        std::string svg = "<g shape-rendering=\"crispEdges\">\n";
        for (std::size_t i = 0; i < paths.size(); ++i) {
            if (paths[i].empty()) continue;
            const std::string fill = i == 0 ? hatched() : "fill=\"" + scale_.color(static_cast<int>(i) - 1) + "\"";
            svg += "<path d=\"" + paths[i] + "\" " + fill + "/>\n";
        }
        return svg + "</g>\n";
    }

    /// Draws the edges of cells between which a diverging map passes its middle.
    std::string middle_line(const Map::Panel& panel, const Box& frame) const {
        if (map_.colours != Map::Colours::diverging) return "";
        const int half = MapScale::bands / 2;
        std::string path;
        for (std::size_t row = 0; row < map_.y.size(); ++row) {
            for (std::size_t column = 0; column < map_.x.size(); ++column) {
                const int band = band_of(panel, column, row);
                if (band < 0) continue;
                const Box box = cell(frame, column, row);
                const auto crosses = [&](int other) { return other >= 0 && (other < half) != (band < half); };
                if (column + 1 < map_.x.size() && crosses(band_of(panel, column + 1, row)))
                    path += "M" + px(box.right) + " " + px(box.top) + "V" + px(box.bottom);
                if (row + 1 < map_.y.size() && crosses(band_of(panel, column, row + 1)))
                    path += "M" + px(box.left) + " " + px(box.top) + "H" + px(box.right);
            }
        }
        return path.empty() ? "" : "<path d=\"" + path + "\" fill=\"none\" stroke=\"#1b1b1f\" stroke-width=\"0.9\"/>\n";
    }

    static std::string cased(const std::string& path, const std::string& dashes) {
        const std::string line = "<path d=\"" + path + "\" fill=\"none\" stroke-linejoin=\"round\" stroke=";
        return line + "\"#ffffff\" stroke-width=\"4.6\" opacity=\"0.85\"/>\n" + line + "\"#1b1b1f\" stroke-width=\"2\"" +
               (dashes.empty() ? "" : " stroke-dasharray=\"" + dashes + "\"") + "/>\n";
    }
    static std::string cased_point(Point p, const Look& look) {
        return "<circle cx=\"" + px(p.x) + "\" cy=\"" + px(p.y) + "\" r=\"5.4\" fill=\"#ffffff\"/>\n" +
               point_shape(p, look.pattern, "#1b1b1f");
    }
    std::string line(const Series& series, std::size_t index, const Box& frame) const {
        const Look look = look_of(series, index);
        std::string path, points;
        const auto point_of = [&](std::size_t i) {
            return shows(series.x[i], series.y[i]) ? std::optional(at(frame, series.x[i], series.y[i])) : std::nullopt;
        };
        for (const Stretch& run : stretches(std::min(series.x.size(), series.y.size()), point_of)) {
            path += line_data(run);
            for (const Point& p : run) points += look.has_points ? cased_point(p, look) : "";
        }
        return (path.empty() || !look.has_line ? "" : cased(path, look.dashes)) + points;
    }

    /// Draws the labels of markers in discs.
    std::string letters(const Map::Panel& panel, const Box& frame) const {
        std::string svg;
        for (const Marker& marker : panel.markers) {
            if (!shows(marker.x, marker.y)) continue;
            const Point at_cell = at(frame, marker.x, marker.y);
            const Point p{std::clamp(at_cell.x, frame.left + 9, frame.right - 9), std::clamp(at_cell.y, frame.top + 9, frame.bottom - 9)};
            svg += "<circle cx=\"" + px(p.x) + "\" cy=\"" + px(p.y) +
                   "\" r=\"8.2\" fill=\"#ffffff\" stroke=\"#1b1b1f\" stroke-width=\"1.2\"/>\n";
            svg += text_element({p.x, p.y + 4}, "middle", marker.label, " font-size=\"12\" font-weight=\"700\" fill=\"#1b1b1f\"");
        }
        return svg;
    }

    std::string panel(std::size_t p) const {
        const Map::Panel& panel = map_.panels[p];
        const Box frame = frame_of(p);
        const Point middle{0.5 * (frame.left + frame.right), 0.5 * (frame.top + frame.bottom)};
        std::string svg;
        if (x_edges_.empty() || y_edges_.empty()) {
            svg = text_element(middle, "middle", "no data");
        } else {
            svg = cells(panel, frame) + middle_line(panel, frame);
            for (std::size_t i = 0; i < panel.lines.size(); ++i) svg += line(panel.lines[i], i, frame);
            svg += letters(panel, frame);
        }
        return svg + rectangle_element(frame, "fill=\"none\" stroke=\"currentColor\" stroke-width=\"1\"") + ticks_below(x_, frame) +
               (panel.title.empty() ? "" : text_element({middle.x, top_ - 7}, "middle", panel.title, " font-weight=\"600\""));
    }

    /// Places the names of the lines and of the hatching above the panels.
    void place_legend() {
        for (const Map::Panel& panel : map_.panels) {
            for (std::size_t i = 0; i < panel.lines.size(); ++i) {
                const Look look = look_of(panel.lines[i], i);
                legend_.add(panel.lines[i].name, [&](Point left) {
                    const std::string path = "M" + px(left.x) + " " + px(left.y) + "H" + px(left.x + NameRows::sample_width);
                    return (look.has_line ? cased(path, look.dashes) : "") +
                           (look.has_points ? cased_point({left.x + 0.5 * NameRows::sample_width, left.y}, look) : "");
                });
            }
        }
        if (!any_undefined()) return;
        legend_.add(map_.undefined, [&](Point left) {
            return rectangle_element({left.x, left.y - 6, left.x + NameRows::sample_width, left.y + 6}, hatched());
        });
    }

    /// Draws the colour bar, with a tip at each end that values exceed.
    std::string color_bar() const {
        const Box bar{last_right_ + gap, top_, last_right_ + gap + bar_width, bottom_};
        const double middle = 0.5 * (bar.left + bar.right), band_height = panel_height / MapScale::bands;
        std::string svg = "<g shape-rendering=\"crispEdges\">\n";
        for (int band = 0; band < MapScale::bands; ++band) {
            const double bottom = bar.bottom - band * band_height;
            svg += rectangle_element({bar.left, bottom - band_height, bar.right, bottom}, "fill=\"" + scale_.color(band) + "\"");
        }
        svg += "</g>\n";
        const auto tip = [&](double y, double towards, int band) {
            svg += "<path d=\"M" + px(bar.left) + " " + px(y) + "L" + px(middle) + " " + px(y + towards) + "L" + px(bar.right) + " " +
                   px(y) + "Z\" fill=\"" + scale_.color(band) + "\"/>\n";
        };
        if (scale_.clips_above()) tip(bar.top, -8, MapScale::bands - 1);
        if (scale_.clips_below()) tip(bar.bottom, 8, 0);
        return svg + rectangle_element(bar, "fill=\"none\" stroke=\"currentColor\" stroke-width=\"1\"") + ticks_beside(values_, bar, true);
    }

    const Map& map_;
    MapScale scale_;
    std::vector<double> x_edges_, y_edges_;
    Axis x_, y_, values_;
    NameRows legend_;
    std::string titles_;
    double top_ = 0, bottom_ = 0, first_left_ = 0, last_right_ = 0, panel_width_ = 0;
};

}   // namespace

std::string svg_of(const Map& map) { return MapDrawing(map).svg(); }

}   // namespace meshfolio::report
