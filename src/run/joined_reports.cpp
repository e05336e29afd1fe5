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
#include "run/question_cache.h"
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
    const bool has_same = std::ranges::equal(part.document.sections, first.document.sections, {}, &Section::id, &Section::id);
    if (what.empty() && !has_same) what = "other sections";
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
    for (std::size_t i = 0; i < whole.sections.size(); ++i) {
        Section& section = whole.sections[i];
        const Section& other = part.document.sections.at(i);
        if (is_there(section) && is_there(other) && written(section) != written(other))
            throw InputError({part.file}, "has another " + section.id + " than a part before it, the first of which is " + first.file,
                             "leave one of them out");
        if (!is_there(section)) section = other;
    }
}

void take_cover(JoinedReport& whole, const EarlierReport& part, std::size_t number) {
    const auto& cover = part.document.cover;
    auto& best = whole.document.cover;
    if (!cover) return;
    const auto offer = [](const report::Cover& c) { return CoverOffer{c.turnable, c.worth, c.alt}; };
    const auto place = [&](const report::Cover& c) {
        return std::ranges::find(whole.document.sections, c.section, &Section::id) - whole.document.sections.begin();
    };
    const bool is_better =
        !best || offer(*cover).beats(offer(*best)) || (!offer(*best).beats(offer(*cover)) && place(*cover) < place(*best));
    if (is_better) best = cover, whole.cover = number;
}

/// The sections that were asked for together.
void take_only(report::Document& whole, const EarlierReport& part) {
    auto& settings = whole.provenance.settings;
    const auto own = settings.find("only");
    const auto others = part.document.provenance.settings.find("only");
    if (own == settings.end()) return;
    std::vector<std::string> ids;   // of a part without the setting: all
    if (others != part.document.provenance.settings.end()) {
        for (std::string list : {own->second, others->second}) {
            std::erase(list, ' ');
            for (std::string& id : split(list, ',')) ids.push_back(std::move(id));
        }
    }
    own->second = meshfolio::joined(sections_in_order(ids), ", ");
    if (own->second.empty()) settings.erase(own);
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
    JoinedReport whole{first.document, {}, joined_labs(parts), 0};
    for (std::size_t i = 1; i < parts.size(); ++i) {
        require_alike(first, parts[i]);
        take_sections(whole.document, first, parts[i]);
        take_only(whole.document, parts[i]);
        take_cover(whole, parts[i], i);
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
        for (auto& [id, figure] : parts[i].figures)
            if (id != "cover" || i == whole.cover) whole.figures.try_emplace(id, std::move(figure));
    }
    return whole;
}

}   // namespace meshfolio::run
