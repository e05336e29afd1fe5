#include <memory>

#include "base/number_text.h"
#include "cli/commands.h"
#include "output/publish/file_group.h"
#include "run/arguments.h"
#include "run/console.h"
#include "run/diff/report_diff.h"

namespace meshfolio::cli {

Command diff_command(CLI::App& parent) {
    struct Options {
        std::string before, after, tolerance = plain_text(report::default_tolerance), junit, html;
        bool json = false;
    };
    const auto options = std::make_shared<Options>();
    CommandOptions app(parent, "diff", "What changed between two reports");
    app.required("OLD", options->before, "a report: its folder or results.json; or the folder of a batch");
    app.required("NEW", options->after, "the other one, of the same kind");
    app.text("--tolerance", options->tolerance, "relative change of a number that is none");
    app.flag("--json", options->json, "for programs");
    app.text("--junit FILE", options->junit, "JUnit XML for CI: a failure for each change");
    app.text("--html FILE", options->html, "a page: old and new side by side, pictures under a slider");
    app.footer(
        "Exit code 0: nothing changed beyond the tolerance; 1: something did.\nExample: meshfolio diff main/out out --html changes.html");
    return {app, [options] {
                const double tolerance = number_between("--tolerance", options->tolerance, 0, 1);
                check_output("--junit", options->junit, {".xml"});
                check_output("--html", options->html, {".html", ".htm"});
                const ReportDiff diff = diff_of(options->before, options->after, tolerance, !options->html.empty());
                output::FileGroup files;
                if (!options->junit.empty()) files.add(options->junit, diff_junit(diff));
                if (!options->html.empty()) files.add(options->html, diff_page(diff));
                files.publish();
                print(options->json ? diff_json(diff) : for_terminal(diff_text(diff)));
                return diff.changes.empty() ? ExitCode::ok : ExitCode::failed;
            }};
}

}   // namespace meshfolio::cli
