/// @file
/// report.pdf and appendix.pdf, printed while other files are made; or taken from the cache, where an earlier run printed the same.
#pragma once

#include <filesystem>
#include <future>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "output/cache/result_cache.h"
#include "report/pdf/pdf_engine.h"
#include "report/writers.h"
#include "run/settings/report_settings.h"

namespace meshfolio::run {

class Paper {
public:
    /// Finds the engine that the settings want. @param store  the cache, or null. All parameters must outlive the object.
    /// @throws EngineError if the settings require an engine and none is there
    Paper(const ReportSettings& settings, const report::Templates& templates, output::ResultCache* store);
    /// Ends the browsers that still print, without waiting for them: after an error elsewhere.
    ~Paper();
    Paper(const Paper&) = delete;
    Paper& operator=(const Paper&) = delete;

    bool is_wanted() const { return engine_.has_value(); }

    /// Begins to print the PDF of a volume into `folder`, in a thread of its own; does nothing unless is_wanted().
    /// @param figures  of both volumes: results.json is attached to the report
    void begin(report::Volume volume, report::Document document, report::DrawnFigures figures, std::filesystem::path folder);

    /// Waits for all volumes. @return a text for each: why there is no PDF, or empty
    /// @throws EngineError if the engine does not deliver and is required; OutputError
    std::vector<std::string> finish();

private:
    const report::Templates& templates_;
    output::ResultCache* store_;
    bool required_;
    std::optional<report::PdfEngine> engine_;
    std::map<report::Volume, std::future<std::string>> printing_;   // warnings

    std::string pdf_of(report::Volume volume, const report::Document& document, const report::DrawnFigures& figures,
                       const std::filesystem::path& folder) const;
};

}   // namespace meshfolio::run
