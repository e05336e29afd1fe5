#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/base64.h"
#include "base/number_text.h"
#include "report/escape.h"
#include "report/page/page_design.h"
#include "report/page/template_render.h"
#include "run/diff/report_diff.h"

namespace meshfolio::run {

using nlohmann::json;
using report::Change;

namespace {

json view_of_change(const Change& change) {
    const auto safe = [](const std::string& text) { return report::safe_text(text); };
    const bool is_number = change.kind == Change::Kind::number;
    return {{"section", safe(change.section)},
            {"id", safe(change.id)},
            {"row", safe(change.row)},
            {"column", safe(change.column)},
            {"before", safe(change.before.empty() ? "–" : change.before)},
            {"after", safe(change.after.empty() ? "–" : change.after)},
            {"is_worse", change.kind == Change::Kind::check && change.size >= 2},
            {"has_size", is_number && std::isfinite(change.size)},
            {"exact_size", exact_text(change.size)},
            {"size", readable_percent(change.size, 2)}};
}

/// Returns the changes of some kinds, in their order.
json views_of(const ReportDiff& diff, std::initializer_list<Change::Kind> kinds) {
    json views = json::array();
    for (const Change& change : diff.changes)
        if (std::ranges::find(kinds, change.kind) != kinds.end()) views.push_back(view_of_change(change));
    return views;
}

/// Returns a list of {id, changes} of the numbers, one for each table, the table with the largest change first.
json tables_of(const ReportDiff& diff) {
    json tables = json::array();
    for (const Change& change : diff.changes) {
        if (change.kind != Change::Kind::number) continue;
        const std::string id = report::safe_text(change.id);
        auto table = std::ranges::find_if(tables, [&](const json& one) { return one["id"] == id && one["section"] == change.section; });
        if (table == tables.end()) {
            tables.push_back({{"id", id}, {"section", report::safe_text(change.section)}, {"changes", json::array()}});
            table = std::prev(tables.end());
        }
        (*table)["changes"].push_back(view_of_change(change));
    }
    for (json& table : tables) {
        table["count"] = table["changes"].size();
        table["is_short"] = table["changes"].size() <= 20;
    }
    return tables;
}

}   // namespace

std::string diff_page(const ReportDiff& diff) {
    using Kind = Change::Kind;
    json pictures = json::array();
    for (const PicturePair& pair : diff.pictures) {
        const auto change =
            std::ranges::find_if(diff.changes, [&](const Change& c) { return c.kind == Kind::picture && pair.path.ends_with(c.id); });
        pictures.push_back({{"path", report::safe_text(pair.path)},
                            {"words", change == diff.changes.end() ? "" : report::safe_text(change->after)},
                            {"before", base64(pair.before)},
                            {"after", base64(pair.after)},
                            {"width", std::to_string(pair.width)},
                            {"height", std::to_string(pair.height)}});
    }
    json model{{"before", report::safe_text(diff.before)}, {"after", report::safe_text(diff.after)}, {"pictures", pictures}};
    const std::pair<const char*, json> lists[] = {{"made_of", views_of(diff, {Kind::program, Kind::setting, Kind::input})},
                                                  {"checks", views_of(diff, {Kind::section, Kind::check})},
                                                  {"tables", tables_of(diff)},
                                                  {"presences", views_of(diff, {Kind::presence})},
                                                  {"files", views_of(diff, {Kind::picture, Kind::mesh})}};
    for (const auto& [name, list] : lists) {
        model["has_" + std::string(name)] = !list.empty();
        model[name] = list;
    }
    model["has_pictures"] = !pictures.empty();
    model["is_same"] = diff.changes.empty();
    const report::ComparedParts& parts = diff.compared;
    const auto changed = [&](std::initializer_list<Kind> kinds) { return static_cast<int>(views_of(diff, kinds).size()); };
    const auto tile = [&](const char* name, int number, int all) {
        model[name] = {{"number", readable_count(number)}, {"all", readable_count(all)}, {"is_any", number > 0}};
    };
    tile("check_tile", changed({Kind::check, Kind::section}), parts.checks);
    tile("number_tile", changed({Kind::number}), parts.numbers);
    tile("picture_tile", changed({Kind::picture}), parts.pictures);
    const report::Templates templates;
    report::add_design(model, templates, "diff");
    return report::render(templates, "diff.html", model, report::xml_escape);
}

}   // namespace meshfolio::run
