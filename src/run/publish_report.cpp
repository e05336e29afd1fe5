#include "run/publish_report.h"

#include "base/file_bytes.h"
#include "output/publish/file_group.h"
#include "output/publish/folder_system.h"
#include "report/writers.h"
#include "run/console.h"
#include "run/earlier_report.h"
#include "run/report_files.h"

namespace meshfolio::run {

namespace fs = std::filesystem;

namespace {

/// Writes the file with the report if it is inside, else adds it to the files published afterwards.
void add_junit(const std::string& file, std::string_view text, const output::Publication& publication, const fs::path& out,
               output::FileGroup& others) {
    const fs::path inside = output::path_inside(file, out);
    if (inside.empty()) return others.add(file, text);
    output::make_folder((publication.folder() / inside).parent_path());
    write_file(publication.folder() / inside, text);
}

}   // namespace

Published publish_report(output::Publication& publication, const report::Document& document, const output::Publication::Digests& digests,
                         const ReportSettings& settings, const std::string& junit) {
    output::FileGroup others;
    if (!junit.empty()) add_junit(junit, report::write_junit(document, settings.timings), publication, settings.out, others);
    Published published{settings.out, settings.out, ""};
    if (has_failed(document) && ended_well(settings.out)) {
        publication.step_aside();
        published.folder = output::failed_beside(settings.out);
    }
    published.note = publication.publish(digests);
    if (!has_failed(document)) publication.remove_failed();
    others.publish();
    return published;
}

ExitCode tell(const Published& published, std::vector<std::string> notes, const report::Document& document) {
    notes.insert(notes.begin(), published.note);
    for (const std::string& note : notes) {
        if (!note.empty()) warn(note);
    }
    summarise(document);
    if (published.folder != published.wanted) {
        complain(published.wanted.string() + " keeps the report that ended well; this one is " + published.folder.string() +
                 ", until one ends well again");
    }
    print_path(published.folder / "index.html");
    return has_failed(document) ? ExitCode::failed : ExitCode::ok;
}

}   // namespace meshfolio::run
