#include <memory>

#include "cli/commands.h"
#include "run/report.h"

namespace meshfolio::cli {

Command merge_command(CLI::App& parent) {
    const auto flags = std::make_shared<ReportFlags>();
    CommandOptions app(parent, "merge", "Merge parts of a report into the report that one run would make");
    app.required_texts("DIR", flags->parts, "folders of meshfolio report --part; each has some of the sections");
    app.text("--out DIR", flags->out, "folder of the report, replaced as a whole; default: out");
    add_paper_options(app, *flags);
    app.text("--junit FILE", flags->junit, "the checks as JUnit XML, for CI");
    app.footer(
        "Nothing is computed. Parts of other inputs, settings or programs are refused by name.\n"
        "Example: meshfolio report --part parts/a --only q1,q2,q3\n"
        "         meshfolio report --part parts/b --only q4\n"
        "         meshfolio merge parts/a parts/b --out out");
    return {app, [flags] { return print_outcome(make_report(rendering_request(*flags))); }};
}

}   // namespace meshfolio::cli
