// Plots as inline SVG: one frame, or small ones on common axes. Names stand at the ends of the curves, in their colours; dashes and point
// shapes distinguish the series without colour.
#include <algorithm>
#include <cmath>

#include "report/escape.h"
#include "report/svg/plot_panel.h"
#include "report/writers.h"

namespace meshfolio::report {

namespace {

constexpr double column_width = 84 * drawing_width / 145;   // of a paper, whose page has drawings of 145 mm (print.css)
constexpr double plot_height = 150, right_margin = 18, between_panels = 16, between_rows = 10, numbers_height = 24;

class PlotDrawing {
public:
    PlotDrawing(const Plot& plot, double width)
        : plot_(plot), width_(width), x_(x_values(plot), plot.log_x, true), y_(y_values(plot), plot.log_y) {
        for (std::string& name : panel_names(plot)) panels_.emplace_back(plot, std::move(name), x_, y_);
        choose_columns();
        place_legend();
        place_panels();
    }

    std::string svg() {
        Point above{4, legend_.bottom() + line_height - 3}, below{0.5 * (left_ + right_), bottom_ + numbers_height + line_height - 4};
        std::string body = legend_.svg() + title_element(above, "start", plot_.y_label, width_ - 8);
        body += title_element(below, "middle", plot_.x_label, width_ - 8);
        for (std::size_t p = 0; p < panels_.size(); ++p) {
            body += titles_[p] + panels_[p].svg(p % columns_ == 0, p == 0);
            // If every panel has the same curves, the last one of each row has their names, else each panel.
            const bool is_named = !curves_recur_ || p % columns_ == columns_ - 1 || p + 1 == panels_.size();
            if (is_named) body += panels_[p].end_names(name_width_);
        }
        const double height = bottom_ + numbers_height + line_height * title_lines(plot_.x_label, width_ - 8) + 4;
        return svg_head(plot_.id, plot_.y_label + " against " + plot_.x_label, plot_.alt, width_, height) + body + "</svg>\n";
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
        for (const Series& s : plot.series)
            for (const auto* part : {&s.y, &s.y_low, &s.y_high}) values.insert(values.end(), part->begin(), part->end());
        for (const Marker& m : plot.markers) values.push_back(m.y);
        return values;
    }

    void choose_columns() {
        const PlotPanel& last = panels_.back();
        const auto is_in_last = [&](const PlotCurve& curve) {
            const auto it = std::find(last.curves().begin(), last.curves().end(), curve.series->name);
            return it != last.curves().end() && last.has_end(*it);
        };
        curves_recur_ = std::ranges::all_of(panels_, [&](const auto& panel) { return std::ranges::all_of(panel.curves(), is_in_last); });
        const std::size_t count = panels_.size();
        columns_ = count == 1 ? 1 : count == 2 || count == 4 || !curves_recur_ ? 2 : 3;
        const double longest = width_ < drawing_width ? 95 : count == 1 ? 165 : curves_recur_ ? 125 : 110;   // a line of a name
        for (const PlotPanel& panel : panels_) {
            for (const PlotCurve& curve : panel.curves()) {
                if (curve.series->name.empty() || !panel.has_end(curve)) continue;
                for (const std::string& line : wrapped(safe_text(curve.series->name), longest))
                    name_width_ = std::clamp(text_width(line), name_width_, longest);
            }
        }
    }

    /// Places the names of series without an end above the plot.
    void place_legend() {
        for (const PlotPanel& panel : panels_) {
            for (const PlotCurve& curve : panel.curves()) {
                if (panel.has_end(curve)) continue;
                legend_.add(curve.series->name, [&](Point left) { return curve_sample(curve.look, left, NameRows::sample_width); });
            }
        }
    }

    void place_panels() {
        const auto columns = static_cast<double>(columns_);
        const double numbers = std::ceil(widest_label(y_)) + tick_length + 10;
        const double names = name_width_ > 0 ? name_width_ + end_sample_width + 2 * end_gap : right_margin;
        const double name_columns = curves_recur_ ? 1 : columns;
        const double width = (width_ - numbers - name_columns * names - (columns - 1) * between_panels) / columns;
        const double step = width + between_panels + (curves_recur_ ? 0 : names);
        double height = plot_height;
        double title_rows = 0;
        for (const PlotPanel& panel : panels_) {
            height = std::max(height, panel.height_of_names(name_width_) - 10);
            if (!panel.name().empty()) title_rows = std::max(title_rows, title_lines(panel.name(), width));
        }
        const double titles = title_rows * line_height;
        double top = legend_.bottom() + line_height * title_lines(plot_.y_label, width_ - 8) + 10;
        for (std::size_t p = 0; p < panels_.size(); ++p) {
            if (p > 0 && p % columns_ == 0) top += titles + height + numbers_height + between_rows;
            const double left = numbers + static_cast<double>(p % columns_) * step;
            panels_[p].set_frame({left, top + titles, left + width, top + titles + height});
            Point above{left + 0.5 * width, top + line_height - 7};
            titles_.push_back(panels_[p].name().empty() ? "" : title_element(above, "middle", panels_[p].name(), width));
        }
        left_ = numbers;
        right_ = numbers + (columns - 1) * step + width;
        bottom_ = top + titles + height;
    }

    const Plot& plot_;
    double width_;
    Axis x_, y_;
    std::vector<PlotPanel> panels_;
    std::vector<std::string> titles_;
    std::size_t columns_ = 1;
    bool curves_recur_ = true;
    double name_width_ = 0, left_ = 0, right_ = 0, bottom_ = 0;
    NameRows legend_{width_};
};

}   // namespace

std::string svg_of(const Plot& plot) { return PlotDrawing(plot, drawing_width).svg(); }

std::string column_svg_of(const Plot& plot) { return panel_names(plot).size() > 1 ? "" : PlotDrawing(plot, column_width).svg(); }

}   // namespace meshfolio::report
