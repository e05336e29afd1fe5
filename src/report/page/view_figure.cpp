#include "report/page/view_blocks.h"

#include <algorithm>
#include <cmath>

#include "base/base64.h"
#include "report/escape.h"
#include "report/page/view_value.h"
#include "report/writers.h"

namespace meshfolio::report {

namespace {

using nlohmann::json;

// Heights relative to the width of a figure: on paper 59, 44, 99 and 90 mm; one of the six views of a mesh has at least 27 mm.
constexpr double highest_lead = 0.34, highest_line = 0.25, highest_figure = 0.57, highest_matrix = 0.52, least_view = 0.155;
constexpr double lowest_row = 0.15, highest_page = 1.25;   // of a matrix: rows stay as high as this while they fit on a page
constexpr std::size_t most_across = 5;                     // of figure.css
constexpr int tenths_of_heads = 2;                         // of the width, beside the rows of a matrix: 24 mm on paper

/// The pictures of a figure, by panel p and picture i.
struct PictureOf {
    const Figure& figure;
    const DrawnFigure& drawn;
    const ViewContext& context;

    /// Returns the alternative text: that of the figure for the first picture, else panel and direction.
    std::string alt(std::size_t p, std::size_t i) const {
        const DrawnPicture& picture = drawn.panels[p].pictures[i];
        if (p == 0 && i == 0) return safe_text(figure.alt);
        const std::string label = context.numbering.resolve(figure.id).label, panel = safe_text(drawn.panels[p].label);
        return label + (panel.empty() ? "" : ": " + panel) + (picture.view.empty() ? "" : ", seen from " + safe_text(picture.direction()));
    }

    std::string source(std::size_t p, std::size_t i) const {
        const DrawnPicture& picture = drawn.panels[p].pictures[i];
        if (context.options.pictures && !picture.jpeg.empty()) return "data:image/jpeg;base64," + base64(picture.jpeg);
        return url_path(picture.file.empty() ? drawn.sheet : picture.file);
    }

    /// Returns the small colour bar of a panel with colours of its own as SVG; empty for others.
    std::string bar(std::size_t p) const {
        const std::optional<Legend>& legend = drawn.panels[p].legend;
        return legend ? svg_of(*legend, figure.id + "-" + std::to_string(p), true) : "";
    }

    json view(std::size_t p, std::size_t i) const {
        const DrawnPicture& picture = drawn.panels[p].pictures[i];
        return view_of({{"source", "what an <img> shows: a picture inside the page, else a file", source(p, i)},
                        {"alt", "the picture in words", alt(p, i)},
                        {"width", "of the picture [pixels]", std::to_string(picture.width)},
                        {"height", "of the picture [pixels]", std::to_string(picture.height)},
                        {"view", "the direction it is seen from: \"+x\"", safe_text(picture.direction())},
                        {"has_file", "it is a file of its own in full size", !picture.file.empty()},
                        {"href", "link to that file", url_path(picture.file)}});
    }
};

/// Returns a panel as a cell of a line or a matrix: its three-quarter picture and its label. @param across  columns that it spans
json cell_view(const PictureOf& of, std::size_t p, std::size_t across) {
    const DrawnPanel& panel = of.drawn.panels[p];
    return view_of({{"has_picture", "it shows a mesh; an empty cell's label says why there is none", !panel.pictures.empty()},
                    {"picture", "seen from three quarters; false: there is none", panel.pictures.empty() ? json(false) : of.view(p, 0)},
                    {"label", "what it shows", prose_view(panel.label)},
                    {"has_label", "it has one", !panel.label.empty()},
                    {"bar", "its own colours: SVG; empty: those of the figure", of.bar(p)},
                    {"across", "columns of a matrix that it takes", std::to_string(across)}});
}

/// Returns the large picture of a panel and its six views: in two lines if it is the only panel, else in one.
json block_view(const PictureOf& of, std::size_t p) {
    const DrawnPanel& panel = of.drawn.panels[p];
    const bool alone = of.drawn.panels.size() == 1, flat = panel.is_flat();
    const std::size_t in_a_line = alone ? 3 : 6;
    double width = panel.pictures[0].width, side = 0;
    json lines = json::array();
    for (std::size_t i = 1; i < panel.pictures.size(); ++i) {
        if (i <= in_a_line) width += panel.pictures[i].width;
        side = std::max<double>({side, double(panel.pictures[i].width), double(panel.pictures[i].height)});
        if (i % in_a_line == 1) lines.push_back(view_of({{"views", "pictures of a line", json::array()}}));
        lines.back()["views"].push_back(of.view(p, i));
    }
    const double least = side > 0 ? std::min(10.0, std::ceil(10 * least_view * width / side)) : 10;
    const int share = flat ? (alone ? 4 : 9) : std::max(2, static_cast<int>(least));
    return view_of(
        {{"lead", "the large picture", of.view(p, 0)},
         {"label", "of the panel", prose_view(panel.label)},
         {"has_label", "it has one", (flat || !alone) && !panel.label.empty()},
         {"bar", "its own colours: SVG; empty: those of the figure", of.bar(p)},
         {"is_flat", "seen from its front alone; the next flat ones lie beside it", flat && !alone},
         {"is_further", "it shows the mesh of the block before", p % static_cast<std::size_t>(std::max(1, of.drawn.states)) != 0},
         {"tenths", "of the block's width that the pictures take", std::to_string(share)},
         {"view_lines", "its views, line by line", std::move(lines)}});
}

/// Returns the panels line by line, those of a matrix behind their heads. Cells that are empty for the same reason are joined.
json lines_view(const PictureOf& of) {
    json lines = json::array();
    const auto columns = static_cast<std::size_t>(std::max(1, of.drawn.in_a_line));
    for (std::size_t first = 0; first < of.drawn.panels.size(); first += columns) {
        json cells = json::array();
        const std::size_t last = std::min(first + columns, of.drawn.panels.size());
        for (std::size_t p = first, across = 1; p < last; p += across) {
            across = 1;
            const auto is_alike = [&, &panels = of.drawn.panels](std::size_t next) {
                return panels[p].pictures.empty() && panels[next].pictures.empty() && panels[next].label == panels[p].label;
            };
            while (across < most_across && p + across < last && is_alike(p + across)) ++across;
            cells.push_back(cell_view(of, p, across));
        }
        const std::size_t row = first / columns;
        lines.push_back(view_of({{"head", "of a row of a matrix", prose_view(row < of.drawn.rows.size() ? of.drawn.rows[row] : "")},
                                 {"cells", "of the line", std::move(cells)}}));
    }
    return lines;
}

void enter_legend(json& view, const DrawnFigure& drawn, const std::string& place) {
    enter(view, {{"legend", "what the colours mean: SVG", drawn.legend ? svg_of(*drawn.legend, place) : ""},
                 {"has_legend", "there are colours", drawn.legend.has_value()}});
}

/// Returns the tenths of the text width that lines of panels take: as many as their height allows.
int tenths_of_lines(const DrawnFigure& drawn) {
    int width = 1, height = 0;
    for (const DrawnPanel& panel : drawn.panels) {
        if (panel.pictures.empty()) continue;
        width = std::max(width, panel.pictures[0].width);
        height = std::max(height, panel.pictures[0].height);
    }
    const int columns = std::max(1, drawn.in_a_line);
    const double lines = std::ceil(static_cast<double>(drawn.panels.size()) / columns);
    const bool alone = drawn.panels.size() == 1;
    const double row = std::min(std::max(highest_matrix / lines, lowest_row), highest_page / lines);
    const double highest = alone ? highest_lead : std::min(highest_line, drawn.rows.empty() ? highest_figure / lines : row);
    const bool bars = std::ranges::any_of(drawn.panels, [](const DrawnPanel& panel) { return panel.legend.has_value(); });
    const double room = bars ? 1.7 : 1;   // small bars are wider than their pictures
    const double share = height > 0 ? std::floor(10 * highest * (room * columns * width) / height) : 10;
    return std::min(10, static_cast<int>(std::clamp(share, 2.0, 10.0)) + (drawn.rows.empty() ? 0 : tenths_of_heads));
}

}   // namespace

void enter_pictures(json& view, const Figure& figure, const DrawnFigure& drawn, const ViewContext& context) {
    const PictureOf of{figure, drawn, context};
    const auto has_views = [](const DrawnPanel& panel) { return panel.pictures.size() > 1 || panel.is_flat(); };
    const bool is_drawn = context.figures.contains(figure.id), has_blocks = std::ranges::any_of(drawn.panels, has_views);
    json blocks = json::array(), heads = list_of(drawn.columns, [](const std::string&words) {
                                     return view_of({{"head", "of a column of a matrix", prose_view(words)}});
                                 });
    for (std::size_t p = 0; has_blocks && p < drawn.panels.size(); ++p)
        if (!drawn.panels[p].pictures.empty()) blocks.push_back(block_view(of, p));
    enter(view, {{"alt", "the pictures in words", safe_text(figure.alt)},
                 {"is_drawn", "there are pictures", is_drawn},
                 {"sheet", "the file that holds them all, relative to the report", url_path(drawn.sheet)},
                 {"is_lines", "`lines` of pictures from three quarters", !has_blocks && !drawn.panels.empty() && !drawn.is_matrix()},
                 {"is_matrix", "`lines` with heads", drawn.is_matrix()},
                 {"lines", "panels beside each other", has_blocks ? json::array() : lines_view(of)},
                 {"column_count", "of the lines, or blocks beside each other", std::to_string(std::max(1, drawn.in_a_line))},
                 {"tenths", "of the width that the lines take", std::to_string(tenths_of_lines(drawn))},
                 {"has_row_heads", "of a matrix", !drawn.rows.empty()}});
    enter_legend(view, drawn, figure.id);
    enter_list(view, "heads", "of the columns of a matrix", std::move(heads));
    enter_list(view, "blocks", "panels that are seen from six directions as well", std::move(blocks));
}

json strip_view(const Figure& figure, const DrawnFigure& drawn, const ViewContext& context) {
    constexpr std::size_t most = 4;
    json cells = json::array();
    for (std::size_t p = 0; p < std::min(most, drawn.panels.size()); ++p) cells.push_back(cell_view({figure, drawn, context}, p, 1));
    json view = captioned_view(figure.id, figure.caption, context);
    enter(view, {{"cells", "its first panels", std::move(cells)}});
    enter_legend(view, drawn, "strip");
    return view;
}

json cover_view(const Figure& figure, const ViewContext& context) {
    const DrawnFigure& drawn = context.figures.at(figure.id);
    const DrawnPanel& panel = drawn.panels.front();
    const Legend& legend = panel.legend ? *panel.legend : *drawn.legend;
    json view = PictureOf{figure, drawn, context}.view(0, 0);
    enter(view, {{"sheet", "its file, relative to the report", url_path(drawn.sheet)},
                 {"has_size", "width and height are known", panel.pictures.front().width > 0},
                 {"label", "what it shows", prose_view(panel.label.empty() ? legend.quantity : panel.label)},
                 {"legend", "what the colours mean: SVG", svg_of(legend, "cover")}});
    return view;
}

}   // namespace meshfolio::report
