#include "run/report_files.h"

#include <algorithm>

#include "base/file_bytes.h"
#include "base/parallel_tasks.h"
#include "output/publish/file_group.h"
#include "output/publish/folder_system.h"
#include "questions/core/section_tools.h"
#include "run/console.h"
#include "run/stored_report.h"

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

/// Writes the data of a plot or a map to tables/<id>.csv, and its picture to images/<id>.svg.
template <class Drawing> void write_drawing(const Drawing& drawing, const fs::path& folder) {
    write_file(folder / "tables" / (drawing.id + ".csv"), report::write_csv(report::table_of(drawing)));
    write_file(folder / "images" / (drawing.id + ".svg"), report::svg_on_white(report::svg_of(drawing)));
}

void write_tables_and_plots(const report::Document& document, const fs::path& folder) {
    for_each_task(document.sections.size(), [&](std::size_t i) {
        const report::Section& section = document.sections[i];
        for (const report::Block& block : section.blocks) {
            if (const auto* table = std::get_if<report::Table>(&block))
                write_file(folder / "tables" / (table->id + ".csv"), report::write_csv(*table));
            if (const auto* plot = std::get_if<report::Plot>(&block)) write_drawing(*plot, folder);
            if (const auto* map = std::get_if<report::Map>(&block)) write_drawing(*map, folder);
            if (const auto* diagram = std::get_if<report::Diagram>(&block))
                write_file(folder / "images" / (diagram->id + ".svg"), report::svg_on_white(report::svg_of(*diagram)));
        }
    });
}

}   // namespace

void write_meshes(const Answer& answer, const fs::path& folder) {
    for (const output::MeshOutput& mesh : answer.meshes) {
        fs::path path = fs::path("meshes") / mesh.name;
        for (const std::string& named : answer.section.output_meshes)
            if (fs::path(named).filename() == mesh.name) path = named;
        output::make_folder((folder / path).parent_path());
        write_mesh(folder / path, *mesh.mesh);
    }
}

void write_report_files(const report::Document& document, const report::DrawnFigures& figures, const report::Templates& templates,
                        const report::WriteOptions& options, const fs::path& folder) {
    for (const char* name : {"images", "meshes", "tables"}) output::make_folder(folder / name);
    const auto write_volume = [&](report::Volume volume) {
        report::WriteOptions own = options;
        own.volume = volume;
        write_file(folder / report::page_file(volume), report::write_html(document, figures, templates, own));
        write_file(folder / report::markdown_file(volume), report::write_markdown(document, figures, templates, own));
    };
    run_tasks([&] { write_volume(report::Volume::report); }, [&] { write_volume(report::Volume::appendix); },
              [&] { write_file(folder / "summary.md", report::write_summary(document, templates)); },
              [&] { write_file(folder / "results.json", report::write_json(document, figures, options)); },
              [&] { write_tables_and_plots(document, folder); });
}

namespace {

constexpr int most_lines = 4;   // of a kind: with a line a question and its notes they stay below 40

/// Prints at most `most_lines` lines, then the number of further ones.
void complain_about(const std::vector<std::string>& lines) {
    for (std::size_t i = 0; i < lines.size() && i < most_lines; ++i) complain(lines[i]);
    if (lines.size() > most_lines) complain("… and " + std::to_string(lines.size() - most_lines) + " more, see the report");
}

}   // namespace

void summarise(const report::Document& document) {
    std::vector<std::string> failures, checks;
    std::set<std::string> warnings;
    std::size_t undecided = 0;
    for (const report::Section& section : document.sections) {
        if (section.status == report::Status::failed) failures.push_back(section.id + " failed: " + section.failure);
        undecided += report::score_of(section.checks).undecided;
        for (const report::Check& check : section.checks) {
            if (!check.failed()) continue;
            checks.push_back(section.id + ": check failed: " + check.name + ": " + words_of(check) +
                             (check.note.empty() ? "" : " (" + check.note + ")"));
        }
        for (const std::string& warning : section.warnings) warnings.insert("warning: " + warning);
    }
    complain_about({warnings.begin(), warnings.end()});
    complain_about(failures);
    complain_about(checks);
    if (undecided > 0) complain(counted(static_cast<int>(undecided), "check") + " undecided, which is no failure: the report says why");
}

bool has_failed(const report::Document& document) {
    return std::ranges::any_of(document.sections, [](const report::Section& section) {
        return section.status == report::Status::failed || report::score_of(section.checks).failed > 0;
    });
}

Published publish_report(output::Publication& publication, const report::Document& document, const output::Publication::Digests& digests,
                         const ReportSettings& settings, const std::string& junit) {
    output::FileGroup others;
    if (!junit.empty()) add_junit(junit, report::write_junit(document, settings.timings), publication, settings.out, others);
    Published published{settings.out, settings.out, {}};
    if (has_failed(document) && ended_well(settings.out)) {
        publication.step_aside();
        published.folder = output::failed_beside(settings.out);
    }
    published.notes = publication.publish(digests);
    if (!has_failed(document))
        for (std::string& line : publication.remove_failed()) published.notes.kept.push_back(std::move(line));
    others.publish();
    return published;
}

void print_place(const Published& published) {
    tell_of(published.notes);
    if (published.folder != published.wanted)
        complain(published.wanted.string() + " keeps the report that ended well; this one is " + published.folder.string() +
                 ", until one ends well again");
}

std::string verdict_on(const report::Document& document, double seconds) {
    std::size_t answered = 0, asked = 0;
    report::Score score;
    for (const report::Section& section : document.sections) {
        score += report::score_of(section.checks);
        if (!report::is_question(section.id) || section.status == report::Status::skipped) continue;
        ++asked;
        answered += section.status == report::Status::ok ? 1 : 0;
    }
    std::string text = asked > 0 ? std::to_string(answered) + " of " + counted(static_cast<int>(asked), "question") + " answered, " : "";
    text += counted(static_cast<int>(score.passed), "check") + " passed";
    if (score.failed > 0) text += ", " + std::to_string(score.failed) + " failed";
    if (score.undecided > 0) text += ", " + std::to_string(score.undecided) + " undecided";
    return text + (seconds > 0 ? ", " + plain_text(seconds, seconds < 100 ? 2 : 3) + " s" : "");
}

}   // namespace meshfolio::run
