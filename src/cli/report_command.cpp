#include <memory>

#include "cli/commands.h"
#include "run/console.h"
#include "run/report.h"

namespace meshfolio::cli {

namespace {

ExitCode run_report(const ReportFlags& flags) {
    if (flags.plan && flags.from.empty()) {
        print(plan_text(flags));
        return ExitCode::ok;
    }
    return print_outcome(make_report(flags.from.empty() ? report_request(flags) : rendering_request(flags)));
}

}   // namespace

Command report_command(CLI::App& parent) {
    const auto flags = std::make_shared<ReportFlags>();
    CommandOptions app(parent, "report", "Answer all questions in one report");
    app.texts("MESH", flags->meshes, "meshes of your own, which take every role; default: those of the assignment");
    add_run_options(app, *flags);
    add_paper_options(app, *flags);
    app.flag("--alone", flags->alone, "nothing but what --only names");
    app.text("--part DIR", flags->part, "folder for a part of a report, to be joined with others by meshfolio merge");
    app.texts("--data DIR", flags->data,
              "folder with the assignment's meshes by their own paths (repeatable, the first that has one wins)");
    app.text("--out DIR", flags->out, "folder of the report, replaced as a whole but for files of yours; default: out");
    app.flag("--sheets-only", flags->sheets_only, "no views as files: figures are sheets alone, as in batch");
    app.flag("--quick", flags->quick, "small settings for a first look: 20 s up to 100,000 triangles, 60 s at a million");
    app.flag("--plan", flags->plan, "only say what would be done, what it costs and what is scaled down");
    app.flag("--json", flags->json, "the plan for programs");
    app.flag("--fail-fast", flags->fail_fast, "stop the other questions when one fails");
    app.text("--junit FILE", flags->junit, "the checks as JUnit XML, for CI");
    app.text("--from FILE", flags->from, "results.json of an earlier report, which is rendered again without computing anything");
    app.footer(
        "Example: meshfolio report --data meshes/coursework --out out\n         meshfolio report my.obj --only q1,q3 --quick\n         "
        "meshfolio report --part parts/q4 --only q4");
    return {app, [flags] { return run_report(*flags); }};
}

}   // namespace meshfolio::cli
