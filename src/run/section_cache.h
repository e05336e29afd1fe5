/// @file
/// The cache of answered sections. A section is stored under everything that its answer depends on: its settings, its meshes, the words and
/// the program.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "output/cache/result_cache.h"
#include "run/settings/report_settings.h"
#include "run/stored_report.h"

namespace meshfolio::run {

/// Returns the largest size of the cache [bytes]: MESHFOLIO_CACHE_LIMIT of the environment, in megabytes of 10⁶ bytes, else 2048 of them.
/// @throws UsageError unless that is a number from 1 to 1000000
std::uintmax_t cache_limit();

/// Opens the cache in its default folder. Returns null, with a warning, if it cannot be used.
std::unique_ptr<output::ResultCache> usable_cache();

/// Opens the cache for a report. Returns null if it cannot be used, if the program has no identity, or for a run with MESHFOLIO_FAIL.
std::unique_ptr<output::ResultCache> cache_for_report();

/// Returns every mesh that the chapter may read: the user's own meshes if there are any, else the meshes of its [[question]] table, else of
/// its roles. Without own meshes, a chapter about earlier reports also reads the meshes of these reports.
std::vector<MeshLookup> meshes_read_by(const Chapter& chapter, const ReportSettings& settings);

class SectionCache {
public:
    /// Looks for sections with these settings and meshes in `store`. All parameters must outlive the object.
    SectionCache(output::ResultCache& store, const ReportSettings& settings, const MeshLibrary& meshes)
        : store_(store), settings_(settings), meshes_(meshes) {}

    /// Returns the stored section of a chapter and puts its files into `folder`; returns nothing, and leaves no file, if any part of it is
    /// missing or damaged.
    std::optional<ReportSection> find(const Chapter& chapter, const std::filesystem::path& folder) const;

    /// Stores an answered section, unless it failed or lacks a mesh, whose cause may be temporary, or has file names that JSON cannot hold.
    /// @param figures  of the report, or more than its own
    /// @param folder   of the report, which has the section's files
    /// @return digests of these files, by path
    /// @throws OutputError, InputError
    output::Digests keep(const report::Section& section, const report::DrawnFigures& figures, const std::filesystem::path& folder) const;

private:
    output::ResultCache& store_;
    const ReportSettings& settings_;
    const MeshLibrary& meshes_;

    std::string key_of(const Chapter& chapter) const;
};

}   // namespace meshfolio::run
