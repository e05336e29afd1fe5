#include "sheet/contact_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "color/cielab.h"
#include "rounding.h"
#include "sheet/color_bar.h"
#include "sheet/text.h"
#include "sheet/view_label.h"

namespace render {

namespace {

int count(std::size_t n) { return static_cast<int>(n); }

/// Text and faint lines against the background.
struct Inks {
    Rgba strong, soft;
};

Inks inks_on(Rgba background) {
    if (background.a > 127 && lab_of(background).x < 50) return {{236, 236, 240, 255}, {170, 170, 178, 255}};
    return {{34, 34, 40, 255}, {92, 92, 102, 255}};
}

void check(const ContactSheet& sheet) {
    for (const Image& picture : sheet.pictures) {
        const Image& first = sheet.pictures.front();
        if (picture.width != first.width || picture.height != first.height || picture.width < 1 || picture.height < 1)
            throw std::invalid_argument("compose: the pictures of a sheet must be of one size, and not empty");
    }
}

/// Where everything goes, in pixels.
struct Layout {
    int columns = 1, lines = 1;
    int cell_width = 0, cell_height = 0;
    double em = 16;   // text size
    int margin = 0, gap = 0;
    int title = 0, subtitle = 0;      // heights
    int names = 0;                    // height of the view names, below the pictures
    int legend_gap = 0, legend = 0;   // height of the colour bar

    int grid_width() const { return columns * cell_width + (columns - 1) * gap; }
    int width() const { return 2 * margin + grid_width(); }
    int grid_top() const { return margin + title + subtitle; }
    int line_height() const { return cell_height + names + gap; }
    int grid_bottom() const { return grid_top() + lines * line_height() - (lines > 0 ? gap : 0); }
    int height() const { return grid_bottom() + legend_gap + legend + margin; }
    int x_of(int column) const { return margin + column * (cell_width + gap); }
    int y_of(int line) const { return grid_top() + line * line_height(); }
};

int columns_of(const ContactSheet& sheet) { return sheet.pictures.size() == 4 ? 2 : std::clamp(count(sheet.pictures.size()), 1, 3); }

void set_cell(Layout& layout, const ContactSheet& sheet) {
    layout.cell_width = 400;   // a sheet of words only
    if (sheet.pictures.empty()) return;
    const double width = sheet.pictures[0].width, height = sheet.pictures[0].height;
    const double scale = sheet.cell > 0 ? std::min(1.0, sheet.cell / std::max(width, height)) : 1.0;
    layout.cell_width = std::max(1, rounded(scale * width));
    layout.cell_height = std::max(1, rounded(scale * height));
}

Layout layout_of(const ContactSheet& sheet) {
    Layout layout;
    layout.columns = columns_of(sheet);
    layout.lines = (count(sheet.pictures.size()) + layout.columns - 1) / layout.columns;
    set_cell(layout, sheet);
    const double em = std::max(13.0, std::min(layout.columns * layout.cell_width / 74.0, layout.cell_width / 13.0));
    layout.em = em;
    layout.margin = rounded(1.2 * em);
    layout.gap = rounded(0.5 * em);
    layout.title = sheet.title.empty() ? 0 : rounded(1.9 * em);
    layout.subtitle = sheet.subtitle.empty() ? 0 : rounded(1.5 * em);
    layout.names = sheet.view_names.empty() ? 0 : rounded(view_label_height(0.95 * em) + 0.1 * em);
    layout.legend_gap = sheet.color_bar ? rounded(0.8 * em) : 0;
    layout.legend = sheet.color_bar ? color_bar_height(*sheet.color_bar, em) : 0;
    return layout;
}

void draw_heading(Image& image, const ContactSheet& sheet, const Layout& layout, const Inks& inks) {
    const double em = layout.em, width = layout.width() - 2.0 * layout.margin;
    const TextStyle title{1.35 * em, inks.strong, Align::left, Weight::bold}, subtitle{em, inks.soft};
    draw_text(image, layout.margin, layout.margin + 1.05 * em, fit_text(sheet.title, width, title), title);
    draw_text(image, layout.margin, layout.margin + layout.title + 0.8 * em, fit_text(sheet.subtitle, width, subtitle), subtitle);
}

std::string name_of(const ContactSheet& sheet, std::size_t picture) {
    return picture < sheet.view_names.size() ? sheet.view_names[picture] : "";
}

/// +x +y +z over −x −y −z when these six are there, in the reading order otherwise.
std::size_t place_of(const ContactSheet& sheet, std::size_t picture) {
    static constexpr std::array<std::string_view, 6> order{"+x", "+y", "+z", "-x", "-y", "-z"};
    if (sheet.view_names.size() != order.size() || !std::is_permutation(order.begin(), order.end(), sheet.view_names.begin()))
        return picture;
    return static_cast<std::size_t>(std::find(order.begin(), order.end(), sheet.view_names[picture]) - order.begin());
}

void draw_cell(Image& image, const Image& picture, const Layout& layout, int x, int y) {
    if (picture.width == layout.cell_width && picture.height == layout.cell_height)
        paste(image, picture, x, y);
    else
        paste(image, shrink(picture, layout.cell_width, layout.cell_height), x, y);
}

void draw_name(Image& image, const Layout& layout, int x, int y, const std::string& name, const Inks& inks) {
    const double em = 0.95 * layout.em;
    const std::string fitted = fit_text(name, layout.cell_width, {em});
    draw_view_label(image, x + layout.cell_width / 2.0, y + layout.names / 2.0, fitted, em, inks.strong);
}

void draw_views(Image& image, const ContactSheet& sheet, const Layout& layout, const Inks& inks) {
    for (std::size_t i = 0; i < sheet.pictures.size(); ++i) {
        const int place = count(sheet.pictures.size() == 6 ? place_of(sheet, i) : i);
        const int x = layout.x_of(place % layout.columns), y = layout.y_of(place / layout.columns);
        draw_cell(image, sheet.pictures[i], layout, x, y);
        if (layout.names > 0) draw_name(image, layout, x, y + layout.cell_height, name_of(sheet, i), inks);
    }
}

}   // namespace

Image compose(const ContactSheet& sheet) {
    check(sheet);
    const Layout layout = layout_of(sheet);
    const Inks inks = inks_on(sheet.background);
    Image image(layout.width(), layout.height(), sheet.background);
    draw_heading(image, sheet, layout, inks);
    draw_views(image, sheet, layout, inks);
    if (sheet.color_bar)
        draw_color_bar(image, *sheet.color_bar, layout.margin, layout.grid_bottom() + layout.legend_gap, layout.width() - 2 * layout.margin,
                       layout.em, inks.strong);
    return image;
}

}   // namespace render
