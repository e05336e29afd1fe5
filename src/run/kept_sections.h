/// @file
/// The sections that `report --only q2` keeps from the report that it renews.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "questions/core/mesh_library.h"
#include "run/question_cache.h"
#include "run/settings/report_settings.h"

namespace meshfolio::run {

struct KeptSections {
    std::map<std::string, StoredAnswer> answers;   // by section
    std::string note;                              // why there are none, where an earlier report has some; else empty
    std::map<std::string, std::string> settings;   // of that report

    /// Replaces the planned efforts of these sections by those of the earlier report.
    void tell_efforts(std::map<std::string, std::string>& described) const;
};

/// The sections of the report at settings.out that are not asked for, if it was made of the same inputs, with the same settings and by the
/// same program; their files are put into `folder`.
/// @throws InputError for a file of that report which is missing or not what it was
KeptSections kept_sections(const ReportSettings& settings, const MeshLibrary& meshes, const std::filesystem::path& folder);

}   // namespace meshfolio::run
