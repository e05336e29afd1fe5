#include "report/page/view_figure.h"

#include <algorithm>
#include <cmath>

#include "report/escape.h"
#include "report/page/view_value.h"
#include "report/svg/svg_legend.h"

namespace meshfolio::report {

namespace {

using nlohmann::json;

constexpr std::size_t most_in_a_line = 4, gallery = 12, gallery_line = 6, views_in_a_group = 3;
// Against the width of the text, on paper 59, 44, 99 and 23 mm.
constexpr double highest_lead = 0.34, highest_line = 0.25, highest_figure = 0.57, highest_row = 0.135;

bool has_views(const DrawnPanel& panel) { return panel.pictures.size() > 1; }

/// Which of a figure's pictures.
struct PictureOf {
    const Figure& figure;
    const DrawnFigure& drawn;
    const ViewContext& context;

    /// The words that only a picture of the panel needs: its direction, its panel.
    std::string alt(std::size_t p, std::size_t i) const {
        const DrawnPicture& picture = drawn.panels[p].pictures[i];
        if (p == 0 && i == 0) return safe_text(figure.alt);
        const std::string label = context.numbering.resolve(figure.id).label, panel = safe_text(drawn.panels[p].label);
        return label + (panel.empty() ? "" : ": " + panel) + (picture.view.empty() ? "" : ", seen from " + safe_text(picture.view));
    }

    std::string source(std::size_t p, std::size_t i) const {
        const DrawnPicture& picture = drawn.panels[p].pictures[i];
        if (context.options.print_files) return url_path(print_file(figure.id, p, i));
        if (context.options.pictures && !picture.jpeg.empty()) return "data:image/jpeg;base64," + base64(picture.jpeg);
        return url_path(picture.file.empty() ? drawn.sheet : picture.file);
    }

    json view(std::size_t p, std::size_t i) const {
        const DrawnPicture& picture = drawn.panels[p].pictures[i];
        return view_of({{"source", "what an <img> shows: a picture inside the page, else a file", source(p, i)},
                        {"alt", "the picture in words", alt(p, i)},
                        {"width", "of the picture [pixels]", std::to_string(picture.width)},
                        {"height", "of the picture [pixels]", std::to_string(picture.height)},
                        {"view", "the direction it is seen from: \"+x\"", safe_text(picture.view)},
                        {"has_file", "it is a file of its own in full size", !picture.file.empty()},
                        {"href", "link to that file", url_path(picture.file)}});
    }
};

/// A panel as a cell of a line or of a matrix: its picture from three quarters and its label.
json cell_view(const PictureOf& of, std::size_t p) {
    const DrawnPanel& panel = of.drawn.panels[p];
    return view_of({{"has_picture", "it shows a mesh; an empty cell's label says why there is none", !panel.pictures.empty()},
                    {"picture", "seen from three quarters; false: there is none", panel.pictures.empty() ? json(false) : of.view(p, 0)},
                    {"label", "what it shows", prose_view(panel.label)},
                    {"has_label", "it has one", !panel.label.empty()}});
}

/// Tenths of the width that pictures so wide and so high together may take, so as not to be higher than a share of that width.
int tenths(double width, double height, double highest) {
    if (!(height > 0) || !(width > 0)) return 10;
    return std::clamp(static_cast<int>(std::floor(10 * highest * width / height)), 2, 10);
}

/// Of the six views in a row.
int tenths_of_row(const DrawnPanel& panel) {
    double width = 0, height = 0;
    for (std::size_t i = 1; i < panel.pictures.size(); ++i) {
        width += panel.pictures[i].width;
        height = std::max<double>(height, panel.pictures[i].height);
    }
    return tenths(width, height, highest_row);
}

/// The directions of a panel, three by three: beside each other where there is room.
json views_view(const PictureOf& of, std::size_t p) {
    json groups = json::array();
    for (std::size_t i = 1; i < of.drawn.panels[p].pictures.size(); ++i) {
        if (groups.empty() || groups.back()["views"].size() == views_in_a_group)
            groups.push_back(view_of({{"views", "pictures of a group", json::array()}}));
        groups.back()["views"].push_back(of.view(p, i));
    }
    return view_of({{"label", "of the panel", prose_view(of.drawn.panels[p].label)},
                    {"has_label", "it has one", of.drawn.panels.size() > 1 && !of.drawn.panels[p].label.empty()},
                    {"tenths", "of the width that the pictures take", std::to_string(tenths_of_row(of.drawn.panels[p]))},
                    {"groups", "its views, three by three", std::move(groups)}});
}

json head_view(const std::string& words) { return view_of({{"head", "of a column of a matrix", prose_view(words)}}); }

/// Lines about equally full; many panels are small.
std::size_t columns_of(const DrawnFigure& drawn) {
    const std::size_t panels = drawn.panels.size();
    if (!drawn.columns.empty()) return drawn.columns.size();
    if (!drawn.rows.empty()) return std::max<std::size_t>(1, panels / drawn.rows.size());
    if (drawn.layout == DrawnFigure::Layout::comparison) return std::max<std::size_t>(1, panels);
    if (panels > gallery && !has_views(drawn.panels[0])) return gallery_line;
    const std::size_t lines = std::max<std::size_t>(1, (panels + most_in_a_line - 1) / most_in_a_line);
    return std::max<std::size_t>(1, (panels + lines - 1) / lines);
}

/// Its panels line by line, the heads of matrices before them.
json lines_view(const PictureOf& of) {
    json lines = json::array();
    const std::size_t columns = columns_of(of.drawn);
    for (std::size_t first = 0; first < of.drawn.panels.size(); first += columns) {
        json cells = json::array();
        for (std::size_t p = first; p < std::min(first + columns, of.drawn.panels.size()); ++p) cells.push_back(cell_view(of, p));
        const std::size_t row = first / columns;
        lines.push_back(view_of({{"head", "of a row of a matrix", prose_view(row < of.drawn.rows.size() ? of.drawn.rows[row] : "")},
                                 {"cells", "of the line", std::move(cells)}}));
    }
    return lines;
}

/// Of everything but such rows.
int tenths_of(const DrawnFigure& drawn) {
    if (drawn.panels.empty()) return 10;
    double width = 1, line = 0, highest = highest_lead;
    const auto largest = [&](auto member) {
        int most = 0;
        for (const DrawnPanel& panel : drawn.panels)
            for (const DrawnPicture& picture : panel.pictures) most = std::max(most, picture.*member);
        return most;
    };
    const DrawnPanel& first = drawn.panels[0];
    if (drawn.panels.size() == 1 && has_views(first)) {
        double views_width = 0, views_height = 0;
        for (std::size_t i = 1; i < first.pictures.size(); ++i) {
            if (i <= views_in_a_group) views_width += first.pictures[i].width;
            views_height = std::max<double>(views_height, first.pictures[i].height);
        }
        width = first.pictures[0].width + views_width;
        line = std::max<double>(first.pictures[0].height, 2 * views_height);
    } else {
        const std::size_t columns = columns_of(drawn);
        width = static_cast<double>(columns) * largest(&DrawnPicture::width);
        line = largest(&DrawnPicture::height);
        const auto lines = static_cast<double>((drawn.panels.size() + columns - 1) / columns);
        highest = std::min(highest_line, highest_figure / lines);
    }
    return tenths(width, line, highest);
}

}   // namespace

void enter_pictures(json& view, const Figure& figure, const DrawnFigure& drawn, const ViewContext& context) {
    using Layout = DrawnFigure::Layout;
    const PictureOf of{figure, drawn, context};
    const bool is_drawn = context.figures.contains(figure.id), any = is_drawn && !drawn.panels.empty();
    const bool alone = any && drawn.panels.size() == 1 && has_views(drawn.panels[0]) && drawn.layout == Layout::panels;
    json rows = json::array(), columns = list_of(drawn.columns, head_view);
    for (std::size_t p = 0; any && p < drawn.panels.size(); ++p)
        if (has_views(drawn.panels[p])) rows.push_back(views_view(of, p));
    enter(view, {{"alt", "the pictures in words", safe_text(figure.alt)},
                 {"is_drawn", "there are pictures", is_drawn},
                 {"sheet", "the file that holds them all, relative to the report", url_path(drawn.sheet)},
                 {"is_lead", "one mesh: a large picture, `lead`, and beside it the views of `view_rows`", alone},
                 {"is_lines", "several: pictures from three quarters line by line, and below them `view_rows`",
                  any && !alone && drawn.layout == Layout::panels},
                 {"is_matrix", "lines with heads", any && drawn.layout == Layout::matrix},
                 {"is_comparison", "before beside after, and their difference if there is one: the cells of the only line",
                  any && drawn.layout == Layout::comparison},
                 {"lead", "the large picture of one mesh", alone ? of.view(0, 0) : json(false)},
                 {"lines", "panels beside each other", any && !alone ? lines_view(of) : json::array()},
                 {"column_count", "of the lines", std::to_string(any ? columns_of(drawn) : 1)},
                 {"tenths", "of the width that the pictures take", std::to_string(tenths_of(drawn))},
                 {"legend", "what the colours mean: SVG", drawn.legend ? svg_of(*drawn.legend) : ""},
                 {"has_legend", "there are colours", drawn.legend.has_value()},
                 {"has_row_heads", "of a matrix", !drawn.rows.empty()}});
    enter_list(view, "heads", "of the columns of a matrix", std::move(columns));
    enter_list(view, "view_rows", "views of a panel each", std::move(rows));
}

json cover_view(const Figure& cover, const ViewContext& context) {
    const auto it = context.figures.find(cover.id);
    const bool is_drawn = it != context.figures.end() && !it->second.panels.empty() && !it->second.panels[0].pictures.empty();
    const DrawnFigure drawn = is_drawn ? it->second : DrawnFigure{.panels = {{.pictures = {{}}}}};
    const PictureOf of{cover, drawn, context};
    const DrawnPicture& picture = drawn.panels[0].pictures[0];
    return view_of({{"alt", "the picture in words", safe_text(cover.alt)},
                    {"is_drawn", "there is a picture", is_drawn},
                    {"sheet", "its file, relative to the report", url_path(drawn.sheet)},
                    {"source", "what an <img> shows", of.source(0, 0)},
                    {"has_size", "width and height are known", picture.width > 0 && picture.height > 0},
                    {"width", "of the picture [pixels]", std::to_string(picture.width)},
                    {"height", "of the picture [pixels]", std::to_string(picture.height)},
                    {"legend", "what the colours mean: SVG", drawn.legend ? svg_of(*drawn.legend) : ""},
                    {"has_legend", "there are colours", drawn.legend.has_value()}});
}

std::string print_file(const std::string& figure, std::size_t panel, std::size_t picture) {
    return "figures/" + figure + "_" + std::to_string(panel) + "_" + std::to_string(picture) + ".jpg";
}

}   // namespace meshfolio::report
