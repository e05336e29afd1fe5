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
constexpr double small_length = 96, small_gap = 12;   // of the bar of one panel, in the line of its label

std::string legend_title(const Legend& legend) { return legend.quantity + (legend.unit.empty() ? "" : " [" + legend.unit + "]"); }

std::string share_of(double share) { return share < 0.001 ? "< 0.1 %" : readable_percent(share, share < 0.01 ? 1 : 2); }

/// Draws the histogram of the values. Heights are square roots of the shares, so that rare values stay visible.
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

/// Draws the colours as a gradient, with tips for values beyond its ends. @param place  unique in a page, for the id of the gradient
std::string legend_colours(const Legend& legend, const std::string& place, const Box& box) {
    const std::string name = "colours-" + xml_escape(safe_text(place));
    const double middle = 0.5 * (box.top + box.bottom);
    std::string svg = "<linearGradient id=\"" + name + "\">";
    const std::size_t step = std::max<std::size_t>(1, legend.colours.size() / 16);   // 16 stops look like a smooth gradient
    for (std::size_t i = step / 2; i < legend.colours.size(); i += step) {
        const double offset = (static_cast<double>(i) + 0.5) / static_cast<double>(legend.colours.size());
        svg += "<stop offset=\"" + plain_text(offset, 4) + "\" stop-color=\"" + xml_escape(safe_text(legend.colours[i])) + "\"/>";
    }
    svg += "</linearGradient>\n" +
           rectangle_element(box, "fill=\"url(#" + name + ")\" stroke=\"currentColor\" stroke-opacity=\"0.4\" stroke-width=\"0.6\"");
    const auto tip_of = [&](double base, double out, const std::string& colour) {
        return "<path d=\"M" + px(base) + " " + px(box.top) + "L" + px(base + out) + " " + px(middle) + "L" + px(base) + " " +
               px(box.bottom) + "\" fill=\"" + xml_escape(safe_text(colour)) +
               "\" stroke=\"currentColor\" stroke-opacity=\"0.4\" stroke-width=\"0.6\"/>\n";
    };
    if (legend.clipped_below > 0) svg += tip_of(box.left, -tip_length, legend.colours.front());
    if (legend.clipped_above > 0) svg += tip_of(box.right, tip_length, legend.colours.back());
    return svg;
}

/// Draws round numbers that keep apart and stay within the drawing.
std::string legend_ticks(const Legend& legend, double top) {
    const Axis axis = Axis::exactly(legend.low, legend.high, legend.log);
    std::vector<Tick> ticks;   // with a number: a logarithmic axis has others
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

/// Returns the SVG of a legend of either kind around `body`.
std::string legend_svg(const Legend& legend, const char* kind, double width, double height, const std::string& body) {
    const std::string size = px(width), rows = px(height);
    return std::string("<svg class=\"") + kind + "\" xmlns=\"http://www.w3.org/2000/svg\" width=\"" + size + "\" height=\"" + rows +
           "\" viewBox=\"0 0 " + size + " " + rows + "\" role=\"img\" aria-label=\"" +
           xml_escape(safe_text("Colours: " + legend_title(legend) + " from " + readable(legend.low) + " to " + readable(legend.high))) +
           "\" fill=\"currentColor\" font-family=\"" + font_family + "\" font-size=\"" + px(font_size) + "\">\n" + body + "</svg>";
}

/// Draws the legend of one panel in a line: the colours between their ends with the unit, and the share beyond.
std::string small_bar(const Legend& legend, const std::string& place) {
    const std::string low = readable(legend.low, 3);
    const double beyond = legend.clipped_below + legend.clipped_above;
    const std::string high = readable(legend.high, 3) +
                             (legend.unit.starts_with("1/") ? legend.unit.substr(1)
                              : legend.unit.empty()         ? ""
                                                            : " " + legend.unit) +
                             (beyond > 0 ? ", " + share_of(beyond) + " beyond" : "");
    const Box box{text_width(low) + small_gap, 4, text_width(low) + small_gap + small_length, 4 + colours_height};
    return legend_svg(legend, "legend small", box.right + small_gap + text_width(high), 20,
                      legend_colours(legend, place, box) + text_element({box.left - small_gap, 14.5}, "end", low) +
                          text_element({box.right + small_gap, 14.5}, "start", high));
}

std::string large_bar(const Legend& legend, const std::string& place) {
    Point below{legend_width / 2, 13};
    std::string body = title_element(below, "middle", legend_title(legend), 1.15 * legend_width);
    double y = below.y - 8;
    const std::string histogram = legend_histogram(legend.histogram, y + histogram_height);
    if (!histogram.empty()) y += histogram_height + 1;
    body += histogram + legend_colours(legend, place, {first_colour, y, last_colour, y + colours_height});
    y += colours_height;
    body += legend_ticks(legend, y);
    y += 21;
    const std::string notes = legend_notes(legend, y + 14);
    if (!notes.empty()) y += 18;
    return legend_svg(legend, "legend", legend_width, y + 2, body + notes);
}

}   // namespace

std::string svg_of(const Legend& legend, const std::string& place, bool small) {
    if (legend.colours.empty() || !std::isfinite(legend.low) || !std::isfinite(legend.high)) return "";
    return small ? small_bar(legend, place) : large_bar(legend, place);
}

}   // namespace meshfolio::report
