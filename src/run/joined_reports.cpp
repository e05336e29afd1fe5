#include "run/earlier_report.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "base/errors.h"
#include "base/joined.h"
#include "questions/core/section_tools.h"
#include "run/arguments.h"
#include "run/provenance.h"
#include "run/settings/report_settings.h"

namespace meshfolio::run {

namespace {

using report::Section;
using report::Status;
using Meshes = std::set<std::pair<std::string, std::string>>;   // name and SHA-256

std::map<std::string, Meshes> meshes_by_role(const report::Document& document) {
    std::map<std::string, Meshes> meshes;
    for (const Section& section : document.sections)
        for (const report::Input& input : section.inputs) meshes[input.role].emplace(input.file, input.sha256);
    return meshes;
}

/// Names a role whose meshes differ. One section may read some meshes of a role and another all, so subsets are equal.
std::string mesh_difference(const report::Document& one, const report::Document& other) {
    const auto a = meshes_by_role(one), b = meshes_by_role(other);
    for (const auto& [role, meshes] : a) {
        const auto same = b.find(role);
        if (same == b.end() || std::ranges::includes(meshes, same->second) || std::ranges::includes(same->second, meshes)) continue;
        Meshes others;
        std::ranges::set_difference(meshes, same->second, std::inserter(others, others.end()));
        return "another " + others.begin()->first + " (SHA-256 " + others.begin()->second.substr(0, 12) + " …)";
    }
    return "";
}

std::string words_difference(const report::Document& one, const report::Document& other) {
    for (const auto& [name, words] :
         {std::pair{"title", &report::Document::title}, {"author", &report::Document::author}, {"course", &report::Document::course}}) {
        if (one.*words != other.*words) return std::string(name) + " '" + one.*words + "', and not '" + other.*words + "'";
    }
    return "";
}

void require_alike(const EarlierReport& first, const EarlierReport& part) {
    std::string what = difference(part.document.provenance, first.document.provenance);
    if (what.empty()) what = mesh_difference(part.document, first.document);
    if (what.empty()) what = words_difference(part.document, first.document);
    if (!what.empty()) throw InputError({part.file}, "was made with " + what + " as " + first.file, "make the parts alike");
}

bool is_there(const Section& section) { return section.status != Status::skipped; }

/// As results.json says it, where what is undefined is like itself; times differ between parts.
std::string written(const Section& section) {
    report::Document alone;
    alone.sections = {section};
    return report::write_json(alone, {}, {.timings = false});
}

void take_sections(report::Document& whole, const EarlierReport& first, const EarlierReport& part) {
    for (const Section& other : part.document.sections) {
        const auto section = std::ranges::find(whole.sections, other.id, &Section::id);
        if (section == whole.sections.end()) {   // on request, and the parts before did not ask
            whole.sections.push_back(other);
            continue;
        }
        if (is_there(*section) && is_there(other) && written(*section) != written(other))
            throw InputError({part.file}, "has another " + section->id + " than a part before it, the first of which is " + first.file,
                             "leave one of them out");
        if (!is_there(*section)) *section = other;
    }
    std::ranges::sort(whole.sections, {}, [](const Section& section) {
        return std::ranges::find(chapter_list(), section.id, &Chapter::id) - chapter_list().begin();
    });
}

/// Returns the sections that were asked for; without the setting, those of the report.
std::vector<std::string> asked_for(const report::Document& document) {
    std::vector<std::string> ids;
    if (const auto only = document.provenance.settings.find("only"); only != document.provenance.settings.end()) {
        std::string list = only->second;
        std::erase(list, ' ');
        return split(list, ',');
    }
    for (const Section& section : document.sections) ids.push_back(section.id);
    return ids;
}

/// The setting of a run that was asked for all of them together.
void set_only(report::Document& whole, const std::vector<std::string>& ids) {
    auto& settings = whole.provenance.settings;
    const bool with_earlier = settings.contains("experiments") || settings["earlier"] == "yes";
    settings["only"] = meshfolio::joined(sections_in_order(ids, with_earlier), ", ");
    if (settings["only"].empty()) settings.erase("only");
}

/// Joins laboratories of the same data: "q5 q7".
std::vector<report::Lab> joined_labs(const std::vector<EarlierReport>& parts) {
    std::map<std::string, std::set<std::string>> questions;   // by the data
    for (const EarlierReport& part : parts) {
        for (const report::Lab& lab : part.labs())
            for (const std::string& id : split(lab.questions, ' ')) questions[lab.data].insert(id);
    }
    std::vector<report::Lab> labs;
    for (const auto& [data, ids] : questions) labs.push_back({meshfolio::joined({ids.begin(), ids.end()}, " "), data});
    std::ranges::sort(labs, {}, &report::Lab::questions);
    return labs;
}

}   // namespace

JoinedReport joined(std::vector<EarlierReport>& parts) {
    const EarlierReport& first = parts.front();
    JoinedReport whole{first.document, {}, joined_labs(parts)};
    std::vector<std::string> ids = asked_for(first.document);
    for (std::size_t i = 1; i < parts.size(); ++i) {
        require_alike(first, parts[i]);
        take_sections(whole.document, first, parts[i]);
        std::ranges::copy(asked_for(parts[i].document), std::back_inserter(ids));
    }
    set_only(whole.document, ids);
    for (EarlierReport& part : parts)
        for (auto& [id, figure] : part.figures) whole.figures.try_emplace(id, std::move(figure));
    return whole;
}

}   // namespace meshfolio::run
