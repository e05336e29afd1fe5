/// @file
/// The keys of plots, maps, diagrams and figures in results.json, described as in json_fields.h.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "report/json/json_entries.h"

namespace meshfolio::report {

inline std::string table_file(const std::string& id) { return "tables/" + id + ".csv"; }

void describe(auto& fields, part_of<Range> auto& range) {
    fields("low", range.low);
    fields("high", range.high);
}

// ---- plots and maps -----------------------------------------------------------------------------------------------------

void describe(auto& fields, part_of<Series> auto& series) {
    fields("name", series.name);
    fields.optional("style", series.style, Series::Style::line);
    fields.optional("color", series.color, -1, {"number of the colour, of six; absent: by the place of the series", 0});
    fields.optional("pattern", series.pattern, -1,
                    {"number of the dashes and the point shape, of seven; absent: by the place of the series", 0});
    fields.optional("panel", series.panel, {}, "series of one panel share a small plot; absent: one plot for all");
    fields("x", series.x);
    fields("y", series.y);
    fields.optional("y_low", series.y_low, {});
    fields.optional("y_high", series.y_high, {});
}

void describe(auto& fields, part_of<Marker> auto& marker) {
    fields("x", marker.x);
    fields("y", marker.y);
    fields("label", marker.label);
    fields.optional("panel", marker.panel, {});
}

void describe(auto& fields, part_of<Plot::VerticalLine> auto& line) {
    fields("x", line.x);
    fields("label", line.label);
}

/// Describes the keys that plots and maps have in common: id, caption, alt, file, x_label, y_label.
void describe_drawing(auto& fields, auto& drawing) {
    fields("id", drawing.id);
    fields("caption", drawing.caption);
    fields("alt", drawing.alt);
    fields.derived("file", [&] { return table_file(drawing.id); });
    fields("x_label", drawing.x_label);
    fields("y_label", drawing.y_label);
}

void describe(auto& fields, part_of<Plot> auto& plot) {
    describe_drawing(fields, plot);
    fields("log_x", plot.log_x);
    fields("log_y", plot.log_y);
    fields("series", plot.series);
    fields("markers", plot.markers);
    fields("vertical_lines", plot.vertical_lines);
}

void describe(auto& fields, part_of<PanelEntry> auto& panel) {
    fields("title", panel.title);
    fields("values", panel.rows, "a row for each y, a number for each x");
    fields("lines", panel.lines);
    fields("markers", panel.markers);
}

void describe(auto& fields, part_of<Map> auto& map) {
    const Map fallback;
    describe_drawing(fields, map);
    fields("value_label", map.value_label);
    fields("log_x", map.log_x);
    fields("log_y", map.log_y);
    fields("log_values", map.log_values);
    fields.optional("colours", map.colours, fallback.colours);
    fields.optional("middle", map.middle, fallback.middle, "where a diverging map is palest");
    fields.optional("range", map.range, "of the colours; absent: all finite values");
    fields("undefined", map.undefined, "meaning of cells without a value");
    fields("x", map.x);
    fields("y", map.y);
    std::vector<PanelEntry> panels = panel_entries(map);
    fields("panels", panels);
    if constexpr (!std::is_const_v<std::remove_reference_t<decltype(map)>>) {   // the reader
        map.panels.clear();
        for (PanelEntry& entry : panels) {
            const auto is_whole = [&](const std::vector<double>& row) { return row.size() == map.x.size(); };
            fields.require(entry.rows.size() == (map.x.empty() ? 0 : map.y.size()) && std::ranges::all_of(entry.rows, is_whole), "panels",
                           "has not a row for each y and a number for each x");
            Map::Panel& panel = map.panels.emplace_back(Map::Panel{entry.title, {}, std::move(entry.lines), std::move(entry.markers)});
            for (const std::vector<double>& row : entry.rows) panel.values.insert(panel.values.end(), row.begin(), row.end());
        }
    }
}

// ---- diagrams -----------------------------------------------------------------------------------------------------------

void describe(auto& fields, part_of<Diagram::Path> auto& path) {
    fields.optional("style", path.style, Diagram::Style::line);
    fields.optional("closed", path.closed, false);
    fields.optional("arrow", path.arrow, false, "a head at its last point");
    fields("x", path.x);
    fields("y", path.y);
}

void describe(auto& fields, part_of<Diagram::Label> auto& label) {
    fields("x", label.x);
    fields("y", label.y);
    fields("words", label.words);
    fields.optional("side", label.side, Diagram::Side::above, "of its point, on which it stands");
    fields.optional("dot", label.dot, false, "the point is marked");
    fields.optional("accent", label.accent, false);
}

void describe(auto& fields, part_of<Diagram::Panel> auto& panel) {
    fields("title", panel.title);
    fields("paths", panel.paths);
    fields("labels", panel.labels);
}

void describe(auto& fields, part_of<Diagram> auto& diagram) {
    fields("id", diagram.id);
    fields("caption", diagram.caption);
    fields("alt", diagram.alt);
    fields("panels", diagram.panels);
}

// ---- figures ------------------------------------------------------------------------------------------------------------

void describe(auto& fields, part_of<DrawnPicture> auto& picture) {
    fields.optional("view", picture.view, {}, "the direction it is seen from; absent: three quarters");
    fields("left", picture.left, {"in the sheet [pixels]", 0});
    fields("top", picture.top, {"", 0});
    fields("width", picture.width, {"", 1});
    fields("height", picture.height, {"", 1});
    fields.optional("file", picture.file, {}, file_note());
}

void describe(auto& fields, part_of<DrawnPanel> auto& panel) {
    fields("label", panel.label);
    fields("pictures", panel.pictures, "none: an empty cell of a matrix, and the label says why");
    fields.optional("legend", panel.legend, "of its own colours; absent: that of the figure");
}

void describe(auto& fields, part_of<Legend> auto& legend) {
    fields("quantity", legend.quantity);
    fields("unit", legend.unit);
    fields("low", legend.low);
    fields("high", legend.high);
    fields("colours", legend.colours, "evenly from low to high");
    fields.optional("clipped_below", legend.clipped_below, 0, "share of the values");
    fields.optional("clipped_above", legend.clipped_above, 0, "share of the values");
    fields.optional("undefined", legend.undefined, {}, "colour of places without a value; absent: there are none");
    fields.optional("histogram", legend.histogram, {}, "share of the values in equal bins");
    fields.optional("log", legend.log, false, "equal ratios are equally far apart");
}

void describe(auto& fields, part_of<DrawnModel> auto& model) {
    fields.optional("label", model.label, {});
    fields("file", model.file, file_note());
    fields.optional("quantity", model.quantity, {}, "of the values at the vertices, with its unit");
}

void describe(auto& fields, part_of<FigureEntry> auto& entry) {
    fields("id", entry.figure.id);
    fields("caption", entry.figure.caption);
    fields("alt", entry.figure.alt);
    fields.file_or_null("sheet", entry.drawn.sheet, entry.is_drawn, "null: could not be drawn");
    const DrawnFigure fallback;
    fields.optional("in_a_line", entry.drawn.in_a_line, fallback.in_a_line, "panels beside each other");
    fields.optional("states", entry.drawn.states, fallback.states, "number of consecutive panels that show one mesh");
    fields.optional("columns", entry.drawn.columns, {}, "heads of a matrix, whose panels are given row by row");
    fields.optional("rows", entry.drawn.rows, {});
    fields.optional("panels", entry.drawn.panels, {}, "meshes, and where their pictures are in the sheet");
    fields.optional("legend", entry.drawn.legend, "meaning of the colours");
    fields.optional("models", entry.drawn.models, {}, "meshes that readers of the page can turn");
}

}   // namespace meshfolio::report
