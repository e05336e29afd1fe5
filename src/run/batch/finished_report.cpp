#include "run/batch/finished_report.h"

#include <algorithm>
#include <tuple>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "output/draw/finished_picture.h"
#include "output/publish/publish.h"
#include "png/png.h"
#include "report/page/volumes.h"
#include "run/arguments.h"
#include "run/provenance.h"
#include "run/stored_report.h"

namespace meshfolio::run {

namespace fs = std::filesystem;

namespace {

/// Returns the cover picture of a report, so small that a page can hold hundreds.
std::optional<report::BatchRow::Picture> thumbnail(const StoredReport& report) {
    constexpr int side = 192, quality = 80;   // pixels; of JPEG
    const report::Figure* figure = report::cover_figure(report.document, report.figures);
    if (figure == nullptr) return {};
    const report::DrawnFigure& drawn = report.figures.at(figure->id);
    const auto bytes = report.bytes_of(drawn.sheet);
    const auto sheet = bytes ? render::decode_png(*bytes) : std::nullopt;
    const report::DrawnPicture& place = drawn.panels.front().pictures.front();
    if (!sheet || place.left < 0 || place.top < 0 || place.width > sheet->width - place.left || place.height > sheet->height - place.top)
        return {};
    render::Image picture = output::part_of(*sheet, place.left, place.top, place.width, place.height);
    const double scale = std::min(1.0, static_cast<double>(side) / std::max(picture.width, picture.height));
    const auto scaled = [&](int pixels) { return std::max(1, static_cast<int>(scale * pixels)); };
    if (scale < 1) picture = render::shrink(picture, scaled(picture.width), scaled(picture.height));
    return report::BatchRow::Picture{render::encode_jpeg(picture, quality), figure->alt, picture.width, picture.height};
}

report::BatchRow row_of(const BatchMesh& mesh, const StoredReport& report, const std::string& folder) {
    report::BatchSources sources;
    for (const Chapter* chapter : chapter_list())
        for (const auto& [key, column] : chapter->batch) sources[key] = std::string(chapter->id) + "_" + std::string(column);
    report::BatchRow row = report::batch_row(mesh.name, mesh.file, report.document, report.timings, sources);
    row.report = folder + "/index.html";
    row.picture = thumbnail(report);
    return row;
}

const report::Input* input_with(const report::Document& document, const std::string& sha256) {
    for (const report::Section& section : document.sections) {
        const auto input = std::ranges::find(section.inputs, sha256, &report::Input::sha256);
        if (input != section.inputs.end()) return &*input;
    }
    return nullptr;
}

/// Returns true if a report of these settings has the words of this document.
bool has_the_words_of(const report::Document& document, const ReportSettings& settings) {
    report::Document words = head_of(settings);
    for (const report::Section& section : document.sections) words.sections.emplace_back().id = section.id;
    enter_words(words, settings, false);
    const auto of_head = [](const auto& one) { return std::tie(one.title, one.author, one.course, one.pages); };
    const auto of_section = [](const auto& one) { return std::tie(one.id, one.title, one.number, one.points, one.intro); };
    return of_head(words) == of_head(document) && std::ranges::equal(words.sections, document.sections, {}, of_section, of_section);
}

/// Returns true if every section that is asked for and planned is there and has no failure.
bool is_complete(const report::Document& document, const ReportSettings& settings) {
    return std::ranges::all_of(document.sections, [&](const report::Section& section) {
        if (section.status == report::Status::skipped)
            return !is_asked_for(settings, section.id) || effort_of(settings, section.id).left_out;
        return section.status == report::Status::ok;
    });
}

bool is_the_same(const StoredReport& report, const BatchMesh& mesh, const std::string& sha256, const ReportSettings& settings) {
    const report::Input* input = input_with(report.document, sha256);
    if (input == nullptr || report.timings != settings.timings) return false;
    const ReportSettings own = settings_on(mesh, std::max<double>(input->vertices, 0.5 * input->triangles), settings);
    return difference(report.document.provenance, provenance_of(described(own), own.seed)).empty() &&
           has_the_words_of(report.document, own) && report::cites_source(report.document) == has_source(own) &&
           is_complete(report.document, own);
}

}   // namespace

ReportSettings settings_on(const BatchMesh& mesh, double vertices, ReportSettings settings) {
    settings.meshes = {mesh.file};
    settings.efforts = plan_for(settings, {{fs::path(mesh.file).filename().string(), vertices}}).efforts();
    return settings;
}

report::BatchRow row_of_report(const BatchMesh& mesh, const fs::path& out, const std::string& folder) {
    return row_of(mesh, StoredReport(out / folder / results_file), folder);
}

std::optional<report::BatchRow> finished_row(const BatchMesh& mesh, const std::string& sha256, const ReportSettings& settings) {
    for (const std::string& folder : {mesh.name, output::failed_beside(mesh.name).string()}) {
        try {
            if (!may_be_there(settings.out / folder / results_file)) continue;
            const StoredReport report(settings.out / folder / results_file);
            const bool is_printed = settings.pdf != "require" || may_be_there(settings.out / folder / "report.pdf");
            if (is_printed && is_the_same(report, mesh, sha256, settings) && output::first_changed(settings.out / folder).empty())
                return row_of(mesh, report, folder);
        } catch (const InputError&) {   // of another version, or damaged: it is made again
        }
    }
    return {};
}

}   // namespace meshfolio::run
