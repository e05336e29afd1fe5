#include "sheet/contact_sheet.h"

#include <algorithm>
#include <array>
#include <memory>
#include <stdexcept>

#include "rounding.h"
#include "sheet/figure_sheet.h"
#include "sheet/view_label.h"

namespace render {

namespace {

void check(const ContactSheet& sheet) {
    for (const Image& picture : sheet.pictures) {
        const Image& first = sheet.pictures.front();
        if (picture.width != first.width || picture.height != first.height || picture.width < 1 || picture.height < 1)
            throw std::invalid_argument("compose: the pictures of a sheet must be of one size, and not empty");
    }
}

/// Sizes of a view and its name in the sheet, in pixels.
struct Grid {
    int columns = 1;
    int cell_width = 400, cell_height = 0;   // of a sheet of words only
    double em = 16;                          // text size
    int group = 1;                           // pictures of one view
    int gap = 0, heads = 0, names = 0;       // heights of the lines above the first pictures, and of the view names below

    explicit Grid(const ContactSheet& sheet) {
        const int count = static_cast<int>(sheet.pictures.size());
        columns = sheet.columns > 0 ? sheet.columns : count == 4 ? 2 : std::clamp(count, 1, 3);
        if (count > 0) {
            const double width = sheet.pictures[0].width, height = sheet.pictures[0].height;
            const double scale = sheet.cell > 0 ? std::min(1.0, sheet.cell / std::max(width, height)) : 1.0;
            cell_width = std::max(1, rounded(scale * width));
            cell_height = std::max(1, rounded(scale * height));
        }
        em = sheet.em > 0 ? sheet.em : std::max(13.0, std::min(columns * cell_width / 74.0, cell_width / 13.0));
        gap = rounded(0.5 * em);
        group = std::max(1, static_cast<int>(sheet.heads.size()));
        heads = sheet.heads.empty() ? 0 : rounded((sheet.subheads.empty() ? 1.6 : 2.9) * em);
        names = sheet.view_names.empty() ? 0 : rounded(view_label_height(0.95 * em) + 0.1 * em);
    }
    /// Between groups the gap is three times that within.
    int left(int place) const { return place % columns * (cell_width + gap) + (group > 1 ? place % columns / group * 2 * gap : 0); }
    int top(int place) const { return heads + place / columns * (cell_height + names + gap); }
    int width() const { return left(columns - 1) + cell_width; }
    int group_width() const { return left(group - 1) + cell_width; }
};

/// +x +y +z over −x −y −z when these six are there, in the reading order otherwise.
std::size_t place_of(const ContactSheet& sheet, std::size_t picture) {
    static constexpr std::array<std::string_view, 6> order{"+x", "+y", "+z", "-x", "-y", "-z"};
    const std::vector<std::string>& names = sheet.view_names;
    if (sheet.columns > 0 || sheet.pictures.size() != order.size() || names.size() != order.size() ||
        !std::is_permutation(order.begin(), order.end(), names.begin()))
        return picture;
    return static_cast<std::size_t>(std::find(order.begin(), order.end(), names[picture]) - order.begin());
}

}   // namespace

Image compose(const ContactSheet& sheet) {
    check(sheet);
    const Grid grid(sheet);
    FigureSheet figure{.title = sheet.title,
                       .subtitle = sheet.subtitle,
                       .color_bar = sheet.color_bar,
                       .em = grid.em,
                       .least_width = grid.width(),
                       .background = sheet.background};
    for (std::size_t i = 0; i < sheet.pictures.size(); ++i) {
        const int place = static_cast<int>(place_of(sheet, i)), left = grid.left(place), top = grid.top(place);
        const Image& picture = sheet.pictures[i];
        const bool fits = picture.width == grid.cell_width && picture.height == grid.cell_height;
        const auto shared =
            fits ? std::shared_ptr<const Image>(std::shared_ptr<void>(), &picture)   // the sheet's, which outlives the figure
                 : std::make_shared<const Image>(shrink(picture, grid.cell_width, grid.cell_height));
        figure.pictures.push_back({shared, left, top});
        if (grid.names > 0 && place % grid.group == 0) {
            const std::string name = i < sheet.view_names.size() ? sheet.view_names[i] : "";
            figure.words.push_back({name, left, top + grid.cell_height, grid.group_width(), grid.names});
        }
        if (place >= grid.columns || grid.heads == 0) continue;
        const auto mesh = static_cast<std::size_t>(place % grid.group);
        const int line = rounded(1.3 * grid.em);
        figure.words.push_back({sheet.heads[mesh], left, 0, grid.cell_width, line});
        if (mesh < sheet.subheads.size()) figure.words.push_back({sheet.subheads[mesh], left, line, grid.cell_width, line});
    }
    return compose(figure).image;
}

}   // namespace render
