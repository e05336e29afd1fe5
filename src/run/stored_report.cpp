#include "run/stored_report.h"

#include <algorithm>
#include <set>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "base/parallel_tasks.h"
#include "base/sha256.h"
#include "output/draw/finished_picture.h"
#include "output/publish/folder_system.h"
#include "png/png.h"
#include "run/console.h"
#include "run/report_files.h"

namespace meshfolio::run {

namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t largest_file = std::uintmax_t{1} << 30;   // bytes

}   // namespace

std::vector<std::string> files_of(const report::Section& section, const report::DrawnFigures& figures) {
    std::set<std::string> files(section.output_meshes.begin(), section.output_meshes.end());
    for (const auto& [id, figure] : figures) {
        files.insert(figure.sheet);
        for (const report::DrawnPanel& panel : figure.panels)
            for (const report::DrawnPicture& picture : panel.pictures)
                if (!picture.file.empty()) files.insert(picture.file);
        for (const report::DrawnModel& model : figure.models) files.insert(model.file);
    }
    return {files.begin(), files.end()};
}

std::string jpeg_file(const std::string& figure, std::size_t picture) { return "jpeg/" + figure + "_" + std::to_string(picture) + ".jpg"; }

StoredReport::StoredReport(const fs::path& results) : file(results.string()) {
    const fs::path folder = results.has_parent_path() ? results.parent_path() : fs::path(".");
    read_ = [folder](const std::string& path, const std::string& digest) -> std::optional<std::string> {
        std::error_code error;
        if (!fs::exists(folder / path, error)) return {};
        std::string bytes = read_file(folder / path, largest_file);
        if (digest != sha256(bytes))
            throw InputError({(folder / path).string()}, "is not the file that SHA256SUMS lists", "restore it, or make the report anew");
        return bytes;
    };
    read(read_file(results, largest_results));
    sums_ = output::parse_sums(read_file(folder / output::sums_file, largest_results), folder / output::sums_file);
}

StoredReport::StoredReport(const std::string& sums, output::ResultCache& store) : file("cache") {
    sums_ = output::parse_sums(sums, "cache");
    read_ = [&store](const std::string&, const std::string& digest) { return store.bytes_of(digest); };
    const auto results = bytes_of(results_file);
    if (!results) throw InputError({"cache"}, "has lost a file");
    read(*results);
    if (document.sections.size() != 1) throw InputError({"cache"}, "has an entry that is not one section");
}

void StoredReport::read(const std::string& results) {
    report::ReadReport report = report::read_json(results, file);
    document = std::move(report.document);
    figures = std::move(report.figures);
    timings = report.timings;
}

std::optional<std::string> StoredReport::bytes_of(const std::string& path) const {
    const auto sum = sums_.find(path);
    return read_(path, sum == sums_.end() ? "" : sum->second.digest);
}

/// Reads the JPEGs where the cache has them, else cuts them out of the sheet, which gives equal bytes.
/// @return false where the sheet or one of the JPEGs is gone
bool StoredReport::restore(const std::string& id, report::DrawnFigure& figure) const {
    if (sums_.contains(jpeg_file(id, 0))) {
        std::size_t number = 0;
        for (report::DrawnPanel& panel : figure.panels)
            for (report::DrawnPicture& picture : panel.pictures) {
                auto jpeg = bytes_of(jpeg_file(id, number++));
                if (!jpeg) return false;
                picture.jpeg = std::move(*jpeg);
            }
    } else {
        const auto bytes = bytes_of(figure.sheet);
        if (!bytes) return false;
        const auto sheet = render::decode_png(*bytes);
        if (!sheet) throw InputError({figure.sheet}, "is not a PNG that can be read", "make the report anew");
        if (!output::cut_pictures(*sheet, figure))
            throw InputError({figure.sheet}, "is smaller than results.json says", "make the report anew");
    }
    for (report::DrawnModel& model : figure.models) model.glb = bytes_of(model.file).value_or("");
    std::erase_if(figure.models, [](const report::DrawnModel& model) { return model.glb.empty(); });
    return true;
}

ReportSection StoredReport::section(const report::Section& section, const fs::path& folder) const {
    ReportSection stored{.answer = {section}, .origin = ReportSection::Origin::report};
    for (const auto& [id, figure] : figures)
        if (id.starts_with(section.id + "_")) stored.figures.emplace(id, figure);
    const std::vector<std::string> files = files_of(section, stored.figures);
    std::vector<std::string> digests(files.size());
    for (const std::string& path : files) output::make_folder((folder / path).parent_path());
    for_each_task(files.size(), [&](std::size_t i) {
        const auto bytes = bytes_of(files[i]);
        if (!bytes) return;
        write_file(folder / files[i], *bytes);
        digests[i] = sums_.at(files[i]).digest;
    });
    for (std::size_t i = 0; i < files.size(); ++i) {
        if (digests[i].empty()) stored.missing.push_back(files[i]);
        else stored.files[files[i]] = digests[i];
    }
    std::vector<std::string> ids;
    for (const auto& [id, figure] : stored.figures) ids.push_back(id);
    std::vector<char> is_whole(ids.size());
    for_each_task(ids.size(), [&](std::size_t i) { is_whole[i] = restore(ids[i], stored.figures.at(ids[i])); });
    for (std::size_t i = 0; i < ids.size(); ++i)
        if (!is_whole[i]) stored.figures.erase(ids[i]);
    return stored;
}

std::vector<report::Lab> StoredReport::labs() const try {
    const auto page = bytes_of(report::page_file(report::Volume::report));
    return page ? report::labs_in(*page) : std::vector<report::Lab>();
} catch (const InputError& error) {
    warn(std::string(error.what()) + ": the page is without its live laboratory");
    return {};
}

report::ReadReport read_report(const fs::path& path) {
    std::error_code error;
    const fs::path file = fs::is_directory(path, error) ? path / results_file : path;
    return report::read_json(read_file(file, largest_results), file.string());
}

bool ended_well(const fs::path& folder) try {
    return !has_failed(read_report(folder / results_file).document);
} catch (const InputError&) {   // no report; or one of another version, which counts as good
    return may_be_there(folder / results_file);
}

}   // namespace meshfolio::run
