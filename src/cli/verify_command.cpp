#include <algorithm>
#include <memory>

#include "cli/commands.h"
#include "cli/console.h"
#include "cli/progress.h"
#include "cli/provenance.h"
#include "cli/report_files.h"
#include "file_bytes.h"
#include "number_text.h"
#include "output/publish.h"
#include "questions/ground_truth.h"

namespace meshfolio::cli {

namespace {

struct Options {
    std::string out;
    std::uint64_t seed = 1;
    bool quick = false;
};

/// "ok      name: measured 1.99, expected 2 ± 0.15".
std::string told(const report::Check& check) {
    using Kind = report::Check::Kind;
    const std::string limit = plain_text(check.expected, 5);
    const std::string expected = check.kind == Kind::at_most    ? "at most " + limit
                                 : check.kind == Kind::at_least ? "at least " + limit
                                                                : "expected " + limit;
    const std::string tolerance = check.tolerance > 0 ? ", tolerance " + plain_text(check.tolerance, 3) : "";
    return std::string(check.passed ? "ok      " : "FAILED  ") + check.name + ": " + plain_text(check.measured, 5) + " (" + expected +
           tolerance + ")\n";
}

/// The section as a report of its own, and everything measured as tables/truth_all.csv.
void write_report(const Options& options, const GroundTruth& truth, const report::Section& section) {
    output::Publication publication(options.out);
    report::Document document;
    document.title = "Ground truth of curvature estimates";
    document.provenance = provenance_of({{"quick", options.quick ? "yes" : "no"}}, options.seed);
    document.sections.push_back(section);
    write_report_files(document, {}, report::Templates(), {.timings = false, .plot_files = true}, {}, publication.folder());
    write_file(publication.folder() / "tables" / "truth_all.csv", report::write_csv(ground_truth_table(truth)));
    const std::string note = publication.publish();
    if (!note.empty()) warn(note);
}

ExitCode run_verify(const Options& options) {
    GroundTruth truth;
    {
        ProgressDisplay display(stderr_is_terminal());
        truth = ground_truth(options.seed, options.quick, [&](std::string_view step) { display.step(std::string(step)); });
    }
    const report::Section section = ground_truth_section(truth);
    if (!options.out.empty()) write_report(options, truth, section);
    std::string lines;
    for (const report::Check& check : section.checks) lines += told(check);
    const auto passed = std::count_if(section.checks.begin(), section.checks.end(), [](const report::Check& c) { return c.passed; });
    print(lines + std::to_string(passed) + " of " + std::to_string(section.checks.size()) + " checks passed\n");
    return passed == static_cast<std::ptrdiff_t>(section.checks.size()) ? ExitCode::ok : ExitCode::failed;
}

}   // namespace

Command verify_command(CLI::App& parent) {
    const auto options = std::make_shared<Options>();
    CLI::App* app = parent.add_subcommand("verify", "Curvature estimates against surfaces with closed forms: named checks");
    app->add_option("--out", options->out, "folder for the tables, plots and discussion, replaced as a whole; default: none");
    app->add_option("--seed", options->seed, "of the random meshes")->capture_default_str();
    app->add_flag("--quick", options->quick, "three refinements in place of four");
    app->footer("Example: meshfolio verify --out truth");
    return {app, [options] { return run_verify(*options); }};
}

}   // namespace meshfolio::cli
