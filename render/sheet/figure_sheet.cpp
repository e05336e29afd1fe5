#include "sheet/figure_sheet.h"

#include <algorithm>

#include "color/srgb.h"
#include "rounding.h"
#include "sheet/color_bar.h"
#include "sheet/text.h"
#include "sheet/view_label.h"

namespace render {

namespace {

/// Text and faint lines against the background.
struct Inks {
    Rgba strong, soft;
};

Inks inks_on(Rgba background) {
    if (background.a > 127 && lab_of(background).x < 50) return {{236, 236, 240, 255}, {170, 170, 178, 255}};
    return {{34, 34, 40, 255}, {92, 92, 102, 255}};
}

struct SheetBody {
    int width = 0, height = 0;
};

SheetBody body_of(const FigureSheet& sheet) {
    SheetBody body{sheet.least_width, 0};
    const auto reach = [&](int right, int bottom) {
        body.width = std::max(body.width, right);
        body.height = std::max(body.height, bottom);
    };
    for (const FigureSheet::Picture& p : sheet.pictures) reach(p.left + p.image->width, p.top + p.image->height);
    for (const FigureSheet::Words& w : sheet.words) reach(w.left + w.width, w.top + w.height);
    return body;
}

void draw_words(Image& image, const FigureSheet::Words& words, int left, int top, double em, Rgba ink) {
    const double middle = top + words.top + words.height / 2.0, width = words.width;
    if (words.bar) {
        const TextStyle style{0.95 * em, ink};
        const double bar = small_bar_width(*words.bar, style.size), between = words.text.empty() ? 0 : 1.5 * em;
        const std::string text = fit_text(words.text, std::max(0.0, width - bar - between), style);
        const double x = left + words.left + std::max(0.0, (width - bar - between - text_width(text, style)) / 2);
        draw_text(image, x, middle + 0.27 * style.size, text, style);
        draw_small_bar(image, *words.bar, x + text_width(text, style) + between, middle, style.size, ink);
    } else if (words.is_centred) {
        draw_view_label(image, left + words.left + width / 2, middle, fit_text(words.text, width, {0.95 * em}), 0.95 * em, ink);
    } else {
        const TextStyle style{em, ink};
        draw_text(image, left + words.left, middle + 0.3 * em, fit_text(words.text, width, style), style);
    }
}

}   // namespace

ComposedFigure compose(const FigureSheet& sheet) {
    const double em = sheet.em;
    const SheetBody body = body_of(sheet);
    const int margin = rounded(1.2 * em), legend_gap = sheet.color_bar ? rounded(0.8 * em) : 0;
    const int title = sheet.title.empty() ? 0 : rounded(1.9 * em), subtitle = sheet.subtitle.empty() ? 0 : rounded(1.5 * em);
    const int legend = sheet.color_bar ? color_bar_height(*sheet.color_bar, em) : 0;
    const int top = margin + title + subtitle, width = body.width + 2 * margin;
    ComposedFigure composed{Image(width, top + body.height + legend_gap + legend + margin, sheet.background), margin, top};
    const Inks inks = inks_on(sheet.background);

    const TextStyle large{1.35 * em, inks.strong, Align::left, Weight::bold}, small{em, inks.soft};
    draw_text(composed.image, margin, margin + 1.05 * em, fit_text(sheet.title, body.width, large), large);
    draw_text(composed.image, margin, margin + title + 0.8 * em, fit_text(sheet.subtitle, body.width, small), small);
    for (const FigureSheet::Picture& p : sheet.pictures) paste(composed.image, *p.image, margin + p.left, top + p.top);
    for (const FigureSheet::Words& words : sheet.words) draw_words(composed.image, words, margin, top, em, inks.strong);
    if (sheet.color_bar)
        draw_color_bar(composed.image, *sheet.color_bar, margin, top + body.height + legend_gap, body.width, em, inks.strong);
    return composed;
}

}   // namespace render
