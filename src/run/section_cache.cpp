#include "run/section_cache.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "questions/core/section_tools.h"
#include "report/words.h"
#include "run/arguments.h"
#include "run/console.h"
#include "run/provenance.h"

namespace meshfolio::run {

namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t bytes_of_megabyte = 1'000'000;              // as `doctor` and `cache` report sizes
constexpr std::uintmax_t default_limit = 2048 * bytes_of_megabyte;   // about ten full reports
constexpr const char* form = "meshfolio section 1";                  // of an entry: another form has other keys

/// Returns false for file names that JSON cannot hold: they would come back changed.
bool has_plain_names(const report::Section& section) {
    return std::ranges::all_of(section.inputs, [](const report::Input& input) {
        return printable(input.file) == input.file && printable(input.asked) == input.asked;
    });
}

}   // namespace

std::vector<MeshLookup> meshes_read_by(const Chapter& chapter, const ReportSettings& settings) {
    const QuestionSettings question = question_settings(settings, std::string(chapter.id));
    using By = MeshLookup::By;
    std::vector<MeshLookup> meshes;
    if (!settings.meshes.empty()) {
        if (chapter.roles.empty()) return meshes;
        for (const fs::path& own : settings.meshes) meshes.push_back({.by = By::own, .path = own});
        return meshes;
    }
    for (const std::string& path : question.meshes) meshes.push_back({.by = By::file, .path = path});
    if (question.meshes.empty())
        for (const std::string_view role : chapter.roles) meshes.push_back({.by = By::role, .name = std::string(role)});
    return meshes;
}

std::string SectionCache::key_of(const Chapter& chapter) const {
    const std::string id(chapter.id);
    output::KeyMaker key;
    key.add(form).add(program_identity()).add(report::words_identity()).add(id);
    for (const std::string& word : identity_of(settings_, id)) key.add(word);
    for (const MeshLookup& mesh : meshes_read_by(chapter, settings_)) key.add(meshes_.identity_of(mesh, settings_.base));
    return key.key();
}

std::optional<ReportSection> SectionCache::find(const Chapter& chapter, const fs::path& folder) const try {
    const auto entry = store_.get(key_of(chapter));
    if (!entry) return {};
    const StoredReport report(*entry, store_);
    const report::Section& stored = report.document.sections.front();
    try {
        ReportSection section = report.section(stored, folder);
        section.origin = ReportSection::Origin::cache;
        if (section.missing.empty() && section.figures.size() == report.figures.size()) return section;
    } catch (const InputError&) {   // a damaged picture
    }
    std::error_code ignored;
    for (const std::string& path : files_of(stored, report.figures)) fs::remove(folder / path, ignored);
    return {};
} catch (const InputError&) {   // damaged, or written by another version
    return {};
}

output::Digests SectionCache::keep(const report::Section& section, const report::DrawnFigures& all, const fs::path& folder) const {
    if (section.status != report::Status::ok || misses_a_mesh(section) || !has_plain_names(section)) return {};
    report::DrawnFigures figures;
    for (const auto& [id, figure] : all)
        if (id.starts_with(section.id + "_")) figures.emplace(id, figure);
    const std::vector<std::string> files = files_of(section, figures);
    std::vector<std::string> digests(files.size());
    tbb::parallel_for(std::size_t{0}, files.size(), [&](std::size_t i) { digests[i] = store_.keep(read_file(folder / files[i])); });
    output::Digests known;
    for (std::size_t i = 0; i < files.size(); ++i) known[files[i]] = digests[i];

    output::Digests entry = known;
    for (const auto& [id, figure] : figures) {
        std::size_t number = 0;
        for (const report::DrawnPanel& panel : figure.panels)
            for (const report::DrawnPicture& picture : panel.pictures) entry[jpeg_file(id, number++)] = store_.keep(picture.jpeg);
    }
    report::Document document;
    document.sections = {section};
    document.sections.front().timings.clear();   // of this run
    entry[results_file] = store_.keep(report::write_json(document, figures));
    store_.put(key_of(chapter_of_id(section.id)), output::sums_text(entry));
    return known;
}

std::uintmax_t cache_limit() {
    const std::string given = environment("MESHFOLIO_CACHE_LIMIT");
    if (given.empty()) return default_limit;
    return static_cast<std::uintmax_t>(integer_between("MESHFOLIO_CACHE_LIMIT", given, 1, 1000000)) * bytes_of_megabyte;
}

std::unique_ptr<output::ResultCache> usable_cache() {
    const std::uintmax_t limit = cache_limit();
    const auto folder = output::default_cache_folder();
    if (!folder) {
        warn("no cache is used: neither XDG_CACHE_HOME nor HOME names a folder");
        return nullptr;
    }
    try {
        return std::make_unique<output::ResultCache>(*folder, limit);
    } catch (const OutputError& error) {
        warn("no cache is used: " + std::string(error.what()));
        return nullptr;
    }
}

std::unique_ptr<output::ResultCache> cache_for_report() {
    return !environment("MESHFOLIO_FAIL").empty() || program_identity().empty() ? nullptr : usable_cache();
}

}   // namespace meshfolio::run
