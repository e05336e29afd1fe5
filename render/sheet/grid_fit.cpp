#include "sheet/grid_fit.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace render {

namespace {

constexpr double thickest_bar = 3.2;   // pixels; edges of thicker bars are visible anyway

bool is_whole(double pixels) { return std::abs(pixels - std::round(pixels)) < 1e-9; }

}   // namespace

GridFit::GridFit(const FontLines& lines, std::span<const HorizontalEdge> edges, double scale) : scale_(scale) {
    const double beyond = std::round(lines.overshoot * scale);   // small letters lose it, large ones keep it
    const auto row = [&](double height) { return std::round(height * scale); };
    insert(lines.descender - lines.overshoot, row(lines.descender) - beyond);
    insert(lines.descender, row(lines.descender));
    insert(-lines.overshoot, -beyond);
    insert(0, 0);
    for (const double height : {lines.x_height, lines.capital, lines.ascender}) {
        insert(height, row(height));
        insert(height + lines.overshoot, row(height) + beyond);
    }
    for (const HorizontalEdge& bottom : edges) {
        if (bottom.is_top) continue;
        std::optional<double> top;
        for (const HorizontalEdge& e : edges)
            if (e.is_top && e.height > bottom.height && e.height < top.value_or(INFINITY)) top = e.height;
        if (top) insert_bar(bottom.height, *top);
    }
}

/// Puts a bar on rows; a bar about one pixel thick gets exactly one. If one of its edges lies on a row already, the other follows.
void GridFit::insert_bar(double bottom, double top) {
    const double thickness = scale_ * (top - bottom);
    if (thickness < 0.4 || thickness > thickest_bar) return;
    const double rows = thickness < 1.4 ? 1 : thickness, low = (*this)(bottom), high = (*this)(top);
    const double at = is_whole(high) ? high - rows : is_whole(low) ? low : std::round(0.5 * (low + high - rows));
    if (is_whole(high)) insert(top, high);
    insert(bottom, at);
    insert(top, at + rows);
}

/// Adds a knot unless that would break the order of the knots.
void GridFit::insert(double height, double pixels) {
    const auto after = std::find_if(knots_.begin(), knots_.end(), [&](const Knot& k) { return k.height >= height; });
    if (after != knots_.end() && (after->height == height || after->pixels < pixels)) return;
    if (after != knots_.begin() && std::prev(after)->pixels > pixels) return;
    knots_.insert(after, {height, pixels});
}

double GridFit::operator()(double height) const {
    const auto after = std::find_if(knots_.begin(), knots_.end(), [&](const Knot& k) { return k.height >= height; });
    if (knots_.empty()) return scale_ * height;
    if (after == knots_.begin()) return after->pixels + scale_ * (height - after->height);
    const Knot& before = *std::prev(after);
    if (after == knots_.end()) return before.pixels + scale_ * (height - before.height);
    return before.pixels + (height - before.height) / (after->height - before.height) * (after->pixels - before.pixels);
}

}   // namespace render
