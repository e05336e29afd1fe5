#include <memory>

#include "cli/commands.h"
#include "questions/core/chapter.h"
#include "run/console.h"
#include "run/provenance.h"
#include "submission/submission.h"

namespace meshfolio::cli {

namespace {

struct SubmitFlags {
    std::string out = "out";
    submission::SubmissionOptions submission;
    bool without_pdf = false, with_images = false;
};

ExitCode run_submit(SubmitFlags options) {
    options.submission.pdf = !options.without_pdf;
    options.submission.images = options.with_images;
    for (const Chapter* chapter : chapter_list())
        if (chapter->is_question()) options.submission.questions.emplace_back(chapter->id);
    const submission::ReportFolder report = submission::read_report(options.out);
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
    app.text("--out DIR", options->out, "folder of the report; the archive is put into it");
    app.text("--author NAME", options->submission.author, "author; default: the author that the report names");
    app.flag("--without-pdf", options->without_pdf, "hand in without report.pdf and appendix.pdf");
    app.flag("--with-images", options->with_images, "pack images/ and the Markdown too, which the pages do not need");
    app.footer(
        "Refuses the report, and changes nothing, if a question is missing, a citation does not resolve, the report is of another "
        "version,\n"
        "a file was changed, or a file is a program.\n"
        "Example: meshfolio submit --out out --author 'Ada Lovelace'");
    return {app, [options] { return run_submit(*options); }};
}

}   // namespace meshfolio::cli
