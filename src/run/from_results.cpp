#include <utility>
#include <vector>

#include "report/writers.h"
#include "run/console.h"
#include "run/earlier_report.h"
#include "run/paper_copy.h"
#include "run/report_files.h"
#include "run/stored_results.h"

namespace meshfolio::run {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t most_named = 8;

void refuse_computing_options(const ReportFlags& flags) {
    const std::pair<const char*, bool> options[] = {
        {"MESH", !flags.meshes.empty()}, {"--only", !flags.only.empty()}, {"--data", !flags.data.empty()},
        {"--size", !flags.size.empty()}, {"--quick", flags.quick},        {"--fail-fast", flags.fail_fast},
        {"--part", !flags.part.empty()}, {"--time", !flags.time.empty()}, {"--plan", flags.plan || flags.json}};
    for (const auto& [name, is_given] : options)
        if (is_given) throw UsageError(std::string(name) + " cannot be given with --from", "nothing is computed; leave one of them out");
}

/// What flags and a settings file say of the report itself; the rest of them has no use here.
ReportSettings words_given(const ReportFlags& flags, report::Document& document, report::Templates& templates) {
    ReportSettings words;
    words.title = document.title;
    words.author = document.author;
    words.course = document.course;
    if (!flags.config.empty()) words = read_settings(flags.config, words);
    if (!flags.author.empty()) words.author = flags.author;
    document.title = words.title;
    document.author = words.author;
    document.course = words.course;
    if (words.page.file) templates.replace("report.html", *words.page.file);
    return words;
}

void warn_of_missing(const std::vector<std::string>& missing) {
    for (std::size_t i = 0; i < missing.size() && i < most_named; ++i) warn(missing[i] + " is missing from the earlier report");
    if (missing.size() > most_named) warn("… and " + std::to_string(missing.size() - most_named) + " files more");
}

}   // namespace

ExitCode report_from_results(const ReportFlags& flags) {
    refuse_computing_options(flags);
    ReportSettings settings = report_settings(flags);
    check_output("--junit", flags.junit, {".xml"}, settings.out);
    const auto threads = limited_threads(settings);
    std::vector<EarlierReport> parts;
    if (!flags.from.empty()) parts.emplace_back(flags.from);
    for (const std::string& folder : flags.parts) parts.emplace_back(fs::path(folder) / "results.json");
    for (EarlierReport& part : parts) part.restore_figures();
    JoinedReport whole = joined(parts);
    report::Templates templates(settings.templates);
    const ReportSettings words = words_given(flags, whole.document, templates);
    PaperCopy paper(settings, templates);
    const auto store = flags.no_cache ? nullptr : cache_for_report();
    output::Publication publication(settings.out);
    output::Publication::Digests digests;
    std::vector<std::string> missing;
    for (const EarlierReport& part : parts)
        for (std::string& file : part.copy_to(publication.folder(), digests)) missing.push_back(std::move(file));
    settings.timings = parts.size() == 1 && parts.front().timings && !flags.no_timings;   // those of parts add up to nothing
    const report::WriteOptions options{.timings = settings.timings,
                                       .plot_files = true,
                                       .paper = paper.is_wanted(),
                                       .design = words.page.design,
                                       .labs = std::move(whole.labs)};
    try {
        write_report_files(whole.document, whole.figures, templates, options, {}, {}, publication.folder());
    } catch (const std::logic_error& error) {   // a text refers to what is not there
        throw InputError({parts.front().file}, error.what(), "take a whole results.json");
    }
    Printing appendix = paper.begin(report::Volume::appendix, whole.document, whole.figures, store.get(), publication.folder());
    std::vector<std::string> notes{
        paper.begin(report::Volume::report, whole.document, whole.figures, store.get(), publication.folder()).warning()};
    notes.push_back(appendix.warning());
    const Published published = publish_report(publication, whole.document, digests, settings, flags.junit);
    warn_of_missing(missing);
    return tell(published, notes, whole.document, 0);
}

}   // namespace meshfolio::run
