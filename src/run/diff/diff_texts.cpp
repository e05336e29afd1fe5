// What changed as text for people, JSON and JUnit XML.
#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "base/number_text.h"
#include "report/writers.h"
#include "run/diff/report_diff.h"

namespace meshfolio::run {

using report::Change;

namespace {

constexpr int most_lines = 20;   // of a kind

/// Returns "5 numbers", "1 check".
std::string counted(std::size_t n, const std::string& noun) {
    return std::to_string(n) + " " + noun + (n == 1 ? "" : noun == "mesh" ? "es" : "s");
}

std::string title_of(Change::Kind kind) {
    static const std::map<Change::Kind, std::string> titles{{Change::Kind::program, "program"},
                                                            {Change::Kind::setting, "settings"},
                                                            {Change::Kind::input, "input meshes"},
                                                            {Change::Kind::section, "sections"},
                                                            {Change::Kind::check, "checks, worst first"},
                                                            {Change::Kind::number, "numbers, largest change first"},
                                                            {Change::Kind::presence, "what came or went"},
                                                            {Change::Kind::picture, "pictures"},
                                                            {Change::Kind::mesh, "output meshes"}};
    return titles.at(kind);
}

std::string line_of(const Change& change) {
    const auto or_none = [](const std::string& text) { return text.empty() ? std::string("–") : text; };
    std::string where = change.kind == Change::Kind::setting && !change.section.empty() ? change.section + ": " + change.id : change.id;
    for (const std::string& part : {change.row, change.column})
        if (!part.empty()) where += ": " + part;
    switch (change.kind) {
        case Change::Kind::presence: return where + (change.after.empty() ? ": gone" : ": new");
        case Change::Kind::picture:
        case Change::Kind::mesh: return where + ": " + change.after;
        case Change::Kind::number: {
            const std::string share = std::isfinite(change.size) ? "  (" + readable_percent(change.size, 2) + ")" : "";
            return where + ": " + or_none(change.before) + " -> " + or_none(change.after) + share;
        }
        default: return where + ": " + or_none(change.before) + " -> " + or_none(change.after);
    }
}

}   // namespace

std::string diff_text(const ReportDiff& diff) {
    std::string text;
    for (auto first = diff.changes.begin(); first != diff.changes.end();) {
        const auto last = std::find_if(first, diff.changes.end(), [&](const Change& change) { return change.kind != first->kind; });
        text += title_of(first->kind) + "\n";
        for (auto change = first; change != last && change - first < most_lines; ++change)
            text += "  " + (change->section.find('/') != std::string::npos ? change->section + " " : "") + line_of(*change) + "\n";
        if (last - first > most_lines) text += "  and " + std::to_string(last - first - most_lines) + " more\n";
        first = last;
    }
    const report::ComparedParts& parts = diff.compared;
    const auto count = [](int n, const std::string& noun) { return counted(static_cast<std::size_t>(n), noun); };
    return text + (diff.changes.empty() ? "no change in " : counted(diff.changes.size(), "change") + " in ") +
           count(parts.checks, "check") + ", " + count(parts.numbers, "number") + " of " + count(parts.tables, "table") + ", " +
           count(parts.pictures, "picture") + ", " + count(parts.meshes, "mesh") + "\n";
}

std::string diff_json(const ReportDiff& diff) {
    using Json = nlohmann::ordered_json;
    Json changes = Json::array();
    for (const Change& change : diff.changes) {
        Json entry{{"kind", name_of(change.kind)}, {"section", change.section}, {"id", change.id}};
        for (const auto& [key, text] : {std::pair{"row", &change.row}, std::pair{"column", &change.column}})
            if (!text->empty()) entry[key] = *text;
        entry["before"] = change.before.empty() ? Json() : Json(change.before);
        entry["after"] = change.after.empty() ? Json() : Json(change.after);
        entry["size"] = std::isfinite(change.size) ? Json(change.size) : Json();
        changes.push_back(std::move(entry));
    }
    const report::ComparedParts& parts = diff.compared;
    const Json whole{{"before", diff.before},
                     {"after", diff.after},
                     {"compared",
                      {{"checks", parts.checks},
                       {"numbers", parts.numbers},
                       {"tables", parts.tables},
                       {"pictures", parts.pictures},
                       {"meshes", parts.meshes}}},
                     {"changes", changes}};
    return whole.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string diff_junit(const ReportDiff& diff) {
    report::Document cases;   // a check that fails for each change, in the section of the change
    std::map<std::string, report::Section> sections;
    std::map<std::string, const Change*> changed;
    for (const Change& change : diff.changes)
        if (change.kind == Change::Kind::check) changed[change.section + " " + change.id] = &change;
    for (const report::Section& section : diff.sections) {
        report::Section& made = sections[section.id];
        made.id = section.id;
        made.title = section.title;
        made.checks = section.checks;
        const std::vector<std::string> ids = check_ids(section);
        for (std::size_t i = 0; i < ids.size(); ++i) {
            const auto it = changed.find(section.id + " " + ids[i]);
            made.checks[i].status = it == changed.end() ? report::Check::Status::passed : report::Check::Status::failed;
            if (it != changed.end()) made.checks[i].note = "was " + it->second->before;
        }
    }
    for (const Change& change : diff.changes) {
        if (change.kind == Change::Kind::check && !change.after.empty()) continue;
        report::Section& section = sections[change.section];
        if (section.id.empty()) section.id = section.title = change.section.empty() ? "report" : change.section;
        section.checks.push_back(
            {.name = line_of(change), .measured = 1, .kind = report::Check::Kind::at_most, .note = title_of(change.kind)});
    }
    for (auto& [id, section] : sections) cases.sections.push_back(std::move(section));
    return write_junit(cases, false);
}

}   // namespace meshfolio::run
