/// @file
/// Answers of earlier runs: a question whose inputs, settings and code have not changed is not answered again. The meshes of a question
/// are known only after it has run, so the cache stores two things: the lookups, under settings and program identity; and the answer with
/// its files, under these and the present results of the lookups. The key of a section without lookups leaves out the user's meshes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "output/cache/result_cache.h"
#include "questions/core/mesh_library.h"
#include "report/document.h"
#include "report/drawn_figure.h"
#include "run/settings/report_settings.h"

namespace meshfolio::run {

/// [bytes]; MESHFOLIO_CACHE_LIMIT in the environment is in megabytes. @throws UsageError for what is no number from 1 to 1000000
std::uintmax_t cache_limit();

/// The cache in its default folder; null, with a warning, where it cannot be used: a report is made without.
std::unique_ptr<output::ResultCache> usable_cache();

/// A stored answer whose files lie in the report's folder already.
struct StoredAnswer {
    report::Section section;
    report::DrawnFigures figures;
    std::map<std::string, std::string> digests;   // of its files, by path in the report's folder
};

/// Every file of an answer, by path in the report's folder.
std::set<std::string> files_of(const report::Section& section, const report::DrawnFigures& figures);

class QuestionCache {
public:
    /// @param folder  of the report that is being made; the others must outlive this
    QuestionCache(output::ResultCache& store, const ReportSettings& settings, const MeshLibrary& meshes, std::filesystem::path folder);

    /// The stored answer of a question, its files put in place; nothing, and no file, where any of it is missing or damaged.
    std::optional<StoredAnswer> find(const std::string& question) const;

    /// Stores an answer whose files are in the report's folder.
    /// @return digests of its files, by path
    /// @throws OutputError, InputError
    std::map<std::string, std::string> keep(const report::Section& section, const report::DrawnFigures& figures,
                                            const std::vector<MeshLookup>& lookups) const;

private:
    output::ResultCache& store_;
    const ReportSettings& settings_;
    const MeshLibrary& meshes_;
    std::filesystem::path folder_;

    std::string question_key(const std::string& question, bool with_meshes) const;
    /// Of the answer that these lookups lead to now.
    std::string answer_key(const std::string& question, const std::vector<MeshLookup>& lookups) const;
    std::optional<StoredAnswer> read(const std::string& key) const;
    std::map<std::string, std::string> write(const std::string& key, const report::Section& section,
                                             const report::DrawnFigures& figures) const;
};

}   // namespace meshfolio::run
