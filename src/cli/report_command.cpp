#include <chrono>
#include <memory>
#include <optional>
#include <utility>

#include "base/available_memory.h"
#include "base/file_bytes.h"
#include "base/number_text.h"
#include "base/parallel_tasks.h"
#include "cli/commands.h"
#include "mesh/mesh_topology.h"
#include "output/draw/draw_figures.h"
#include "output/publish/publish.h"
#include "report/page/volumes.h"
#include "run/arguments.h"
#include "run/console.h"
#include "run/earlier_report.h"
#include "run/kept_sections.h"
#include "run/lab/report_labs.h"
#include "run/paper_copy.h"
#include "run/plan/plan.h"
#include "run/progress.h"
#include "run/provenance.h"
#include "run/report_files.h"
#include "run/run_questions.h"
#include "run/settings/report_settings.h"
#include "run/stored_results.h"
#include "submission/source_listing.h"

namespace meshfolio::cli {

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point began) { return std::chrono::duration<double>(Clock::now() - began).count(); }

/// The settings of a run that was asked for the kept sections as well: the renewed report equals the report of that run.
ReportSettings with_kept(ReportSettings settings, const KeptSections& kept) {
    if (kept.answers.empty()) return settings;
    if (settings.only.empty())
        for (const Chapter* chapter : chapters_of(settings)) settings.only.emplace_back(chapter->id);
    for (const auto& [id, answer] : kept.answers) settings.only.push_back(id);
    settings.only = sections_in_order(settings.only, wants_earlier(settings));
    return settings;
}

report::Document document_of(const ReportSettings& settings, const std::vector<QuestionResult>& results) {
    report::Document document;
    document.title = settings.title;
    document.author = settings.author;
    document.course = settings.course;
    document.provenance = provenance_of(described(settings), settings.seed);
    for (const QuestionResult& result : results) document.sections.push_back(result.section());
    return document;
}

std::vector<output::FigureRequest> requests_of(const std::vector<QuestionResult>& results) {
    std::vector<output::FigureRequest> requests;
    for (const QuestionResult& result : results)
        requests.insert(requests.end(), result.answer.figures.begin(), result.answer.figures.end());
    return requests;
}

output::DrawSettings draw_settings(const ReportSettings& settings) {
    return {.width = settings.size.width,
            .height = settings.size.height,
            .view_files = settings.view_files,
            .sheets_only = settings.sheets_only};
}

/// Refuses work that needs more memory than there is. Prints the plan if --time was given, and warns if the time cannot be kept.
void begin_planned(const Plan& plan, ReportSettings& settings) {
    require_memory(plan, settings, available_memory());
    settings.efforts = plan.efforts();
    if (settings.time) {
        for (const std::string& line : split("planned:\n" + text_of(plan), '\n'))
            if (!line.empty()) complain(line);
    }
    if (plan.seconds() > plan.time)
        warn("the least that answers every question takes about " + plain_text(plan.seconds(), 2) + " s on two cores, not " +
             plain_text(plan.time, 2) + " s");
}

ExitCode run_report(const ReportFlags& flags) {
    if (flags.json && !flags.plan) throw UsageError("--json goes with --plan", "a report leaves results.json");
    if (contains(flags.meshes, "-")) throw UsageError("a report cannot take its mesh from standard input", "save it to a file first");
    ReportSettings settings = report_settings(flags);
    check_output("--junit", flags.junit, {".xml"}, settings.out);
    report::Templates templates(settings.templates);
    report::use_words_of(templates);
    if (settings.page.file) templates.replace("report.html", *settings.page.file);
    const MeshLibrary meshes(settings.data, settings.meshes, listed_meshes(settings));
    meshes.open_own_meshes();
    const Plan plan = plan_of(settings, meshes, flags.alone ? Scope::alone : flags.part.empty() ? Scope::report : Scope::part);
    if (flags.plan) {
        print(flags.json ? json_of(plan) : for_terminal(text_of(plan)));
        return ExitCode::ok;
    }
    begin_planned(plan, settings);
    const auto threads = limited_threads(settings);
    PaperCopy paper(settings, templates);
    output::Publication publication(settings.out);
    const bool renews = !flags.only.empty() && !flags.alone && flags.part.empty();
    const KeptSections kept = renews ? kept_sections(settings, meshes, publication.folder()) : KeptSections();
    const auto store = flags.no_cache ? nullptr : cache_for_report();
    std::optional<QuestionCache> cache;
    if (store) cache.emplace(*store, settings, meshes, publication.folder());

    report::Document document;
    Published published;
    std::vector<std::string> notes;
    const Clock::time_point whole = Clock::now();
    {
        ProgressDisplay display(stderr_is_terminal(), plan.seconds());
        const std::vector<QuestionResult> results = run_questions(meshes, settings, cache ? &*cache : nullptr, kept.answers, display);
        document = document_of(with_kept(settings, kept), results);
        kept.tell_efforts(document.provenance.settings);
        submission::cite(document, own_source());
        document.timings.push_back({"all questions", seconds_since(whole)});
        const Clock::time_point drawing_began = Clock::now();
        const fs::path& folder = publication.folder();
        display.step("drawing");
        const std::vector<output::FigureRequest> requests = requests_of(results);
        std::optional<Printing> appendix;   // begins while the other figures are drawn, for it takes longest
        output::DrawEvents events;
        events.progress = [&](double share) { display.advance(0.7 + 0.25 * share); };
        events.early = report::figures_in(document, report::Volume::appendix);
        events.early_drawn = [&](report::DrawnFigures of_appendix) {
            add_stored_figures(results, of_appendix);
            appendix.emplace(paper.begin(report::Volume::appendix, document, std::move(of_appendix), store.get(), folder));
        };
        report::DrawnFigures figures = output::draw_figures(requests, folder, draw_settings(settings), events);
        add_stored_figures(results, figures);
        display.milestone(std::to_string(requests.size()) + " figures drawn");
        document.timings.push_back({"drawing", seconds_since(drawing_began)});
        document.timings.push_back({"up to writing", seconds_since(whole)});
        display.step(paper.is_wanted() ? "writing and printing" : "writing");
        report::WriteOptions options{
            .timings = settings.timings, .plot_files = true, .paper = paper.is_wanted(), .design = settings.page.design};
        Printing own_paper = paper.begin(report::Volume::report, document, figures, store.get(), folder);
        run_tasks(
            [&] {
                if (settings.page.design == "report" && !options.viewer.empty())
                    options.labs = report_labs(results, meshes, settings, store.get());
                write_report_files(document, figures, templates, options, answers_of(results), stored_sections(results), folder);
            },
            [&] { write_file(folder / "src.txt", own_source().text()); });
        notes = {own_paper.warning(), appendix->warning()};
        const auto digests = stored_and_kept(results, figures, store.get(), cache ? &*cache : nullptr);
        published = publish_report(publication, document, digests, settings, flags.junit);
    }
    notes.push_back(kept.note);
    return tell(published, notes, document, seconds_since(whole));
}

}   // namespace

Command report_command(CLI::App& parent) {
    const auto flags = std::make_shared<ReportFlags>();
    CommandOptions app(parent, "report", "All questions: the full report");
    app.texts("MESH", flags->meshes, "meshes of your own, which take every role; default: those of the assignment");
    app.text("--only QUESTIONS", flags->only,
             "some of the questions: q1,q4 or 1-3,7; a report of the same inputs and settings in --out keeps its others");
    app.flag("--alone", flags->alone, "nothing but what --only names");
    app.text("--part DIR", flags->part, "folder for a part of a report, to be joined with others by meshfolio merge");
    app.texts("--data DIR", flags->data,
              "folder with the assignment's meshes by their own paths (repeatable, the first that has one wins)");
    app.text("--out DIR", flags->out, "folder of the report, replaced as a whole but for files of yours; default: out");
    app.text("--config FILE", flags->config,
             "settings file (TOML; data/report.toml documents every key), or where no file has that name, bundled settings");
    app.text("--author NAME", flags->author, "whose work it is; also with --from");
    app.text("--threads", flags->threads, "at most so many threads; default: all");
    app.text("--size PIXELS", flags->size, "pixels of one view; default: 800, or 400 with --quick");
    app.flag("--views-files", flags->view_files, "every view of every figure as a PNG of that size, not only those asked to be handed in");
    app.flag("--sheets-only", flags->sheets_only, "not even those: figures are sheets, as those of batch");
    app.text("--pdf auto|require|off", flags->pdf,
             "report.pdf and appendix.pdf: auto, where an engine is there (the default); require; or off");
    app.text("--pdf-browser FILE", flags->pdf_browser, "the browser that prints, by name or path; default: the first that is found");
    app.text("--templates DIR", flags->templates, "folder of templates that replace those of the same name; links may not lead out of it");
    app.flag("--quick", flags->quick, "small settings for a first look: 20 s up to 100,000 triangles, 60 s at a million");
    app.text("--time SECONDS", flags->time,
             "seconds on two cores to fit into: settings are made small, large meshes decimated; default: as promised, 180 up to 346,000 "
             "triangles");
    app.flag("--plan", flags->plan, "only say what would be done, what it costs and what is scaled down");
    app.flag("--json", flags->json, "the plan for programs");
    app.flag("--fail-fast", flags->fail_fast, "stop the other questions when one fails");
    app.flag("--no-timings", flags->no_timings, "leave out everything that differs from run to run");
    app.flag("--no-cache", flags->no_cache, "answer every question anew and keep no answer; see meshfolio cache --help");
    app.text("--junit FILE", flags->junit, "the checks as JUnit XML, for CI");
    app.text("--from FILE", flags->from, "results.json of an earlier report, which is rendered again without computing anything");
    app.footer(
        "Example: meshfolio report --data meshes/coursework --out out\n         meshfolio report my.obj --only q1,q3 --quick\n         "
        "meshfolio report --part parts/q4 --only q4");
    return {app, [flags] { return flags->from.empty() ? run_report(*flags) : report_from_results(*flags); }};
}

}   // namespace meshfolio::cli
