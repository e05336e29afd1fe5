// The request of `meshfolio report`: sections computed, taken from the cache, or kept from the report that --only renews.
#include <algorithm>
#include <set>
#include <utility>

#include "base/available_memory.h"
#include "base/file_bytes.h"
#include "base/number_text.h"
#include "questions/core/section_tools.h"
#include "report/words.h"
#include "run/arguments.h"
#include "run/chapter_runner.h"
#include "run/console.h"
#include "run/lab/report_labs.h"
#include "run/plan/plan.h"
#include "run/provenance.h"
#include "run/report.h"
#include "submission/source_listing.h"

namespace meshfolio::run {

namespace fs = std::filesystem;

namespace {

/// A planned report, with everything that its sources share.
struct Computation {
    ReportSettings settings;
    report::Templates templates;
    MeshLibrary meshes;
    Plan plan;
    std::unique_ptr<tbb::global_control> threads = limited_threads(settings);
    ChapterRunner runner{meshes, settings};
    std::shared_ptr<const StoredReport> renewed = nullptr;   // by --only; null: none
    std::set<std::string> kept = {};                         // ids of its sections that stay
};

std::shared_ptr<Computation> planned(const ReportFlags& flags) {
    if (flags.json && !flags.plan) throw UsageError("--json goes with --plan", "add --plan, or read the results.json of the report");
    if (contains(flags.meshes, "-")) throw UsageError("a report cannot take its mesh from standard input", "save it to a file first");
    ReportSettings settings = report_settings(flags);
    check_output("--junit", flags.junit, {".xml"}, settings.out);
    report::Templates templates(settings.templates);
    report::use_words_of(templates);
    if (settings.page.file) templates.replace("report.html", *settings.page.file);
    MeshLibrary meshes(settings.data, settings.meshes, listed_meshes(settings));
    meshes.open_own_meshes();
    Plan plan = plan_of(settings, meshes, flags.alone ? Scope::alone : flags.part.empty() ? Scope::report : Scope::part);
    return std::shared_ptr<Computation>(new Computation{std::move(settings), std::move(templates), std::move(meshes), std::move(plan)});
}

/// Returns a difference between what the earlier report was made of and what this run would make it of; empty: none.
std::string difference_to(const StoredReport& earlier, const std::set<std::string>& kept, const Computation& now) {
    report::Provenance before = earlier.document.provenance, provenance = provenance_of(described(now.settings), now.settings.seed);
    for (report::Provenance* one : {&before, &provenance})   // efforts follow from the other settings and from the sections that are named
        std::erase_if(one->settings, [](const auto& setting) { return setting.first.ends_with(effort_suffix); });
    if (const std::string found = difference(before, provenance); !found.empty()) return found;
    for (const report::Section& section : earlier.document.sections) {
        if (!kept.contains(section.id)) continue;
        const Chapter& chapter = chapter_of_id(section.id);
        std::vector<report::Input> found_now;
        for (const MeshLookup& lookup : meshes_read_by(chapter, now.settings))
            if (auto input = now.meshes.input_of(lookup, now.settings.base)) found_now.push_back(std::move(*input));
        for (const report::Input& input : section.inputs) {
            const auto is_same = [&](const report::Input& one) {
                return one.file == input.file && one.sha256 == input.sha256 && one.stand_in == input.stand_in;
            };
            if (std::ranges::none_of(found_now, is_same)) return "another " + input.file;
        }
    }
    return "";
}

std::vector<std::string> asked_ids(const ReportSettings& settings) {
    std::vector<std::string> ids;
    for (const Chapter* chapter : chapter_list())
        if (is_asked_for(settings, chapter->id)) ids.emplace_back(chapter->id);
    return ids;
}

/// Keeps the sections of the report at settings.out that are not asked for, if it has the inputs, settings and program of this run.
/// @return a warning that says why none is kept
std::string keep_sections(Computation& now) try {
    const fs::path results = now.settings.out / results_file;
    if (!may_be_there(results)) return "";
    auto earlier = std::make_shared<const StoredReport>(results);
    std::set<std::string> kept;
    const std::vector<std::string> asked = asked_ids(now.settings);
    for (const report::Section& section : earlier->document.sections)
        if (section.status != report::Status::skipped && !contains(asked, section.id)) kept.insert(section.id);
    if (kept.empty()) return "";
    if (const std::string found = difference_to(*earlier, kept, now); !found.empty())
        return now.settings.out.string() + " has only what was asked for: its other sections were made with " + found;
    now.renewed = std::move(earlier);
    now.kept = std::move(kept);
    return "";
} catch (const InputError& error) {   // of another version, perhaps
    return error.what();
}

/// Returns the provenance of a run that was asked for the kept sections as well: the renewed report equals the report of that run.
report::Document head_of(const Computation& now) {
    ReportSettings settings = now.settings;
    if (!now.kept.empty()) {
        std::vector<std::string> ids = asked_ids(settings);
        ids.insert(ids.end(), now.kept.begin(), now.kept.end());
        settings.only = sections_in_order(ids);
    }
    report::Document head = head_of(settings);
    head.provenance = provenance_of(described(settings), settings.seed);
    for (const std::string& id : now.kept) {
        const std::string effort = id + effort_suffix;
        const auto& before = now.renewed->document.provenance.settings;
        head.provenance.settings.erase(effort);
        if (const auto told = before.find(effort); told != before.end()) head.provenance.settings.insert(*told);
    }
    return head;
}

std::vector<Source> sources_of(const std::shared_ptr<Computation>& now, const std::shared_ptr<const SectionCache>& cache) {
    const Source not_computed = [now](std::string_view id, const fs::path& folder, ProgressDisplay&) -> std::optional<ReportSection> {
        if (now->kept.contains(std::string(id))) {
            ReportSection section =
                now->renewed->section(*std::ranges::find(now->renewed->document.sections, id, &report::Section::id), folder);
            if (!section.missing.empty())
                throw InputError({section.missing.front()}, "is missing from the earlier report", "make the report anew");
            section.answer.section.timings.clear();   // of that run
            return section;
        }
        if (!is_asked_for(now->settings, id)) return ReportSection{{skipped_section(id, report::not_asked_for)}};
        if (effort_of(now->settings, std::string(id)).left_out) return ReportSection{{skipped_section(id, left_out_to_fit())}};
        return {};
    };
    const Source cached = [cache](std::string_view id, const fs::path& folder, ProgressDisplay&) {
        return cache ? cache->find(chapter_of_id(id), folder) : std::nullopt;
    };
    const Source computed = [now](std::string_view id, const fs::path&, ProgressDisplay& display) -> std::optional<ReportSection> {
        return ReportSection{now->runner.answer(chapter_of_id(id), display), ReportSection::Origin::answered};
    };
    return {not_computed, cached, computed};
}

}   // namespace

std::string plan_text(const ReportFlags& flags) {
    const Plan plan = planned(flags)->plan;
    return flags.json ? json_of(plan) : for_terminal(text_of(plan));
}

ReportRequest report_request(const ReportFlags& flags) {
    const std::shared_ptr<Computation> now = planned(flags);
    require_memory(now->plan, now->settings, available_memory());
    now->settings.efforts = now->plan.efforts();
    if (now->settings.time) {
        for (const std::string& line : split("planned:\n" + text_of(now->plan), '\n'))
            if (!line.empty()) complain(line);
    }
    if (now->plan.seconds() > now->plan.time)
        warn("the least that answers every question takes about " + plain_text(now->plan.seconds(), 2) + " s on two cores, not " +
             plain_text(now->plan.time, 2) + " s");

    ReportRequest request;
    request.settings = std::shared_ptr<const ReportSettings>(now, &now->settings);
    request.templates = now->templates;
    request.junit = flags.junit;
    request.expected_seconds = now->plan.seconds();
    if (!flags.only.empty() && !flags.alone && flags.part.empty()) request.notes.push_back(keep_sections(*now));
    request.head = head_of(*now);
    request.ids = section_ids();
    if (!flags.no_cache) request.store = cache_for_report();
    if (request.store) request.cache = std::make_shared<const SectionCache>(*request.store, now->settings, now->meshes);
    request.sources = sources_of(now, request.cache);
    if (has_source(now->settings)) request.source_text = [] { return own_source().text(); };
    request.cites_source = has_source(now->settings);
    if (now->settings.page.design == "report" && !report::viewer_program().empty())
        request.labs = [now, store = request.store](const std::vector<ReportSection>& sections) {
            return report_labs(sections, now->meshes, now->settings, store.get());
        };
    return request;
}

}   // namespace meshfolio::run
