#include "run/one_mesh/colormap_choice.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/common.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "base/in_quotes.h"
#include "base/joined.h"
#include "base/lower_case.h"
#include "base/nearest_word.h"
#include "base/number_text.h"
#include "color/evenness.h"
#include "color/srgb.h"
#include "mesh/io/text_scanner.h"

namespace meshfolio::run {

namespace {

using render::Colormap;
using render::Rgba;

constexpr std::size_t least_rows = 2, most_rows = 4096, finest = 257;   // colours at equal steps, so that eighths are met
constexpr std::uintmax_t largest_colormap = 1 << 20;                    // bytes
constexpr const char* row_remedy = "write rows r,g,b or t,r,g,b, with t rising and colours from 0 to 1 or from 0 to 255";

struct Row {
    double t;
    glm::dvec3 color;
    long line;   // 0 in JSON
};

struct Table {
    std::vector<Row> rows;
    bool equally_spaced = false, in_lab = false;
};

/// Adds a row of 3 or 4 numbers. @throws InputError if it is not like the rows before
void add_row(Table& table, const std::vector<double>& numbers, const Location& where) {
    const std::size_t first = numbers.size() - 3;
    const glm::dvec3 color{numbers[first], numbers[first + 1], numbers[first + 2]};
    const bool equally_spaced = numbers.size() == 3;
    std::vector<Row>& rows = table.rows;
    const double t = equally_spaced ? static_cast<double>(rows.size()) : numbers[0];
    if (!rows.empty() && equally_spaced != table.equally_spaced) throw InputError(where, "rows have 3 and 4 numbers", row_remedy);
    if (!rows.empty() && t < rows.back().t) throw InputError(where, plain_text(t) + " is below the t of the row before", row_remedy);
    for (int k = 0; k < 3; ++k)
        if (!(color[k] >= 0 && color[k] <= 255)) throw InputError(where, plain_text(color[k]) + " is not part of a colour", row_remedy);
    if (rows.size() == most_rows) throw InputError(where, "more than " + std::to_string(most_rows) + " colours", "take fewer");
    table.equally_spaced = equally_spaced;
    rows.push_back({t, color, where.line});
}

/// Returns the words of a line as numbers; nothing for other words.
std::vector<std::optional<double>> numbers_of(std::string line) {
    std::ranges::replace(line, ',', ' ');
    std::ranges::replace(line, ';', ' ');
    std::string_view rest(line);
    std::vector<std::optional<double>> numbers;
    for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest)) numbers.push_back(parse_number(word));
    return numbers;
}

Table table_of_text(std::string_view text, const std::string& file) {
    refuse_nul_bytes(text, file);
    Table table;
    bool has_header = false;
    LineScanner lines(text);
    while (lines.next_with_words()) {
        if (without_leading_space(lines.line()).starts_with('%')) continue;
        const Location where{file, lines.number()};
        const auto words = numbers_of(std::string(lines.line()));
        const auto is_number = [](const std::optional<double>& word) { return word.has_value(); };
        if (table.rows.empty() && std::ranges::none_of(words, is_number) && !std::exchange(has_header, true)) continue;
        if ((words.size() != 3 && words.size() != 4) || !std::ranges::all_of(words, is_number))
            throw InputError(where, in_quotes(lines.line()) + " is not a row of 3 or 4 numbers", row_remedy);
        std::vector<double> numbers;
        for (const auto& word : words) numbers.push_back(*word);
        add_row(table, numbers, where);
    }
    return table;
}

Table table_of_json(std::string_view text, const std::string& file) try {
    const auto parsed = nlohmann::json::parse(text);
    const nlohmann::json& map = parsed.is_array() ? parsed.at(0) : parsed;
    const std::string space = lower_case(map.value("ColorSpace", "RGB"));
    auto points = map.at("RGBPoints").get<std::vector<double>>();
    const bool diverging = space == "diverging";
    if (diverging && points.size() == 8)   // through the grey of Moreland (2009)
        points.insert(points.begin() + 4, {(points[0] + points[4]) / 2, 0.865, 0.865, 0.865});
    Table table;
    table.in_lab = space == "lab" || space == "cielab" || space == "ciede2000" || diverging;
    if (!table.in_lab && space != "rgb")
        throw InputError({file, 0}, "its ColorSpace " + in_quotes(space) + " is not known", "take RGB or Lab, with more points");
    if (points.size() % 4 != 0) throw InputError({file, 0}, "RGBPoints is not a list of x, r, g, b", row_remedy);
    for (std::size_t i = 0; i < points.size(); i += 4) add_row(table, {points.begin() + long(i), points.begin() + long(i) + 4}, {file, 0});
    return table;
} catch (const nlohmann::json::parse_error& error) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
    throw InputError({file, 1 + std::count(text.begin(), end, '\n')}, "it is not JSON", "save the colour map again in ParaView");
} catch (const nlohmann::json::exception&) {
    throw InputError({file, 0}, "no colour map with a list RGBPoints of numbers", "save the colour map again in ParaView");
}

Rgba rgba_of(const glm::dvec3& color) {
    const auto channel = [](double x) { return static_cast<std::uint8_t>(std::lround(255 * x)); };
    return {channel(color.r), channel(color.g), channel(color.b), 255};
}

/// Returns the colours at equal steps of t.
std::vector<Rgba> stops_of(const Table& table) {
    const std::vector<Row>& rows = table.rows;
    const bool is_exact = table.equally_spaced && !table.in_lab;
    const std::size_t count = is_exact ? rows.size() : std::max(finest, rows.size());
    const double first = rows.front().t, span = rows.back().t - first;
    std::vector<Rgba> stops;
    for (std::size_t k = 0, i = 0; k < count; ++k) {
        const double t = first + span * (static_cast<double>(k) / static_cast<double>(count - 1));
        while (i + 2 < rows.size() && rows[i + 1].t < t) ++i;
        const Row &a = rows[i], &b = rows[i + 1];
        const double u = b.t > a.t ? std::clamp((t - a.t) / (b.t - a.t), 0.0, 1.0) : 1;
        const Rgba mixed = rgba_of(glm::mix(a.color, b.color, u));
        stops.push_back(table.in_lab ? render::rgba_of_lab(glm::mix(render::lab_of(rgba_of(a.color)), render::lab_of(rgba_of(b.color)), u))
                                     : mixed);
    }
    return stops;
}

Colormap colormap_in(const std::string& file) {
    const std::string bytes = read_file(file, largest_colormap);
    const std::string_view text = without_bom(bytes), start = without_leading_space(text);
    Table table = start.starts_with('{') || start.starts_with('[') ? table_of_json(text, file) : table_of_text(text, file);
    if (table.rows.size() < least_rows)
        throw InputError({file, 0}, std::to_string(table.rows.size()) + " colours are no colour map", row_remedy);
    if (!(table.rows.back().t - table.rows.front().t < std::numeric_limits<double>::infinity()) ||
        table.rows.back().t <= table.rows.front().t)
        throw InputError({file, table.rows.back().line}, "t does not rise", row_remedy);
    const auto largest = [](const Row& row) { return std::max({row.color.r, row.color.g, row.color.b}); };
    if (std::ranges::any_of(table.rows, [&](const Row& row) { return largest(row) > 1; }))
        for (Row& row : table.rows) row.color /= 255.0;
    const std::vector<Rgba> stops = stops_of(table);
    return {std::filesystem::path(file).stem().string(), render::kind_of(stops), "of a file", stops};
}

ColorChoice choice_of(const std::string& name, std::shared_ptr<const Colormap> own_map) {
    const Colormap& map = own_map ? *own_map : render::colormap_named(name);
    const std::string uneven = render::unevenness_of(map);
    const std::string better = map.kind == "diverging" || map.kind == "cyclic" ? map.kind : "viridis";
    return {name,
            std::move(own_map),
            uneven.empty()
                ? ""
                : "colour map " + name + " is not perceptually uniform: " + uneven + "; " + better + " shows equal steps as equal",
            {}};
}

}   // namespace

ColorChoice colormap_choice(const std::string& name_or_file) {
    if (const Colormap* map = render::find_colormap(name_or_file)) return choice_of(map->name, nullptr);
    if (name_or_file.ends_with("_r"))
        if (const Colormap* map = render::find_colormap(name_or_file.substr(0, name_or_file.size() - 2))) {
            Colormap reversed = *map;
            std::ranges::reverse(reversed.stops);
            return choice_of(map->name + "_r", std::make_shared<const Colormap>(std::move(reversed)));
        }
    if (name_or_file.find_first_of("./") == std::string::npos && !may_be_there(name_or_file)) {
        std::vector<std::string> known;
        for (const Colormap& map : render::colormap_list()) known.push_back(map.name);
        throw UsageError("unknown colour map " + in_quotes(name_or_file),
                         suggestion(name_or_file, known) + "known are " + meshfolio::joined(known, ", ") + ", and files of colours");
    }
    return choice_of(name_or_file, std::make_shared<const Colormap>(colormap_in(name_or_file)));
}

}   // namespace meshfolio::run
