#include <memory>

#include "cli/commands.h"
#include "run/batch/batch.h"

namespace meshfolio::cli {

Command batch_command(CLI::App& parent) {
    const auto flags = std::make_shared<BatchFlags>();
    ReportFlags& report = flags->report;
    report.quick = true;
    report.pdf = "off";
    report.sheets_only = true;
    CommandOptions app(parent, "batch", "Many meshes: a report each, and an index of them to sort");
    app.texts("MESH", flags->meshes, "meshes, folders of them, patterns, or @FILE as --list");
    app.texts("--list FILE", flags->lists, "file with one of these a line, relative to its own folder (repeatable)");
    app.required("--out DIR", report.out, "folder of the index and of a report for each mesh, which keeps what is finished");
    app.text("--jobs", flags->jobs, "reports at a time; default: as cores and memory allow");
    app.flag("--quick,!--full", report.quick, "small settings, as by default; --full: those of report");
    app.text("--time SECONDS", report.time, "seconds on two cores for each report");
    app.text("--only QUESTIONS", report.only, "some of the questions: q1,q4");
    app.text("--config FILE", report.config, "settings file (TOML) of every report");
    app.text("--author NAME", report.author, "whose work it is");
    app.text("--size PIXELS", report.size, "pixels of one view");
    app.text("--threads", report.threads, "at most so many threads, of all reports together; default: all");
    app.flag("--views-files", report.view_files, "every view of every figure as a PNG; otherwise its sheet alone");
    app.text("--pdf auto|require|off", report.pdf, "report.pdf of each: off, auto or require");
    app.text("--pdf-browser FILE", report.pdf_browser, "the browser that prints, by name or path");
    app.text("--templates DIR", report.templates, "folder of templates; reports that are finished keep theirs");
    app.flag("--no-timings", report.no_timings, "leave out everything that differs from run to run");
    app.flag("--plan", flags->plan, "only say which folder each mesh gets: a line of both, with a tab between them");
    app.flag("--no-cache", report.no_cache, "answer every question anew and keep no answer");
    app.footer(
        "Interrupted or not, run it again: only what is missing, failed or of other meshes, settings or programs is made.\n"
        "Example: meshfolio batch meshes scans/*.ply @more.txt --out reports");
    return {app, [flags] { return run_batch(*flags); }};
}

}   // namespace meshfolio::cli
