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
    add_run_options(app, report);
    add_paper_options(app, report);
    app.flag("--plan", flags->plan, "only say which folder each mesh gets: a line of both, with a tab between them");
    app.footer(
        "Interrupted or not, run it again: only what is missing, failed or of other meshes, settings or programs is made.\n"
        "Example: meshfolio batch meshes scans/*.ply @more.txt --out reports");
    return {app, [flags] { return run_batch(*flags); }};
}

}   // namespace meshfolio::cli
