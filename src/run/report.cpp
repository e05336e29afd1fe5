#include "run/report.h"

#include <algorithm>
#include <atomic>
#include <chrono>

#include "base/file_bytes.h"
#include "base/number_text.h"
#include "base/parallel_tasks.h"
#include "output/draw/draw_figures.h"
#include "output/publish/publish.h"
#include "questions/core/section_tools.h"
#include "run/console.h"
#include "run/paper.h"
#include "run/provenance.h"
#include "submission/source_listing.h"

namespace meshfolio::run {

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;
using Sections = std::vector<ReportSection>;
using Origin = ReportSection::Origin;

double seconds_since(Clock::time_point began) { return std::chrono::duration<double>(Clock::now() - began).count(); }

/// The parts that the steps of making one report share.
struct Work {
    const ReportRequest& request;
    const fs::path& folder;   // that the report is written into
    ProgressDisplay& display;
    Paper& paper;
};

std::string outcome_of(const ReportSection& section, double seconds) {
    if (section.origin == Origin::cache) return ": from the cache";
    if (section.answer.section.status == report::Status::ok) return ": answered in " + plain_text(seconds, 2) + " s";
    return section.answer.section.status == report::Status::failed ? ": failed" : ": stopped";
}

/// Returns all sections of the request, each from the first source that has it.
Sections gather(const ReportRequest& request, const fs::path& folder, ProgressDisplay& display) {
    double planned = 0;   // [CPU s]
    for (const auto& [id, effort] : request.settings->efforts) planned += effort.cpu_seconds;
    std::atomic<double> done = 0;
    Sections sections(request.ids.size());
    std::atomic<std::size_t> left = sections.size();   // handed out one by one and from the last: the later sections take longest
    for_each_task(sections.size(), [&](std::size_t) {
        const std::size_t i = --left;
        const Clock::time_point began = Clock::now();
        std::optional<ReportSection> section;
        for (auto source = request.sources.begin(); !section && source != request.sources.end(); ++source)
            section = (*source)(request.ids[i], folder, display);
        sections[i] = std::move(section.value());
        const Origin origin = sections[i].origin;
        if (origin != Origin::answered && origin != Origin::cache) return;
        const double seconds = seconds_since(began);
        sections[i].answer.section.timings.push_back({origin == Origin::cache ? "taken from the cache" : "whole question", seconds});
        done += effort_of(*request.settings, request.ids[i]).cpu_seconds;
        display.advance(0.7 * done / std::max(planned, 1e-9));
        display.milestone(request.ids[i] + outcome_of(sections[i], seconds) + (request.settings->time ? display.left() : ""));
    });
    return sections;
}

report::Document assembled(const ReportRequest& request, const Sections& sections) {
    report::Document document = request.head;
    for (const ReportSection& section : sections) document.sections.push_back(section.answer.section);
    enter_words(document, *request.settings, request.renders_again);
    if (request.cites_source) submission::cite(document, own_source());
    if (!request.source_text)
        for (report::Section& section : document.sections)
            for (report::CodeReference& code : section.code) code.line = 0;
    return document;
}

/// Draws the figures of the sections answered now, and adds those of stored sections.
report::DrawnFigures draw(const Work& work, const Sections& sections) {
    std::vector<output::FigureRequest> requests;
    for (const ReportSection& section : sections) std::ranges::copy(section.answer.figures, std::back_inserter(requests));
    work.display.step("drawing");
    const ReportSettings& settings = *work.request.settings;
    for (output::FigureRequest& request : requests) request.sight = settings.sight;
    report::DrawnFigures figures = output::draw_figures(requests, work.folder,
                                                        {.width = settings.size.width,
                                                         .height = settings.size.height,
                                                         .view_files = settings.view_files,
                                                         .sheets_only = settings.sheets_only},
                                                        [&](double share) { work.display.advance(0.7 + 0.25 * share); });
    for (const ReportSection& section : sections) figures.insert(section.figures.begin(), section.figures.end());
    if (!requests.empty()) work.display.milestone(counted(static_cast<int>(requests.size()), "figure") + " drawn");
    return figures;
}

/// Writes everything but the pictures of meshes, while both volumes are printed.
void write(const Work& work, const Sections& sections, const report::Document& document, const report::DrawnFigures& figures) {
    const ReportRequest& request = work.request;
    work.display.step(work.paper.is_wanted() ? "writing and printing" : "writing");
    for (const report::Volume volume : {report::Volume::appendix, report::Volume::report})
        work.paper.begin(volume, document, figures, work.folder);
    report::WriteOptions options{
        .timings = request.settings->timings, .plot_files = true, .paper = work.paper.is_wanted(), .design = request.settings->page.design};
    run_tasks(
        [&] {
            if (request.labs) options.labs = request.labs(sections);
            write_report_files(document, figures, request.templates, options, work.folder);
        },
        [&] { for_each_task(sections.size(), [&](std::size_t i) { write_meshes(sections[i].answer, work.folder); }); },
        [&] {
            const std::string source = request.source_text ? request.source_text() : "";
            if (!source.empty()) write_file(work.folder / "src.txt", source);
        });
}

/// Stores the sections answered now, after all their files are written. Warns of a cache that cannot be written to.
/// @return known digests of files in the report's folder
output::Digests store_sections(const ReportRequest& request, const Sections& sections, const report::DrawnFigures& figures,
                               const fs::path& folder) {
    output::Digests digests;
    for (const ReportSection& section : sections) digests.insert(section.files.begin(), section.files.end());
    if (!request.cache) return digests;
    try {
        bool is_changed = false;
        for (const ReportSection& section : sections) {
            if (section.origin != Origin::answered) continue;
            digests.merge(request.cache->keep(section.answer.section, figures, folder));
            is_changed = true;
        }
        if (is_changed) request.store->trim();
    } catch (const Error& error) {
        warn("the cache could not be written, so that the next run computes these answers again: " + std::string(error.what()));
    }
    return digests;
}

/// Returns a warning for each file of a stored section that is gone; after some, their number.
std::vector<std::string> missing_files(const Sections& sections) {
    constexpr std::size_t most_named = 8;
    std::vector<std::string> notes;
    std::size_t count = 0;
    for (const ReportSection& section : sections)
        for (const std::string& path : section.missing)
            if (++count <= most_named) notes.push_back(path + " is missing from the earlier report");
    if (count > most_named) notes.push_back("… and " + std::to_string(count - most_named) + " files more");
    return notes;
}

}   // namespace

MadeReport make_report(const ReportRequest& request) {
    Paper paper(*request.settings, request.templates, request.store.get());
    output::Publication publication(request.settings->out);
    ProgressDisplay display(stderr_is_terminal(), request.expected_seconds);
    const Work work{request, publication.folder(), display, paper};
    const Clock::time_point began = Clock::now();

    const Sections sections = gather(request, work.folder, display);
    const double gathered = seconds_since(began);
    report::Document document = assembled(request, sections);
    const report::DrawnFigures figures = draw(work, sections);
    const double drawn = seconds_since(began);
    if (!request.renders_again) document.timings = {{"all questions", gathered}, {"drawing", drawn - gathered}, {"up to writing", drawn}};
    write(work, sections, document, figures);
    std::vector<std::string> notes = missing_files(sections);
    std::ranges::copy(paper.finish(), std::back_inserter(notes));
    std::ranges::copy(request.notes, std::back_inserter(notes));
    const output::Digests known = store_sections(request, sections, figures, work.folder);
    Published published = publish_report(publication, document, known, *request.settings, request.junit);
    const double seconds = request.renders_again ? 0 : seconds_since(began);
    return {std::move(document), std::move(published), std::move(notes), seconds};
}

report::Document gathered_document(const ReportRequest& request) {
    ProgressDisplay display(stderr_is_terminal(), request.expected_seconds);
    return assembled(request, gather(request, {}, display));
}

ExitCode print_outcome(const MadeReport& made) {
    for (const std::string& note : made.notes)
        if (!note.empty()) warn(note);
    summarise(made.document);
    print_place(made.published);
    conclude(verdict_on(made.document, made.seconds), !has_failed(made.document));
    print_path(made.published.folder / "index.html");
    return has_failed(made.document) ? ExitCode::failed : ExitCode::ok;
}

}   // namespace meshfolio::run
