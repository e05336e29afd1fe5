#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "base/in_quotes.h"
#include "base/joined.h"
#include "base/lower_case.h"
#include "base/number_text.h"
#include "cli/render_flags.h"
#include "run/console.h"
#include "run/one_mesh/colormap_choice.h"
#include "run/one_mesh/terminal_figure.h"

namespace meshfolio::cli {

using namespace run;

namespace {

/// Returns {low, high} for the text "low,high" of --range. @throws UsageError for another text
std::pair<double, double> value_limits_in(const std::string& text) {
    const std::size_t comma = text.find(',');
    const auto low = parse_number(std::string_view(text).substr(0, comma));
    const auto high = comma == std::string::npos ? std::nullopt : parse_number(std::string_view(text).substr(comma + 1));
    const double nothing = std::nan("");
    return value_limits(low.value_or(nothing), high.value_or(nothing), "--range '" + text + "'");
}

FigureStyle style_of(const RenderFlags& options) {
    FigureStyle style{.sight = sight_of(options.sight),
                      .common_fit = options.fit == "common",
                      .title = options.title,
                      .bars = options.bar == "on",
                      .background = background_of(options),
                      .colors = color_choice(options),
                      .edges = options.edges};
    if (!options.views.empty()) {
        views_named(options.views, style.sight);   // throws
        style.views = split(options.views, ',');
    }
    if (!options.columns.empty()) style.columns = static_cast<int>(integer_between("--columns", options.columns, 1, most_columns));
    if (!options.width.empty()) style.width = number_between("--width-mm", options.width, smallest_width, largest_width);
    if (!options.dpi.empty()) style.resolution = number_between("--dpi", options.dpi, least_resolution, largest_resolution);
    if (!options.isolines.empty()) style.isoline_spacing = number_above_zero("--isolines", options.isolines);
    return style;
}

/// Reads the meshes and computes their fields.
std::vector<FigureMesh> figure_meshes(const RenderFlags& options, const std::vector<PreparedMesh>& meshes) {
    std::vector<FigureMesh> figure;
    for (const std::string& label : labels_of(meshes)) figure.push_back({label, meshes[figure.size()], {}});
    if (!options.values.empty()) figure[0].fields = {field_from_file(meshes[0], options.values)};
    for (const std::string& name : options.values.empty() ? split(options.field, ',') : std::vector<std::string>()) {
        std::vector<Field> fields = fields_of(meshes, name);
        for (std::size_t i = 0; i < fields.size(); ++i) figure[i].fields.push_back(std::move(fields[i]));
    }
    return figure;
}

}   // namespace

render::Rgba background_of(const RenderFlags& options) {
    const std::string& text = options.background;
    if (text.empty() || text == "white") return {255, 255, 255, 255};
    if (text == "none") return {255, 255, 255, 0};
    unsigned color = 0;
    const char* end = text.data() + text.size();
    if (text.size() != 7 || text[0] != '#' || std::from_chars(text.data() + 1, end, color, 16).ptr != end)
        throw UsageError("--background " + in_quotes(text) + " is not a colour", "write white, none or #rrggbb, such as #fdf6e3");
    return {static_cast<std::uint8_t>(color >> 16), static_cast<std::uint8_t>(color >> 8), static_cast<std::uint8_t>(color), 255};
}

ColorChoice color_choice(const RenderFlags& options) {
    ColorChoice colors;
    if (!options.colormap.empty()) {
        ColormapChoice choice = colormap_choice(options.colormap);
        if (!choice.warning.empty()) warn(choice.warning);
        colors = {std::move(choice.name), std::move(choice.own_map), {}};
    }
    if (!options.range.empty()) colors.range = value_limits_in(options.range);
    return colors;
}

void keep_inputs(output::FileGroup& files, const RenderFlags& options) {
    for (const std::string& mesh : options.meshes) files.keep(mesh);
    files.keep(options.values.substr(0, options.values.rfind(':')));
    files.keep(options.colormap);
}

ExitCode run_figure(const RenderFlags& options) {
    FigureStyle style = style_of(options);
    if (!options.terminal) check_output("-o", options.output, {".pdf", ".svg", ".png"});
    const TerminalRoom room = options.terminal ? terminal_room() : TerminalRoom();
    Checks checks = Checks::for_pictures;
    for (const std::string& name : split(options.field, ',')) {
        std::vector<std::string> known = field_names();
        known.emplace_back("distance");
        require_choice("--field", name, known);
        if (name != "distance" && checks_for(name) == Checks::all) checks = Checks::all;
    }
    std::vector<PreparedMesh> meshes;
    for (const std::string& file : options.meshes) meshes.push_back(load_mesh(file, checks));
    const std::vector<FigureMesh> figure = figure_meshes(options, meshes);
    if (options.terminal) {
        print(terminal_figure(figure, style, room));
        return ExitCode::ok;
    }
    output::FileGroup files;
    keep_inputs(files, options);
    const std::string title = options.title.empty() ? meshfolio::joined(labels_of(meshes), ", ") : options.title;
    const std::string ending = lower_case_ending(options.output);
    files.add(options.output, encode_figure(figure_of(figure, style), style.resolution, title, ending));
    files.publish();
    print_path(options.output);
    return ExitCode::ok;
}

}   // namespace meshfolio::cli
