#include <memory>

#include "cli/commands.h"
#include "questions/core/chapter.h"
#include "run/console.h"
#include "run/provenance.h"
#include "run/report.h"
#include "submission/submission.h"

namespace meshfolio::cli {

namespace {

struct SubmitFlags {
    ReportFlags report;
    submission::SubmissionOptions submission;
    bool without_pdf = false, with_images = false, without_tests = false;
};

/// Renders the report again, with the author's name and the source.
void complete(ReportFlags flags, bool pdf) {
    flags.from = (std::filesystem::path(flags.out) / results_file).string();
    if (pdf) flags.pdf = "require";
    ReportRequest request = rendering_request(flags);
    const report::Provenance now = provenance_of({}, 0), &made = request.head.provenance;
    if (made.version != now.version || made.commit != now.commit)
        throw InputError({flags.from}, "was written by another version", submission::renew);
    request.source_text = [] { return own_source().text(); };
    request.cites_source = true;
    make_report(request);
}

ExitCode run_submit(SubmitFlags options) {
    options.submission.pdf = !options.without_pdf;
    options.submission.images = options.with_images;
    options.submission.tests = !options.without_tests;
    options.submission.author = options.report.author;
    const ReportSettings sheet = report_settings(options.report);   // refuses a wrong author, too
    for (const Chapter* chapter : chapter_list())
        if (chapter->is_question() && is_asked_for(sheet, chapter->id)) options.submission.questions.emplace_back(chapter->id);
    submission::ReportFolder report = submission::read_report(options.report.out);
    if (!submission::require_ready(report, own_source(), options.submission).is_complete) {
        complete(options.report, options.submission.pdf);
        report = submission::read_report(options.report.out);
    }
    const submission::Submission submission = submission::pack(report, own_source(), options.submission);
    tell_of(submission::publish(report, submission));
    if (!report.others.empty())
        warn("not packed, for the report does not list it: " + report.others.front() +
             (report.others.size() > 1 ? " and " + std::to_string(report.others.size() - 1) + " more" : ""));
    for (const std::string& warning : submission.warnings) warn(warning);
    const std::size_t tenths = (submission.zip.size() + 50000) / 100000;   // of a megabyte
    complain(std::to_string(submission.files) + " files, " + std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) +
             " MB, checked and packed");
    print_path(report.path / "submission.zip");
    return ExitCode::ok;
}

}   // namespace

Command submit_command(CLI::App& parent) {
    const auto options = std::make_shared<SubmitFlags>();
    CommandOptions app(parent, "submit", "submission.zip from a built report, checked");
    options->report.out = "out";
    app.text("--out DIR", options->report.out, "folder of the report; the archive is put into it");
    app.text("--author NAME", options->report.author, "author, whose name the report gets; default: the author that the report names");
    app.text("--config SETTINGS", options->report.config,
             "settings of the sheet, whose questions must be answered; default: all questions");
    app.flag("--without-pdf", options->without_pdf, "hand in without report.pdf and appendix.pdf");
    app.flag("--without-tests", options->without_tests, "pack the source without its tests");
    app.flag("--with-images", options->with_images, "pack images/ and the Markdown too, which the pages do not need");
    app.footer(
        "Refuses the report, and changes nothing, if a question is missing, a citation does not resolve, the report is of another "
        "version,\n"
        "a file was changed, or a file is a program.\n"
        "Example: meshfolio submit --out out --author 'Ada Lovelace'");
    return {app, [options] { return run_submit(*options); }};
}

}   // namespace meshfolio::cli
