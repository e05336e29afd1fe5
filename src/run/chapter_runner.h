/// @file
/// Answers chapters. The failure of one does not affect the others.
#pragma once

#include <atomic>
#include <string_view>

#include "questions/core/chapter.h"
#include "run/progress.h"
#include "run/settings/report_settings.h"

namespace meshfolio::run {

/// Returns the section of a chapter that is not answered: skipped, without citations, with `why` as its extent.
report::Section skipped_section(std::string_view id, const std::string& why);

class ChapterRunner {
public:
    /// Answers chapters on these meshes by these settings; both must outlive the object.
    ChapterRunner(const MeshLibrary& meshes, const ReportSettings& settings) : meshes_(meshes), settings_(settings) {}

    /// Answers a chapter; thread-safe. One that throws has a failed section with its message; after a failure under --fail-fast, the others
    /// have skipped sections. Output meshes are placed where the settings say. MESHFOLIO_FAIL=q4,q6 in the environment makes these chapters
    /// fail.
    Answer answer(const Chapter& chapter, ProgressDisplay& display);

private:
    const MeshLibrary& meshes_;
    const ReportSettings& settings_;
    std::atomic<bool> stop_ = false;

    Answer attempted(const Chapter& chapter, const MeshLibrary& meshes, ProgressDisplay& display);
    Answer answered_on_its_threads(const Chapter& chapter, const MeshLibrary& meshes, const Progress& progress) const;
};

}   // namespace meshfolio::run
