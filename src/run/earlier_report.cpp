#include "run/earlier_report.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "base/parallel_tasks.h"
#include "base/sha256.h"
#include "output/draw/finished_picture.h"
#include "output/publish/folder_system.h"
#include "png/png.h"
#include "report/json/read_json.h"
#include "run/console.h"

namespace meshfolio::run {

namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t largest_results = std::uintmax_t{256} << 20;
constexpr std::uintmax_t largest_file = std::uintmax_t{1} << 30;

/// Is the file copied unchanged? The others are written anew.
bool is_taken_over(const std::string& file) {
    if (file == "src.txt") return true;
    const bool in_folder = file.find('/') != std::string::npos;
    return in_folder && !file.starts_with("tables/") && !(file.starts_with("images/") && file.ends_with(".svg"));
}

/// SHA256SUMS comes from outside as well.
fs::path inside(const fs::path& target, const std::string& file) {
    const fs::path path = fs::path(file).lexically_normal();
    if (path.is_absolute() || *path.begin() == ".." || path != fs::path(file))
        throw InputError({output::sums_file}, "names '" + file + "', which is no file inside the report");
    return target / path;
}

}   // namespace

EarlierReport::EarlierReport(const fs::path& results)
    : file(results.string()), folder_(results.has_parent_path() ? results.parent_path() : fs::path(".")) {
    report::ReadReport read = report::read_json(read_file(results, largest_results), file);
    document = std::move(read.document);
    figures = std::move(read.figures);
    timings = read.timings;
    sums_ = output::parse_sums(read_file(folder_ / output::sums_file, largest_results), folder_ / output::sums_file);
}

std::optional<std::string> EarlierReport::bytes_of(const std::string& path) const {
    std::error_code error;
    if (!fs::exists(folder_ / path, error)) return {};
    std::string bytes = read_file(folder_ / path, largest_file);
    const auto sum = sums_.find(path);
    if (sum == sums_.end() || sum->second.digest != sha256(bytes))
        throw InputError({(folder_ / path).string()}, "is not the file that SHA256SUMS tells of", "restore it, or make the report anew");
    return bytes;
}

bool EarlierReport::restore(report::DrawnFigure& figure) const {
    const auto bytes = bytes_of(figure.sheet);
    if (!bytes) return false;
    const auto sheet = render::decode_png(*bytes);
    if (!sheet) throw InputError({figure.sheet}, "is not a PNG that can be read", "make the report anew");
    if (!output::cut_pictures(*sheet, figure))
        throw InputError({figure.sheet}, "is smaller than results.json says", "make the report anew");
    for (report::DrawnModel& model : figure.models) {
        auto glb = bytes_of(model.file);
        if (glb) model.glb = std::move(*glb);
    }
    std::erase_if(figure.models, [](const report::DrawnModel& model) { return model.glb.empty(); });
    return true;
}

void EarlierReport::restore_figures() {
    std::vector<std::string> ids;
    for (const auto& [id, figure] : figures) ids.push_back(id);
    std::vector<char> is_whole(ids.size());
    for_each_task(ids.size(), [&](std::size_t i) { is_whole[i] = restore(figures.at(ids[i])); });
    for (std::size_t i = 0; i < ids.size(); ++i)
        if (!is_whole[i]) figures.erase(ids[i]);
}

std::vector<std::string> EarlierReport::copy_to(const fs::path& target, output::Publication::Digests& digests) const {
    std::vector<std::string> files, missing;
    for (const auto& [file_of_it, sum] : sums_)
        if (is_taken_over(file_of_it)) files.push_back(file_of_it);
    for (const std::string& one : files) output::make_folder(inside(target, one).parent_path());
    std::vector<char> is_there(files.size());
    for_each_task(files.size(), [&](std::size_t i) {
        const auto bytes = bytes_of(files[i]);
        is_there[i] = bytes.has_value();
        if (bytes) write_file(target / files[i], *bytes);
    });
    for (std::size_t i = 0; i < files.size(); ++i) {
        if (is_there[i])
            digests[files[i]] = sums_.at(files[i]).digest;
        else
            missing.push_back(files[i]);
    }
    return missing;
}

std::vector<report::Lab> EarlierReport::labs() const try {
    const auto page = bytes_of(report::page_file(report::Volume::report));
    return page ? report::labs_in(*page) : std::vector<report::Lab>();
} catch (const InputError& error) {
    warn(std::string(error.what()) + ": the page is without its live laboratory");
    return {};
}

bool ended_well(const fs::path& folder) try {
    using nlohmann::json;
    const json results = json::parse(read_file(folder / "results.json", largest_results));
    const auto has_failed = [](const json& part) { return part.value("status", "") == "failed"; };
    for (const char* kind : {"questions", "supporting"}) {
        for (const json& section : results.at(kind))
            if (has_failed(section) || std::ranges::any_of(section.at("checks"), has_failed)) return false;
    }
    return true;
} catch (const InputError&) {   // no report
    return false;
} catch (const nlohmann::json::exception&) {   // not a report
    return false;
}

}   // namespace meshfolio::run
