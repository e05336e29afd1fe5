#include "report/svg/svg_elements.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string_view>

#include "base/number_text.h"
#include "base/utf8.h"
#include "report/escape.h"
#include "report/page/math_markup.h"
#include "report/writers.h"
#include "sans-regular.h"

namespace meshfolio::report {

namespace {

/// Returns text as escaped <tspan> elements, its mathematics set as such: λ_crit.
std::string spans(const Text& words) {
    using Kind = MathPart::Kind;
    std::string marked;
    double shift = 0;   // of the text before, in pixels below the base line: SVG moves from there
    const auto add = [&](const MathPart& part) {
        const double wanted = part.kind == Kind::subscript ? 3.5 : part.kind == Kind::superscript ? -4.5 : 0;
        std::string attributes;
        if (wanted != shift) attributes += " dy=\"" + px(wanted - shift) + "\"";
        if (wanted != 0) attributes += " font-size=\"" + px(script_size) + "\"";
        if (part.kind == Kind::vector) attributes += " font-weight=\"bold\"";
        if (part.kind == Kind::variable) attributes += " font-style=\"italic\"";
        shift = wanted;
        const std::string text = xml_escape(safe_text(part.text));
        marked += attributes.empty() ? text : "<tspan" + attributes + ">" + text + "</tspan>";
    };
    for (const Run& run : words) {
        if (run.kind == Run::Kind::math) std::ranges::for_each(math_parts(run.content), add);
        else add({Kind::upright, run.content});
    }
    return marked;
}

}   // namespace

double text_width(const std::string& text) {
    double width = 0;
    for (std::size_t i = 0; i < text.size();) {
        const CodePoint c = code_point_at(text, i);
        const auto* known = std::ranges::lower_bound(sans_regular_widths, c.value, {}, [](auto& entry) { return entry.character; });
        const bool is_known = known != std::end(sans_regular_widths) && known->character == c.value;
        width += is_known ? known->width : 650;   // in another font: as a large digit
        i += std::max<std::size_t>(c.length, 1);
    }
    return 1e-3 * font_size * width;
}

double text_width(const Text& text) {
    double width = 0;
    for (const Run& run : text) {
        if (run.kind != Run::Kind::math) {
            width += text_width(run.content);
            continue;
        }
        for (const MathPart& part : math_parts(run.content)) {
            const bool small = part.kind == MathPart::Kind::subscript || part.kind == MathPart::Kind::superscript;
            width += text_width(part.text) * (small ? script_size / font_size : 1);
        }
    }
    return width;
}

std::vector<std::string> wrapped(const std::string& text, double width) {
    std::vector<std::string> lines(1);
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find(' ', begin), text.size());
        const std::string word = text.substr(begin, end - begin);
        const std::string longer = lines.back().empty() ? word : lines.back() + " " + word;
        if (!lines.back().empty() && text_width(longer) > width) {
            lines.push_back(word);
        } else {
            lines.back() = longer;
        }
        begin = end + 1;
    }
    return lines;
}

std::string px(double x) { return plain_text(std::round(10 * x) / 10, 6); }

std::string line_data(const Stretch& points) {
    std::string data;
    for (const Point& p : points) data += (data.empty() ? "M" : "L") + px(p.x) + " " + px(p.y);
    return data;
}

std::string text_element(Point at, const std::string& anchor, const Text& text, const std::string& more) {
    return "<text x=\"" + px(at.x) + "\" y=\"" + px(at.y) + "\" text-anchor=\"" + anchor + "\"" + more + ">" + spans(text) + "</text>\n";
}

std::string text_element(Point at, const std::string& anchor, const std::string& text, const std::string& more) {
    return text_element(at, anchor, prose(text), more);
}

std::string title_element(Point& at, const std::string& anchor, const std::string& words, double width) {
    std::string svg;
    for (const std::string& line : wrapped(safe_text(words), width)) {
        svg += text_element(at, anchor, line, " font-weight=\"600\"");
        at.y += line_height;
    }
    return svg;
}

double title_lines(const std::string& words, double width) { return static_cast<double>(wrapped(safe_text(words), width).size()); }

std::string line_element(Point a, Point b, const std::string& attributes) {
    return "<line x1=\"" + px(a.x) + "\" y1=\"" + px(a.y) + "\" x2=\"" + px(b.x) + "\" y2=\"" + px(b.y) + "\" " + attributes + "/>\n";
}

std::string rectangle_element(const Box& box, const std::string& attributes) {
    return "<rect x=\"" + px(box.left) + "\" y=\"" + px(box.top) + "\" width=\"" + px(box.right - box.left) + "\" height=\"" +
           px(box.bottom - box.top) + "\" " + attributes + "/>\n";
}

Look look_of(const Series& series, std::size_t place) {
    constexpr std::array<const char*, 6> colors{"#0b5fa5", "#c2410c", "#047857", "#86198f", "#92600a", "#475569"};
    constexpr std::array<const char*, 7> dashes{"", "9 4", "2.5 3.5", "11 4 2.5 4", "5 3", "14 5", "7 3 2 3 2 3"};
    // Several dashed series of one plot must differ without colour, too.
    constexpr std::array<const char*, 7> of_dashed{"6 5", "3 6", "13 5", "8 4 2 4", "8 3 2 3 2 3", "2 2 6 2", "4 7"};
    const std::size_t color = (series.color >= 0 ? static_cast<std::size_t>(series.color) : place) % colors.size();
    const std::size_t pattern = (series.pattern >= 0 ? static_cast<std::size_t>(series.pattern) : place) % dashes.size();
    return {"var(--plot-" + std::to_string(color + 1) + ", " + colors[color] + ")",
            (series.style == Series::Style::dashed ? of_dashed : dashes)[pattern], static_cast<int>(pattern),
            series.style != Series::Style::points, series.style == Series::Style::points || series.style == Series::Style::line_and_points};
}

std::string point_shape(Point p, int pattern, const std::string& color, double size) {
    const auto at = [&](double dx, double dy) { return px(p.x + size * dx) + " " + px(p.y + size * dy); };
    const std::string filled = "\" fill=\"" + color + "\"/>\n",
                      drawn = "\" fill=\"none\" stroke=\"" + color + "\" stroke-width=\"1.8\"/>\n";
    const auto polygon = [&](std::initializer_list<Point> corners) {
        std::string path;
        for (const Point& c : corners) path += (path.empty() ? "M" : "L") + at(c.x, c.y);
        return "<path d=\"" + path + "Z" + filled;
    };
    if (pattern == 1) return polygon({{-2.6, -2.6}, {2.6, -2.6}, {2.6, 2.6}, {-2.6, 2.6}});
    if (pattern == 2) return polygon({{0, -3.5}, {3.3, 2.6}, {-3.3, 2.6}});
    if (pattern == 3) return polygon({{0, -3.7}, {3.7, 0}, {0, 3.7}, {-3.7, 0}});
    if (pattern == 4) return "<path d=\"M" + at(-2.8, -2.8) + "L" + at(2.8, 2.8) + "M" + at(-2.8, 2.8) + "L" + at(2.8, -2.8) + drawn;
    if (pattern == 5) return "<path d=\"M" + at(-3.3, 0) + "L" + at(3.3, 0) + "M" + at(0, -3.3) + "L" + at(0, 3.3) + drawn;
    if (pattern == 6) return polygon({{0, 3.5}, {3.3, -2.6}, {-3.3, -2.6}});
    return "<circle cx=\"" + px(p.x) + "\" cy=\"" + px(p.y) + "\" r=\"" + px(2.9 * size) + filled;
}

void NameRows::add(const std::string& name, const std::function<std::string(Point)>& sample) {
    if (name.empty() || std::ranges::find(known_, name) != known_.end()) return;
    known_.push_back(name);
    const std::vector<std::string> lines = wrapped(safe_text(name), width_ - 60);
    double widest = 0;
    for (const std::string& line : lines) widest = std::max(widest, text_width(line));
    if (x_ > 4 && x_ + 36 + widest > width_) {
        x_ = 4;
        y_ += line_height + 2;
    }
    svg_ += sample({x_, y_ - 4.5});
    for (std::size_t k = 0; k < lines.size(); ++k) {
        if (k > 0) y_ += line_height;
        svg_ += text_element({x_ + 34, y_}, "start", lines[k]);
    }
    x_ += 34 + widest + 20;
    bottom_ = y_ + 8;
}

std::string ticks_below(const Axis& axis, const Box& frame) {
    std::string svg;
    double free_from = -1e9;
    for (const Tick& tick : axis.ticks()) {
        const double x = frame.left + axis.position(tick.value) * (frame.right - frame.left), half = 0.5 * text_width(tick.label);
        const bool labelled = !tick.label.empty() && x - half > free_from;
        svg += line_element({x, frame.bottom}, {x, frame.bottom + (labelled ? tick_length : 3)}, firm);
        if (!labelled) continue;
        svg += text_element({x, frame.bottom + tick_length + 14}, "middle", tick.label);
        free_from = x + half + 9;
    }
    return svg;
}

std::string ticks_beside(const Axis& axis, const Box& frame, bool at_right) {
    const double side = at_right ? frame.right : frame.left, out = at_right ? 1 : -1;
    std::string svg;
    for (const Tick& tick : axis.ticks()) {
        const double y = frame.bottom - axis.position(tick.value) * (frame.bottom - frame.top);
        svg += line_element({side + out * 3, y}, {side, y}, firm);
        if (tick.label.empty()) continue;
        svg += text_element({side + out * (tick_length + 3), y + 0.35 * font_size}, at_right ? "start" : "end", tick.label);
    }
    return svg;
}

double widest_label(const Axis& axis) {
    double widest = 0;
    for (const Tick& tick : axis.ticks()) widest = std::max(widest, text_width(tick.label));
    return widest;
}

std::string svg_head(const std::string& id, const std::string& subject, const std::string& alt, double width, double height) {
    const std::string name = xml_escape(safe_text(id));
    return "<svg class=\"plot\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + px(width) + " " + px(height) +
           "\" role=\"img\" aria-labelledby=\"" + name + "-title " + name + "-desc\" fill=\"currentColor\" font-family=\"" + font_family +
           "\" font-size=\"" + px(font_size) + "\">\n<title id=\"" + name + "-title\">" + xml_escape(safe_text(subject)) +
           "</title>\n<desc id=\"" + name + "-desc\">" + xml_escape(safe_text(alt)) + "</desc>\n";
}

std::string svg_on_white(std::string svg) {
    constexpr std::string_view variable = "\"var(--";   // "var(--plot-1, #0b5fa5)" becomes its default, as some readers know no variables
    for (std::size_t at = svg.find(variable); at != svg.npos; at = svg.find(variable, at)) {
        const std::size_t comma = svg.find(", ", ++at), end = svg.find(')', comma);
        svg.replace(at, end + 1 - at, svg.substr(comma + 2, end - comma - 2));
    }
    svg.insert(svg.find('>') + 1, "\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>");
    svg.insert(svg.find(" role="), " color=\"#1b1b1f\"");
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + svg;
}

}   // namespace meshfolio::report
