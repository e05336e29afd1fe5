#include "sheet/figure_sheet.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>

#include "color/srgb.h"
#include "rounding.h"
#include "sheet/color_bar.h"
#include "sheet/text.h"
#include "sheet/view_label.h"

namespace render {

namespace {

void add_words(Drawing& drawing, const FigureSheet::Words& words, int left, int top, double em, Rgba ink, Up up) {
    const double middle = top + words.top + words.height / 2.0, width = words.width;
    if (words.bar) {
        const TextStyle style{0.95 * em, ink};
        const double bar = small_bar_width(*words.bar, style.size), between = words.text.empty() ? 0 : 1.5 * em;
        const std::string text = fit_text(words.text, std::max(0.0, width - bar - between), style);
        const double x = left + words.left + std::max(0.0, (width - bar - between - text_width(text, style)) / 2);
        drawing.add_text(x, middle + 0.27 * style.size, text, style);
        add_small_bar(drawing, *words.bar, x + text_width(text, style) + between, middle, style.size, ink);
    } else if (words.is_centred) {
        add_view_label(drawing, left + words.left + width / 2, middle, fit_text(words.text, width, {0.95 * em}), 0.95 * em, ink, up);
    } else {
        const TextStyle style{em, ink};
        drawing.add_text(left + words.left, middle + 0.3 * em, fit_text(words.text, width, style), style);
    }
}

/// Sizes and places of the views of a contact sheet [pixels].
struct Grid {
    int columns = 1;
    int cell_width = 400, cell_height = 0;   // if there are no pictures
    double em = 16;                          // text size
    int gap = 0, names = 0;                  // the latter: height of the view names below

    explicit Grid(const ContactSheet& sheet) {
        const int count = static_cast<int>(sheet.pictures.size());
        columns = count == 4 ? 2 : std::clamp(count, 1, 3);
        if (count > 0) {
            const double width = sheet.pictures[0].width, height = sheet.pictures[0].height;
            const double scale = sheet.cell > 0 ? std::min(1.0, sheet.cell / std::max(width, height)) : 1.0;
            cell_width = std::max(1, rounded(scale * width));
            cell_height = std::max(1, rounded(scale * height));
        }
        em = std::max(13.0, std::min(columns * cell_width / 74.0, cell_width / 13.0));
        gap = rounded(0.5 * em);
        names = sheet.view_names.empty() ? 0 : rounded(view_label_height(0.95 * em) + 0.1 * em);
    }
    int left(int place) const { return place % columns * (cell_width + gap); }
    int top(int place) const { return place / columns * (cell_height + names + gap); }
    int width() const { return left(columns - 1) + cell_width; }
};

/// Returns the place of a picture in reading order: +x +y +z over −x −y −z if the sheet has exactly these six, else its own number.
std::size_t place_of(const ContactSheet& sheet, std::size_t picture) {
    static constexpr std::array<std::string_view, 6> order{"+x", "+y", "+z", "-x", "-y", "-z"};
    const std::vector<std::string>& names = sheet.view_names;
    if (sheet.pictures.size() != order.size() || names.size() != order.size() ||
        !std::is_permutation(order.begin(), order.end(), names.begin()))
        return picture;
    return static_cast<std::size_t>(std::find(order.begin(), order.end(), names[picture]) - order.begin());
}

}   // namespace

SheetDrawing drawing_of(const FigureSheet& sheet) {
    const double em = sheet.em;
    int body_width = sheet.least_width, body_height = 0;
    const auto reach = [&](int right, int bottom) {
        body_width = std::max(body_width, right), body_height = std::max(body_height, bottom);
    };
    for (const FigureSheet::Picture& p : sheet.pictures) reach(p.left + p.image->width, p.top + p.image->height);
    for (const FigureSheet::Words& w : sheet.words) reach(w.left + w.width, w.top + w.height);
    const int margin = rounded(sheet.margin * em), legend_gap = sheet.color_bar ? rounded(0.8 * em) : 0;
    const int title = sheet.title.empty() ? 0 : rounded(1.9 * em), subtitle = sheet.subtitle.empty() ? 0 : rounded(1.5 * em);
    const int legend = sheet.color_bar ? color_bar_height(*sheet.color_bar, em) : 0;
    const int top = margin + title + subtitle, width = body_width + 2 * margin;
    SheetDrawing composed{
        {.width = width, .height = top + body_height + legend_gap + legend + margin, .background = sheet.background}, margin, top};
    Drawing& drawn = composed.drawing;

    const bool is_dark = sheet.background.a > 127 && lab_of(sheet.background).x < 50;
    const Rgba strong = is_dark ? Rgba{236, 236, 240, 255} : Rgba{34, 34, 40, 255};
    const Rgba soft = is_dark ? Rgba{170, 170, 178, 255} : Rgba{92, 92, 102, 255};
    const TextStyle large{1.35 * em, strong, Align::left, Weight::bold}, small{em, soft};
    drawn.add_text(margin, margin + 1.05 * em, fit_text(sheet.title, body_width, large), large);
    drawn.add_text(margin, margin + title + 0.8 * em, fit_text(sheet.subtitle, body_width, small), small);
    for (const FigureSheet::Picture& p : sheet.pictures) drawn.items.emplace_back(Drawing::Picture{p.image, margin + p.left, top + p.top});
    for (const FigureSheet::Words& words : sheet.words) add_words(drawn, words, margin, top, em, strong, sheet.up);
    if (sheet.color_bar) add_color_bar(drawn, *sheet.color_bar, margin, top + body_height + legend_gap, body_width, em, strong);
    return composed;
}

Image compose(const ContactSheet& sheet) {
    for (const Image& picture : sheet.pictures) {
        const Image& first = sheet.pictures.front();
        if (picture.width != first.width || picture.height != first.height || picture.width < 1 || picture.height < 1)
            throw std::invalid_argument("compose: the pictures of a sheet must be of one size and not empty, but one is " +
                                        std::to_string(picture.width) + "x" + std::to_string(picture.height) + ", the first " +
                                        std::to_string(first.width) + "x" + std::to_string(first.height));
    }
    const Grid grid(sheet);
    FigureSheet figure{.title = sheet.title,
                       .subtitle = sheet.subtitle,
                       .color_bar = sheet.color_bar,
                       .em = grid.em,
                       .least_width = grid.width(),
                       .background = sheet.background,
                       .up = sheet.up};
    for (std::size_t i = 0; i < sheet.pictures.size(); ++i) {
        const int place = static_cast<int>(place_of(sheet, i)), left = grid.left(place), top = grid.top(place);
        const Image& picture = sheet.pictures[i];
        const bool fits = picture.width == grid.cell_width && picture.height == grid.cell_height;
        const auto shared =
            fits ? std::shared_ptr<const Image>(std::shared_ptr<void>(), &picture)   // not owned: the sheet outlives the figure
                 : std::make_shared<const Image>(shrink(picture, grid.cell_width, grid.cell_height));
        figure.pictures.push_back({shared, left, top});
        const std::string name = i < sheet.view_names.size() ? sheet.view_names[i] : "";
        if (grid.names > 0) figure.words.push_back({name, left, top + grid.cell_height, grid.cell_width, grid.names});
    }
    return painted(drawing_of(figure).drawing);
}

}   // namespace render
