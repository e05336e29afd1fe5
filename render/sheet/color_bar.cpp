#include "sheet/color_bar.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rounding.h"
#include "sheet/strokes.h"
#include "sheet/text.h"
#include "sheet/ticks.h"

namespace render {

namespace {

/// Heights in em: the quantity, the histogram, the bar, the ticks with their numbers, the notes.
constexpr double title_height = 1.5, histogram_height = 2.1, bar_height = 0.95, ticks_height = 1.75, notes_height = 1.35;

bool is_share(double s) { return s > 0 && std::isfinite(s); }
bool has_histogram(const ColorBar& bar) { return std::ranges::any_of(bar.histogram, is_share); }
int histogram_rows(const ColorBar& bar, double em) { return has_histogram(bar) ? rounded(histogram_height * em) : 0; }

/// The box of the colours, with columns [x0, x1). Tips beside it stand for values beyond the range.
struct BarBox {
    int x0, x1, top, bottom;

    double x_of(const ValueRange& range, double value) const { return x0 + (x1 - x0) * range.position(value); }
};

/// Adds a triangle that points away from the bar. @param direction  1: to the right of column `base`, −1: to its left
void add_tip(Drawing& drawing, const BarBox& e, int base, int direction, Rgba color) {
    const double half = 0.5 * (e.bottom - e.top);
    drawing.items.emplace_back(
        Drawing::Area{{{base, e.top}, {base + direction * rounded(half * 1.2), e.top + half}, {base, e.bottom}}, color});
}

/// Adds the colours with isolines and tips.
void add_colors(Drawing& drawing, const ColorBar& bar, const BarBox& e) {
    const Colormap& map = bar.range.colormap != nullptr ? *bar.range.colormap : colormap_named("viridis");
    drawing.items.emplace_back(Drawing::Ramp{&map, e.x0, e.top, e.x1, e.bottom});
    if (bar.isoline_spacing > 0) {   // none if they are less than 4 pixels apart, which would hide the colours
        const double from = std::ceil(bar.range.low / bar.isoline_spacing), to = std::floor(bar.range.high / bar.isoline_spacing);
        for (double k = from; k <= to && (to - from) * 4 < e.x1 - e.x0; ++k) {
            const int x = rounded(e.x_of(bar.range, k * bar.isoline_spacing));
            if (x > e.x0 && x < e.x1) drawing.add_rectangle(x, e.top, x + 1, e.bottom, {34, 34, 40, 255});
        }
    }
    if (bar.clipped_below > 0) add_tip(drawing, e, e.x0, -1, color_at(map, 0));
    if (bar.clipped_above > 0) add_tip(drawing, e, e.x1, 1, color_at(map, 1));
}

/// Adds columns over the colours of their values, standing on the row `bottom`: pale below a thin line.
void add_histogram(Drawing& drawing, const ColorBar& bar, const BarBox& e, int bottom, double height, double thickness, Rgba ink) {
    double highest = 0;
    for (const double share : bar.histogram)
        if (is_share(share)) highest = std::max(highest, std::sqrt(share));
    std::vector<glm::dvec2> outline{{e.x0, bottom}};
    for (std::size_t i = 0; i < bar.histogram.size(); ++i) {
        const double share = bar.histogram[i], y = bottom - height * (is_share(share) ? std::sqrt(share) : 0) / highest;
        for (const std::size_t end : {i, i + 1})
            outline.emplace_back(e.x0 + static_cast<double>(end) * (e.x1 - e.x0) / static_cast<double>(bar.histogram.size()), y);
    }
    outline.emplace_back(e.x1, bottom);
    drawing.items.emplace_back(Drawing::Area{outline, {ink.r, ink.g, ink.b, 48}});
    const Rgba line = inked(drawing.background, {ink.r, ink.g, ink.b, 144}, 1);   // opaque, so that corners are no darker
    drawing.items.emplace_back(Drawing::Path{std::move(outline), thickness, line});
}

/// Returns up to seven ticks, or those of decades, with numbers that do not touch.
std::vector<double> readable_ticks(const ColorBar& bar, const BarBox& e, const TextStyle& style) {
    const auto are_apart = [&](const std::vector<double>& ticks, double gap) {
        double widest = 0;
        for (const std::string& text : tick_labels(ticks).text) widest = std::max(widest, text_width(text, style));
        for (std::size_t i = 1; i < ticks.size(); ++i)
            if (e.x_of(bar.range, ticks[i]) - e.x_of(bar.range, ticks[i - 1]) <= widest + gap) return false;
        return true;
    };
    if (bar.range.logarithmic) {
        std::vector<double> ticks = decade_ticks(bar.range.low, bar.range.high);
        for (bool powers = false; !are_apart(ticks, 0.2 * style.size); powers = true) {   // first only the powers of ten, then every second
            std::size_t i = 0;
            std::erase_if(ticks, [&](double x) { return powers ? i++ % 2 == 1 : std::abs(std::remainder(std::log10(x), 1)) > 0.1; });
        }
        return ticks;
    }
    for (int wanted = 7; wanted > 1; --wanted)
        if (std::vector<double> ticks = round_ticks(bar.range.low, bar.range.high, wanted); are_apart(ticks, style.size)) return ticks;
    return round_ticks(bar.range.low, bar.range.high, 1);
}

void add_ticks(Drawing& drawing, const ColorBar& bar, const BarBox& e, const std::vector<double>& ticks, const TickLabels& labels,
               double em, Rgba ink) {
    const TextStyle style{0.9 * em, ink, Align::centre};
    for (std::size_t i = 0; i < ticks.size(); ++i) {
        const double x = std::clamp(std::floor(e.x_of(bar.range, ticks[i])) + 0.5, e.x0 + 0.5, e.x1 - 0.5);
        drawing.add_line({x, e.bottom + 1}, {x, e.bottom + 0.28 * em}, std::max(1.0, em / 16), ink);
        const double half = text_width(labels.text[i], style) / 2;
        drawing.add_text(std::clamp(x, half, std::max(half, drawing.width - half)), e.bottom + 1.25 * em, labels.text[i], style);
    }
}

/// Adds the line below the ticks: the share below the range, a swatch for undefined values, the share above.
void add_notes(Drawing& drawing, const ColorBar& bar, const BarBox& e, double em, Rgba ink) {
    const double baseline = e.bottom + (ticks_height + 0.95) * em, room = (e.x1 - e.x0) / (bar.has_undefined ? 3.0 : 2.0) - 0.5 * em;
    TextStyle style{0.85 * em, ink};
    const auto add_share = [&](double x, double share, const std::string& where) {   // its place beside a tip says it too
        const std::string number = share_text(share), text = number + where;
        if (share > 0) drawing.add_text(x, baseline, text_width(text, style) <= room ? text : fit_text(number, room, style), style);
    };
    add_share(e.x0, bar.clipped_below, " below");
    if (bar.has_undefined) {
        const std::string text = fit_text("undefined", room - 1.1 * em, style);
        const double left = (e.x0 + e.x1) / 2.0 - (text_width(text, style) + 1.1 * em) / 2;
        const int box = rounded(0.8 * em), x = rounded(left), y = rounded(baseline - 0.68 * em);
        drawing.add_rectangle(x, y, x + box, y + box, ink);
        drawing.add_rectangle(x + 1, y + 1, x + box - 1, y + box - 1,
                              {bar.undefined_color.r, bar.undefined_color.g, bar.undefined_color.b, 255});
        for (const double part : {0.4, 1.0, 1.6})   // hatched, as in the picture
            drawing.add_line({x + std::max(1.0, (part - 1) * box), y + std::min(box - 1.0, part * box)},
                             {x + std::min(box - 1.0, part * box), y + std::max(1.0, (part - 1) * box)}, 1, {0, 0, 0, 90});
        drawing.add_text(left + 1.1 * em, baseline, text, style);
    }
    style.align = Align::right;
    add_share(e.x1, bar.clipped_above, " above");
}

/// Returns the text at the low end of a small bar, such as "0"; high_end() the text at the high end, such as "7.2 % of h" or "20/length²".
std::string low_end(const ColorBar& bar) { return number_text(bar.range.low); }
std::string high_end(const ColorBar& bar) {
    const double beyond = bar.clipped_below + bar.clipped_above;
    const std::string unit = bar.unit.starts_with("1/") ? bar.unit.substr(1) : bar.unit.empty() ? "" : "\u00a0" + bar.unit;
    return number_text(bar.range.high) + unit + (beyond > 0 ? ", " + share_text(beyond) + " beyond" : "");
}

constexpr double small_bar = 7, small_gap = 0.9;   // in em: the colours, and the gaps beside them, which hold the tips

}   // namespace

double small_bar_width(const ColorBar& bar, double em) {
    return text_width(low_end(bar), {em}) + text_width(high_end(bar), {em}) + (small_bar + 2 * small_gap) * em;
}

void add_small_bar(Drawing& drawing, const ColorBar& bar, double left, double middle, double em, Rgba ink) {
    const TextStyle style{em, ink};
    const double baseline = middle + 0.27 * em;
    const int x0 = rounded(left + text_width(low_end(bar), style) + small_gap * em), x1 = x0 + rounded(small_bar * em);
    const int half = rounded(0.34 * em), row = rounded(middle);
    drawing.add_text(left, baseline, low_end(bar), style);
    add_colors(drawing, bar, {x0, x1, row - half, row + half});
    drawing.add_text(x1 + small_gap * em, baseline, high_end(bar), style);
}

int color_bar_height(const ColorBar& bar, double em) {
    const bool has_notes = bar.clipped_below > 0 || bar.clipped_above > 0 || bar.has_undefined;
    return histogram_rows(bar, em) + rounded((title_height + bar_height + ticks_height + (has_notes ? notes_height : 0)) * em);
}

void add_color_bar(Drawing& drawing, const ColorBar& bar, int left, int top, int width, double em, Rgba ink) {
    const int inset = std::min(rounded(2.5 * em), width / 8);
    const int length = std::min(width - 2 * inset, rounded(44 * em)), x0 = left + (width - length) / 2;
    const int bar_top = top + rounded(title_height * em) + histogram_rows(bar, em);
    const BarBox e{x0, x0 + length, bar_top, bar_top + rounded(bar_height * em)};
    const std::vector<double> ticks = readable_ticks(bar, e, {0.9 * em});
    const TickLabels labels = tick_labels(ticks);
    const std::string factor = labels.power.empty() ? "" : "×\u202f" + labels.power + (bar.unit.empty() ? "" : " ");
    const std::string unit = factor.empty() && bar.unit.empty() ? "" : "  [" + factor + bar.unit + "]";
    const TextStyle centred{em, ink, Align::centre};
    const std::string quantity = fit_text(bar.quantity, width - text_width(unit, centred), centred);
    drawing.add_text(left + width / 2.0, top + 1.0 * em, fit_text(quantity + unit, width, centred), centred);
    if (has_histogram(bar)) add_histogram(drawing, bar, e, bar_top - rounded(0.1 * em), 1.75 * em, em / 16, ink);
    add_colors(drawing, bar, e);
    add_ticks(drawing, bar, e, ticks, labels, em, ink);
    add_notes(drawing, bar, e, em, ink);
}

}   // namespace render
