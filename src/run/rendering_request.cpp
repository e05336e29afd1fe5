// The request of `report --from` and `merge`: a finished report, or the parts of one, rendered again.
#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "base/errors.h"
#include "base/joined.h"
#include "questions/core/section_tools.h"
#include "run/arguments.h"
#include "run/console.h"
#include "run/provenance.h"
#include "run/report.h"

namespace meshfolio::run {

namespace fs = std::filesystem;

namespace {

using report::Section;
using report::Status;
using Meshes = std::set<std::pair<std::string, std::string>>;   // name and SHA-256
using Parts = std::vector<std::shared_ptr<const StoredReport>>;

std::map<std::string, Meshes> meshes_by_role(const report::Document& document) {
    std::map<std::string, Meshes> meshes;
    for (const Section& section : document.sections)
        for (const report::Input& input : section.inputs) meshes[input.role].emplace(input.file, input.sha256);
    return meshes;
}

/// Returns "another bunny.obj (SHA-256 …)", naming a mesh that only `one` has for a role of both; empty: none. A section may read some
/// meshes of a role only, so subsets count as equal.
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

/// Returns the section as results.json has it, where an undefined number equals itself; times differ between parts.
std::string written(const Section& section) {
    report::Document alone;
    alone.sections = {section};
    return report::write_json(alone, {}, {.timings = false});
}

const Section* section_in(const StoredReport& part, std::string_view id) {
    const auto section = std::ranges::find(part.document.sections, id, &Section::id);
    return section == part.document.sections.end() ? nullptr : &*section;
}

/// Returns the first part that has the section answered, else the first that has it at all.
const StoredReport& part_with(const Parts& parts, std::string_view id) {
    const auto has_section = [&](const auto& part, bool answered) {
        const Section* section = section_in(*part, id);
        return section != nullptr && (!answered || section->status != Status::skipped);
    };
    auto part = std::ranges::find_if(parts, [&](const auto& one) { return has_section(one, true); });
    if (part == parts.end()) part = std::ranges::find_if(parts, [&](const auto& one) { return has_section(one, false); });
    return **part;
}

/// @throws InputError naming two parts and a difference: inputs, settings, program, or what both say of one section
void require_alike(const Parts& parts) {
    const StoredReport& first = *parts.front();
    for (const auto& part : parts) {
        std::string found = difference(part->document.provenance, first.document.provenance);
        if (found.empty()) found = mesh_difference(part->document, first.document);
        for (const auto& [name, words] :
             {std::pair{"title", &report::Document::title}, {"author", &report::Document::author}, {"course", &report::Document::course}}) {
            const std::string &own = part->document.*words, &other = first.document.*words;
            if (found.empty() && own != other) found = std::string(name) + " '" + own + "', and not '" + other + "'";
        }
        if (found.empty() && part->document.pages != first.document.pages) found = "other pages of text";
        if (!found.empty()) throw InputError({part->file}, "was made with " + found + " as " + first.file, "make the parts alike");
        for (const Section& section : part->document.sections) {
            const StoredReport& taken = part_with(parts, section.id);
            if (&taken != part.get() && section.status != Status::skipped && written(section) != written(*section_in(taken, section.id)))
                throw InputError({part->file}, "has another " + section.id + " than a part before it, the first of which is " + first.file,
                                 "leave one of them out");
        }
    }
}

/// Returns title, author, course and provenance of a run that was asked for all sections of the parts together.
report::Document merged_head(const Parts& parts) {
    report::Document head = parts.front()->document;
    head.sections.clear();
    std::vector<std::string> ids;
    for (const auto& part : parts) {
        const auto& asked = part->document.provenance.settings;
        if (const auto only = asked.find("only"); only != asked.end()) {
            std::string list = only->second;
            std::erase(list, ' ');
            std::ranges::copy(split(list, ','), std::back_inserter(ids));
        } else {
            for (const Section& section : part->document.sections) ids.push_back(section.id);
        }
    }
    auto& settings = head.provenance.settings;
    settings["only"] = meshfolio::joined(sections_in_order(ids), ", ");
    std::erase_if(settings, [](const auto& setting) { return setting.second.empty(); });
    return head;
}

/// Returns the laboratories of all parts; laboratories with equal data become one, with the questions of each: "q5 q7".
std::vector<report::Lab> merged_labs(const Parts& parts) {
    std::map<std::string, std::set<std::string>> questions;   // by the data
    for (const auto& part : parts)
        for (const report::Lab& lab : part->labs())
            for (const std::string& id : split(lab.questions, ' ')) questions[lab.data].insert(id);
    std::vector<report::Lab> labs;
    for (const auto& [data, ids] : questions) labs.push_back({meshfolio::joined({ids.begin(), ids.end()}, " "), data});
    std::ranges::sort(labs, {}, &report::Lab::questions);
    return labs;
}

/// Takes title, author, course, pages and design from the flags and the settings file; enter_words() takes the words of questions.
void take_words(const ReportFlags& flags, ReportRequest& request, ReportSettings& settings) {
    ReportSettings words;
    words.title = request.head.title;
    words.author = request.head.author;
    words.course = request.head.course;
    words.pages = request.head.pages;
    if (!flags.config.empty()) words = read_settings(flags.config, words);
    report::Document head = head_of(words);
    request.head.title = flags.title.empty() ? head.title : flags.title;
    request.head.author = flags.author.empty() ? head.author : flags.author;
    request.head.course = flags.course.empty() ? head.course : flags.course;
    request.head.pages = std::move(head.pages);
    if (words.page.file) request.templates.replace("report.html", *words.page.file);
    settings.page = words.page;
}

}   // namespace

ReportRequest rendering_request(const ReportFlags& flags) {
    for (const auto& [name, is_given] : {std::pair{"MESH", !flags.meshes.empty()},
                                         {"--only", !flags.only.empty()},
                                         {"--data", !flags.data.empty()},
                                         {"--size", !flags.size.empty()},
                                         {"--camera", !flags.camera.empty()},
                                         {"--up", !flags.up.empty()},
                                         {"--zoom", !flags.zoom.empty()},
                                         {"--quick", flags.quick},
                                         {"--fail-fast", flags.fail_fast},
                                         {"--part", !flags.part.empty()},
                                         {"--time", !flags.time.empty()},
                                         {"--plan", flags.plan || flags.json}})
        if (is_given) throw UsageError(std::string(name) + " cannot be given with --from", "nothing is computed; leave one of them out");
    auto settings = std::make_shared<ReportSettings>(report_settings(flags));
    check_output("--junit", flags.junit, {".xml"}, settings->out);
    const std::shared_ptr<tbb::global_control> threads = limited_threads(*settings);
    Parts parts;
    if (!flags.from.empty()) parts.push_back(std::make_shared<const StoredReport>(flags.from));
    for (const std::string& folder : flags.parts) parts.push_back(std::make_shared<const StoredReport>(fs::path(folder) / results_file));
    require_alike(parts);

    ReportRequest request;
    request.renders_again = true;
    request.junit = flags.junit;
    request.templates = report::Templates(settings->templates);
    request.head = merged_head(parts);
    take_words(flags, request, *settings);
    settings->timings = parts.size() == 1 && parts.front()->timings && !flags.no_timings;   // those of parts add up to nothing
    request.settings = settings;
    if (!flags.no_cache) request.store = cache_for_report();
    for (const auto& part : parts)
        for (const Section& section : part->document.sections)
            if (!contains(request.ids, section.id)) request.ids.push_back(section.id);
    std::ranges::sort(request.ids, {}, [](const std::string& id) { return std::ranges::find(chapter_list(), id, &Chapter::id); });
    request.sources = {[parts, threads](std::string_view id, const fs::path& folder, ProgressDisplay&) -> std::optional<ReportSection> {
        const StoredReport& part = part_with(parts, id);
        return part.section(*section_in(part, id), folder);
    }};
    if (!flags.no_source) request.source_text = [parts] { return parts.front()->bytes_of("src.txt").value_or(""); };
    request.labs = [parts](const std::vector<ReportSection>&) { return merged_labs(parts); };
    return request;
}

}   // namespace meshfolio::run
