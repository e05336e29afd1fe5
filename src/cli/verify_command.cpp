#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "base/file_bytes.h"
#include "cli/commands.h"
#include "output/publish/publish.h"
#include "questions/core/chapter.h"
#include "questions/truth/parts.h"
#include "run/arguments.h"
#include "run/console.h"
#include "run/progress.h"
#include "run/provenance.h"
#include "run/report_files.h"

namespace meshfolio::cli {

namespace {

constexpr const char* all_measured = "tables/truth_all.csv";

struct VerifyFlags {
    std::string out;
    std::string seed = "1";
    bool quick = false;
};

std::uint64_t seed_of(const VerifyFlags& options) {
    return static_cast<std::uint64_t>(integer_between("--seed", options.seed, 0, std::numeric_limits<std::int64_t>::max()));
}

/// "ok      name: measured 1.99, expected 2, tolerance 0.15"; of what is undecided, the reason too.
std::string in_words(const report::Check& check) {
    const std::string line = check.name + ": " + words_of(check);
    if (check.status == report::Check::Status::undecided) return "undecided  " + line + " (" + check.note + ")\n";
    return (check.passed() ? "ok      " : "FAILED  ") + line + "\n";
}

/// The sections as a report of their own, and everything measured on curvature as tables/truth_all.csv.
void write_report(const VerifyFlags& options, const truth::GroundTruth& truth, const std::vector<report::Section>& sections) {
    output::Publication publication(options.out);
    report::Document document;
    document.title = "Verification: curvature against closed forms, certificates, planted faults";
    document.provenance = provenance_of({{"quick", options.quick ? "yes" : "no"}}, seed_of(options));
    document.sections = sections;
    write_report_files(document, {}, report::Templates(), {.timings = false, .plot_files = true}, {}, {}, publication.folder());
    write_file(publication.folder() / all_measured, report::write_csv(truth::ground_truth_table(truth)));
    tell_of(publication.publish());
}

/// Of bundled meshes, with the planted faults.
report::Section certificates(const VerifyFlags& options, const Progress& progress) {
    QuestionSettings settings;
    settings.quick = options.quick;
    return chapter_of_id("certificates").answer(MeshLibrary({}, {}), settings, progress).section;
}

/// A report of another kind has the same mark, and is no less work: verify does not take its place.
void require_no_other_report(const std::filesystem::path& out) {
    if (output::has_mark(out, output::report_folder) && may_be_there(out / "results.json") && !may_be_there(out / all_measured))
        throw OutputError(out.string(), "holds a report that is no verification, and would be replaced",
                          "choose another folder with --out");
}

ExitCode run_verify(const VerifyFlags& options) {
    require_no_other_report(options.out);
    truth::GroundTruth truth;
    std::vector<report::Section> sections;
    {
        ProgressDisplay display(stderr_is_terminal());
        const Progress progress = [&](std::string_view step) { display.step(std::string(step)); };
        truth = truth::ground_truth(seed_of(options), options.quick, progress);
        sections = {truth::ground_truth_section(truth), certificates(options, progress)};
    }
    if (!options.out.empty()) write_report(options, truth, sections);
    std::string lines;
    report::Score score;
    for (const report::Section& section : sections) {
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
    app.text("--out DIR", options->out, "folder for the tables, plots and discussion, replaced as a whole; default: none");
    app.text("--seed", options->seed, "of the random meshes");
    app.flag("--quick", options->quick, "three refinements in place of four");
    app.footer("Example: meshfolio verify --out truth");
    return {app, [options] { return run_verify(*options); }};
}

}   // namespace meshfolio::cli
