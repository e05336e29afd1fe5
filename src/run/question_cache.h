/// @file
/// Answers of earlier runs: a question whose inputs, settings and code have not changed is not answered again. The meshes of a question
/// are known only after it has run, so the cache stores two things: the lookups, under settings and program identity; and the answer with
/// its files, under these and the present results of the lookups. The key of a section without lookups leaves out the user's meshes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
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

/// The picture for the first page that an answer offers: the figure of one mesh with values that is most worth seeing.
struct CoverOffer {
    bool turnable = false;
    double worth = 0;   // 1 + how much its mesh is bent [rad]; 0: nothing is offered
    std::string alt;

    bool beats(const CoverOffer& other) const { return std::pair(turnable, worth) > std::pair(other.turnable, other.worth); }
};

/// A stored answer whose files lie in the report's folder already.
struct StoredAnswer {
    report::Section section;
    report::DrawnFigures figures;
    std::map<std::string, std::string> digests;   // of its files, by path in the report's folder
    CoverOffer cover;
    std::function<std::optional<StoredAnswer>()> find_cover;   // the first page's picture made from it, if that is stored
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
    std::map<std::string, std::string> keep(const report::Section& section, const report::DrawnFigures& figures, const CoverOffer& cover,
                                            const std::vector<MeshLookup>& lookups) const;

    /// The first page's picture, made from the answer with this key.
    std::map<std::string, std::string> keep_cover(const std::string& answer_key, const report::DrawnFigure& cover) const;

    /// Of the answer that these lookups lead to now.
    std::string answer_key(const std::string& question, const std::vector<MeshLookup>& lookups) const;

private:
    output::ResultCache& store_;
    const ReportSettings& settings_;
    const MeshLibrary& meshes_;
    std::filesystem::path folder_;

    std::string question_key(const std::string& question, bool with_meshes) const;
    std::optional<StoredAnswer> read(const std::string& key) const;
    std::map<std::string, std::string> write(const std::string& key, const report::Section& section, const report::DrawnFigures& figures,
                                             const CoverOffer& cover) const;
};

}   // namespace meshfolio::run
