#include <memory>

#include "base/file_bytes.h"
#include "cli/commands.h"
#include "output/publish/publish.h"
#include "questions/core/chapter.h"
#include "run/arguments.h"
#include "run/console.h"
#include "run/provenance.h"
#include "run/report.h"

namespace meshfolio::cli {

namespace {

constexpr const char* all_measured = "tables/truth_all.csv";

struct VerifyFlags {
    std::string out;
    std::string seed = "1";
    bool quick = false;
};

/// Returns "ok      name: measured 1.99, expected 2, tolerance 0.15" as a line; for an undecided check with the reason.
std::string in_words(const report::Check& check) {
    const std::string line = check.name + ": " + words_of(check);
    if (check.status == report::Check::Status::undecided) return "undecided  " + line + " (" + check.note + ")\n";
    return (check.passed() ? "ok      " : "FAILED  ") + line + "\n";
}

/// Refuses to replace a report that is no verification, because both have one marker.
void require_no_other_report(const std::filesystem::path& out) {
    if (output::has_mark(out, output::report_folder) && may_be_there(out / results_file) && !may_be_there(out / all_measured))
        throw OutputError(out.string(), "holds a report that is no verification, and would be replaced",
                          "choose another folder with --out");
}

/// Returns the request for a report of the chapters that verify the program, on bundled meshes, with everything that they measure.
ReportRequest verification(const VerifyFlags& options) {
    auto settings = std::make_shared<ReportSettings>();
    settings->out = options.out;
    settings->seed = seed_of(options.seed);
    settings->quick = options.quick;
    settings->laboratory = true;
    settings->timings = false;
    settings->pdf = "off";
    ReportRequest request;
    request.settings = settings;
    request.head.title = "Verification: curvature against closed forms, certificates, planted faults";
    request.head.provenance = provenance_of({{"quick", options.quick ? "yes" : "no"}}, settings->seed);
    for (const Chapter* chapter : chapter_list())
        if (chapter->verifies_program) request.ids.emplace_back(chapter->id);
    request.sources = {[settings](std::string_view id, const std::filesystem::path&, ProgressDisplay& display) {
        const MeshLibrary bundled({}, {});
        const Progress progress = [&](std::string_view step) { display.step(std::string(step)); };
        const std::string name(id);
        return ReportSection{chapter_of_id(id).answer(bundled, question_settings(*settings, name), progress)};
    }};
    return request;
}

ExitCode run_verify(const VerifyFlags& options) {
    require_no_other_report(options.out);
    const ReportRequest request = verification(options);
    report::Document document;
    if (options.out.empty()) {
        document = gathered_document(request);
    } else {
        const MadeReport made = make_report(request);
        print_place(made.published);
        document = made.document;
    }
    std::string lines;
    report::Score score;
    for (const report::Section& section : document.sections) {
        for (const report::Check& check : section.checks) lines += in_words(check);
        score += report::score_of(section.checks);
    }
    print(for_terminal(lines) + inked(score.failed == 0 ? Ink::green : Ink::red, words_of(score)) + "\n");
    return score.failed == 0 ? ExitCode::ok : ExitCode::failed;
}

}   // namespace

Command verify_command(CLI::App& parent) {
    const auto options = std::make_shared<VerifyFlags>();
    CommandOptions app(parent, "verify", "This program against closed forms, certificates, planted faults");
    app.text("--out DIR", options->out,
             "folder for the tables, plots and discussion, replaced as a whole; a failure goes to DIR.failed if DIR holds a good one");
    app.text("--seed", options->seed, "of the random meshes");
    app.flag("--quick", options->quick, "three refinements in place of four");
    app.footer("Example: meshfolio verify --out truth");
    return {app, [options] { return run_verify(*options); }};
}

}   // namespace meshfolio::cli
