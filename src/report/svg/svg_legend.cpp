#include "report/writers.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "base/number_text.h"
#include "report/escape.h"
#include "report/svg/svg_elements.h"

namespace meshfolio::report {

namespace {

constexpr double legend_width = 336;   // [pixels]
constexpr double first_colour = 24, last_colour = legend_width - 24, colours_height = 12, histogram_height = 24, tip_length = 9;

std::string legend_title(const Legend& legend) { return legend.quantity + (legend.unit.empty() ? "" : " [" + legend.unit + "]"); }

std::string share_of(double share) { return share < 0.001 ? "< 0.1 %" : readable_percent(share, share < 0.01 ? 1 : 2); }

/// Heights are square roots of the shares: a rare value stays visible beside a frequent one.
std::string legend_histogram(const std::vector<double>& shares, double bottom) {
    double highest = 0;
    for (const double share : shares) highest = std::max(highest, std::isfinite(share) ? share : 0);
    if (!(highest > 0)) return "";
    std::string path = "M" + px(first_colour) + " " + px(bottom);
    const double step = (last_colour - first_colour) / static_cast<double>(shares.size());
    for (std::size_t i = 0; i < shares.size(); ++i) {
        const double share = std::isfinite(shares[i]) ? std::max(0.0, shares[i]) : 0;
        path +=
            "V" + px(bottom - histogram_height * std::sqrt(share / highest)) + "H" + px(first_colour + static_cast<double>(i + 1) * step);
    }
    return "<path d=\"" + path + "V" + px(bottom) + "Z\" fill-opacity=\"0.25\"/>\n";
}

std::string legend_colours(const Legend& legend, double top) {
    const double bottom = top + colours_height, middle = 0.5 * (top + bottom);
    std::string svg = "<g shape-rendering=\"crispEdges\">\n";
    const double step = (last_colour - first_colour) / static_cast<double>(legend.colours.size());
    for (std::size_t i = 0; i < legend.colours.size(); ++i) {
        const double left = first_colour + static_cast<double>(i) * step;
        svg += rectangle_element({left, top, left + step, bottom}, "fill=\"" + xml_escape(safe_text(legend.colours[i])) + "\"");
    }
    svg += "</g>\n" +
           rectangle_element({first_colour, top, last_colour, bottom}, "fill=\"none\" stroke=\"currentColor\" stroke-opacity=\"0.4\"");
    const auto tip_of = [&](double base, double out, const std::string& colour) {
        return "<path d=\"M" + px(base) + " " + px(top) + "L" + px(base + out) + " " + px(middle) + "L" + px(base) + " " + px(bottom) +
               "\" fill=\"" + xml_escape(safe_text(colour)) + "\" stroke=\"currentColor\" stroke-opacity=\"0.4\"/>\n";
    };
    if (legend.clipped_below > 0) svg += tip_of(first_colour, -tip_length, legend.colours.front());
    if (legend.clipped_above > 0) svg += tip_of(last_colour, tip_length, legend.colours.back());
    return svg;
}

/// Round numbers that stand apart and within the drawing.
std::string legend_ticks(const Legend& legend, double top) {
    const Axis axis = Axis::exactly(legend.low, legend.high, legend.log);
    std::vector<Tick> ticks;   // a logarithmic axis has others without a number
    std::ranges::copy_if(axis.ticks(), std::back_inserter(ticks), [](const Tick& tick) { return !tick.label.empty(); });
    const double room = (last_colour - first_colour) / static_cast<double>(std::max<std::size_t>(1, ticks.size()));
    const auto every = static_cast<std::size_t>(std::max(1.0, std::ceil((widest_label(axis) + 10) / room)));
    std::size_t zero = 0;   // keeps its number
    for (std::size_t i = 0; i < ticks.size(); ++i) zero = ticks[i].value == 0 ? i : zero;
    std::string svg;
    for (std::size_t i = 0; i < ticks.size(); ++i) {
        const double x = first_colour + axis.position(ticks[i].value) * (last_colour - first_colour), half = text_width(ticks[i].label) / 2;
        svg += line_element({x, top}, {x, top + 4}, firm);
        if ((i + every * ticks.size() - zero) % every != 0) continue;
        svg += text_element({std::clamp(x, half, legend_width - half), top + 17}, "middle", ticks[i].label);
    }
    return svg;
}

std::string legend_notes(const Legend& legend, double baseline) {
    std::string svg;
    if (legend.clipped_below > 0) svg += text_element({0, baseline}, "start", share_of(legend.clipped_below) + " below");
    if (legend.clipped_above > 0) svg += text_element({legend_width, baseline}, "end", share_of(legend.clipped_above) + " above");
    if (!legend.undefined.empty()) {
        const double left = legend_width / 2 - 40;
        svg += rectangle_element({left, baseline - 10, left + 11, baseline + 1},
                                 "fill=\"" + xml_escape(safe_text(legend.undefined)) + "\" stroke=\"currentColor\"");
        svg += "<path d=\"M" + px(left) + " " + px(baseline - 5) + "l5-5m0 11l6-6m0-5l-11 11\" stroke=\"#000\" stroke-opacity=\"0.35\"/>\n";
        svg += text_element({left + 17, baseline}, "start", "undefined");
    }
    return svg;
}

}   // namespace

std::string svg_of(const Legend& legend) {
    if (legend.colours.empty() || !std::isfinite(legend.low) || !std::isfinite(legend.high)) return "";
    Point below{legend_width / 2, 13};
    std::string body = title_element(below, "middle", legend_title(legend), 1.15 * legend_width);
    double y = below.y - 8;
    const std::string histogram = legend_histogram(legend.histogram, y + histogram_height);
    if (!histogram.empty()) y += histogram_height + 1;
    body += histogram + legend_colours(legend, y);
    y += colours_height;
    body += legend_ticks(legend, y);
    y += 21;
    const std::string notes = legend_notes(legend, y + 14);
    if (!notes.empty()) y += 18;
    const std::string width = px(legend_width), height = px(y + 2);
    return "<svg class=\"legend\" xmlns=\"http://www.w3.org/2000/svg\" width=\"" + width + "\" height=\"" + height + "\" viewBox=\"0 0 " +
           width + " " + height + "\" role=\"img\" aria-label=\"" +
           xml_escape(safe_text("Colours: " + legend_title(legend) + " from " + readable(legend.low) + " to " + readable(legend.high))) +
           "\" fill=\"currentColor\" font-family=\"" + font_family + "\" font-size=\"" + px(font_size) + "\">\n" + body + notes + "</svg>";
}

}   // namespace meshfolio::report
