#include "sheet/contact_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "color/cielab.h"
#include "rounding.h"
#include "sheet/color_bar.h"
#include "sheet/strokes.h"
#include "sheet/text.h"
#include "sheet/view_label.h"

namespace render {

namespace {

int count(std::size_t n) { return static_cast<int>(n); }

/// Text and faint lines against the background.
struct Inks {
    Rgba strong, soft, faint;
};

Inks inks_on(Rgba background) {
    if (background.a > 127 && lab_of(background).x < 50) return {{236, 236, 240, 255}, {170, 170, 178, 255}, {80, 80, 86, 255}};
    return {{34, 34, 40, 255}, {92, 92, 102, 255}, {226, 226, 230, 255}};
}

/// "20 iterations" and "λ = 0.1" read badly over two lines.
bool holds_together(const std::string& text, std::size_t space) {
    const auto is = [&](std::size_t i, const char* these) { return i < text.size() && std::strchr(these, text[i]) != nullptr; };
    return space > 0 && (is(space - 1, "0123456789=") || is(space + 1, "=")) && !is(space + 1, "(");
}

/// `text` broken at spaces into lines of at most `width`, the last one longer where there are too many; `anywhere`: also at spaces
/// that hold their words together.
std::vector<std::string> broken(const std::string& text, double width, const TextStyle& style, std::size_t most_lines, bool anywhere) {
    std::vector<std::string> lines;
    std::string line;
    std::size_t begin = 0;
    while (begin < text.size()) {
        std::size_t end = text.find(' ', begin);
        while (!anywhere && end < text.size() && holds_together(text, end)) end = text.find(' ', end + 1);
        end = std::min(end, text.size());
        const std::string word = text.substr(begin, end - begin), longer = line.empty() ? word : std::string(line).append(" ").append(word);
        if (!line.empty() && text_width(longer, style) > width && lines.size() + 1 < most_lines) {
            lines.push_back(line);
            line = word;
        } else {
            line = longer;
        }
        begin = end + 1;
    }
    if (!line.empty()) lines.push_back(line);
    return lines;
}

double widest_of(const std::vector<std::string>& lines, const TextStyle& style) {
    double widest = 0;
    for (const std::string& line : lines) widest = std::max(widest, text_width(line, style));
    return widest;
}

/// Lines about equally long, not more of them than are needed; shortened to `width` where even these are too few.
std::vector<std::string> wrapped(const std::string& text, double width, const TextStyle& style, std::size_t most_lines) {
    std::vector<std::string> lines = broken(text, width, style, most_lines, false);
    const bool anywhere = widest_of(lines, style) > width;
    if (anywhere) lines = broken(text, width, style, most_lines, true);
    double narrower = width - style.size / 2;
    while (narrower > style.size) {
        std::vector<std::string> tried = broken(text, narrower, style, most_lines, anywhere);
        if (tried.size() > lines.size() || widest_of(tried, style) > narrower) break;
        lines = std::move(tried);
        narrower -= style.size / 2;
    }
    for (std::string& line : lines) line = fit_text(line, width, style);
    return lines;
}

void check(const ContactSheet& sheet) {
    const Image* first = nullptr;
    for (const SheetRow& row : sheet.rows)
        for (const Image& picture : row.pictures) {
            if (first == nullptr) first = &picture;
            if (picture.width != first->width || picture.height != first->height || picture.width < 1 || picture.height < 1)
                throw std::invalid_argument("compose: the pictures of a sheet must be of one size, and not empty");
        }
}

/// The line under the title; a single row has its label there.
std::string subtitle_of(const ContactSheet& sheet) {
    const std::string label = sheet.rows.size() == 1 ? sheet.rows[0].label : "";
    return sheet.subtitle + (sheet.subtitle.empty() || label.empty() ? "" : " · ") + label;
}

/// Where everything goes, in pixels.
struct Layout {
    bool single = false;   // one row of pictures, folded into a grid with the names below
    int columns = 1, lines = 1;
    int cell_width = 0, cell_height = 0;
    double em = 16;   // text size
    int margin = 0, gap = 0;
    int title = 0, subtitle = 0;      // heights
    int label_width = 0;              // of the row labels, on the left
    int names = 0;                    // height of the view names: below each picture of a single row, else above the columns
    int legend_gap = 0, legend = 0;   // height of the colour bar

    int grid_width() const { return columns * cell_width + (columns - 1) * gap; }
    int width() const { return 2 * margin + label_width + grid_width(); }
    int grid_top() const { return margin + title + subtitle + (single ? 0 : names); }
    int line_height() const { return cell_height + (single ? names : 0) + gap; }
    int grid_bottom() const { return grid_top() + lines * line_height() - (lines > 0 ? gap : 0); }
    int height() const { return grid_bottom() + legend_gap + legend + margin; }
    int x_of(int column) const { return margin + label_width + column * (cell_width + gap); }
    int y_of(int line) const { return grid_top() + line * line_height(); }
};

int columns_of(const ContactSheet& sheet) {
    std::size_t most = 0;
    for (const SheetRow& row : sheet.rows) most = std::max(most, row.pictures.size());
    if (sheet.rows.size() != 1) return std::max(1, count(most));
    if (most > static_cast<std::size_t>(largest_block)) return 6;
    return most == 4 ? 2 : std::clamp(count(most), 1, 3);
}

void set_cell(Layout& layout, const ContactSheet& sheet) {
    for (const SheetRow& row : sheet.rows) {
        if (row.pictures.empty()) continue;
        const double width = row.pictures[0].width, height = row.pictures[0].height;
        const double scale = sheet.cell > 0 ? std::min(1.0, sheet.cell / std::max(width, height)) : 1.0;
        layout.cell_width = std::max(1, rounded(scale * width));
        layout.cell_height = std::max(1, rounded(scale * height));
        return;
    }
    layout.cell_width = 400;   // a sheet of words only
}

/// Room for the row labels: what the longest needs, within a tenth of the pictures or so.
int label_width_of(const ContactSheet& sheet, double em, int grid_width) {
    double widest = 0;
    for (const SheetRow& row : sheet.rows)
        widest = std::max(widest, widest_of(wrapped(row.label, std::max(9 * em, 0.11 * grid_width), {em}, 4), {em}));
    return widest > 0 ? static_cast<int>(std::ceil(widest + em)) : 0;
}

Layout layout_of(const ContactSheet& sheet) {
    Layout layout;
    layout.single = sheet.rows.size() == 1;
    layout.columns = columns_of(sheet);
    layout.lines = layout.single ? (count(sheet.rows[0].pictures.size()) + layout.columns - 1) / layout.columns : count(sheet.rows.size());
    set_cell(layout, sheet);
    const double em = std::max(13.0, std::min(layout.columns * layout.cell_width / 74.0, layout.cell_width / 13.0));
    layout.em = em;
    layout.margin = rounded(1.2 * em);
    layout.gap = rounded(0.5 * em);
    layout.title = sheet.title.empty() ? 0 : rounded(1.9 * em);
    layout.subtitle = subtitle_of(sheet).empty() ? 0 : rounded(1.5 * em);
    layout.names = sheet.view_names.empty() ? 0 : rounded(view_label_height(0.95 * em) + 0.1 * em);
    layout.label_width = layout.single ? 0 : label_width_of(sheet, em, layout.grid_width());
    layout.legend_gap = sheet.color_bar ? rounded(0.8 * em) : 0;
    layout.legend = sheet.color_bar ? color_bar_height(*sheet.color_bar, em) : 0;
    return layout;
}

void draw_heading(Image& image, const ContactSheet& sheet, const Layout& layout, const Inks& inks) {
    const double em = layout.em, width = layout.width() - 2.0 * layout.margin;
    const TextStyle title{1.35 * em, inks.strong, Align::left, Weight::bold}, subtitle{em, inks.soft};
    draw_text(image, layout.margin, layout.margin + 1.05 * em, fit_text(sheet.title, width, title), title);
    draw_text(image, layout.margin, layout.margin + layout.title + 0.8 * em, fit_text(subtitle_of(sheet), width, subtitle), subtitle);
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

void draw_single_row(Image& image, const ContactSheet& sheet, const Layout& layout, const Inks& inks) {
    const SheetRow& row = sheet.rows[0];
    for (std::size_t i = 0; i < row.pictures.size(); ++i) {
        const int place = count(row.pictures.size() == 6 ? place_of(sheet, i) : i);
        const int x = layout.x_of(place % layout.columns), y = layout.y_of(place / layout.columns);
        draw_cell(image, row.pictures[i], layout, x, y);
        if (layout.names > 0) draw_name(image, layout, x, y + layout.cell_height, name_of(sheet, i), inks);
    }
}

void draw_label(Image& image, const std::string& label, const Layout& layout, double middle, const Inks& inks) {
    const TextStyle style{layout.em, inks.strong};
    const std::vector<std::string> lines = wrapped(label, layout.label_width - 0.8 * layout.em, style, 4);
    double baseline = middle + 0.27 * layout.em - 0.62 * layout.em * (count(lines.size()) - 1);
    for (const std::string& line : lines) {
        draw_text(image, layout.margin, baseline, line, style);
        baseline += 1.24 * layout.em;
    }
}

void draw_rows(Image& image, const ContactSheet& sheet, const Layout& layout, const Inks& inks) {
    for (int r = 0; r < layout.lines; ++r) {
        const SheetRow& row = sheet.rows[static_cast<std::size_t>(r)];
        const int y = layout.y_of(r);
        for (int c = 0; c < count(row.pictures.size()); ++c)
            draw_cell(image, row.pictures[static_cast<std::size_t>(c)], layout, layout.x_of(c), y);
        draw_label(image, row.label, layout, y + layout.cell_height / 2.0, inks);
        fill_rectangle(image, layout.margin, y - layout.gap / 2 - 1, layout.width() - layout.margin, y - layout.gap / 2, inks.faint);
    }
    for (int c = 0; layout.names > 0 && c < layout.columns; ++c)
        draw_name(image, layout, layout.x_of(c), layout.grid_top() - layout.names, name_of(sheet, static_cast<std::size_t>(c)), inks);
}

}   // namespace

Image compose(const ContactSheet& sheet) {
    check(sheet);
    const Layout layout = layout_of(sheet);
    const Inks inks = inks_on(sheet.background);
    Image image(layout.width(), layout.height(), sheet.background);
    draw_heading(image, sheet, layout, inks);
    if (layout.single)
        draw_single_row(image, sheet, layout, inks);
    else
        draw_rows(image, sheet, layout, inks);
    if (sheet.color_bar)
        draw_color_bar(image, *sheet.color_bar, layout.margin, layout.grid_bottom() + layout.legend_gap, layout.width() - 2 * layout.margin,
                       layout.em, inks.strong);
    return image;
}

}   // namespace render
