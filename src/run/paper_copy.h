/// @file
/// report.pdf and appendix.pdf among the other files of a report: each taken from the cache where an earlier run printed the same, else
/// printed.
#pragma once

#include <filesystem>
#include <future>
#include <optional>
#include <string>
#include <utility>

#include "output/cache/result_cache.h"
#include "report/pdf/pdf_engine.h"
#include "report/writers.h"
#include "run/settings/report_settings.h"

namespace meshfolio::run {

/// A paper that is being printed. Destroyed before the end, as by a failure elsewhere, it does not wait for the browser.
class Printing {
public:
    explicit Printing(std::future<std::string> end) : end_(std::move(end)) {}
    Printing(Printing&&) = default;
    ~Printing();

    /// Waits for the end. @return what to warn of, else empty
    /// @throws EngineError if the engine does not deliver what is required; OutputError
    std::string warning() { return end_.get(); }

private:
    std::future<std::string> end_;
};

class PaperCopy {
public:
    /// @throws EngineError when the flags require an engine and none is there
    PaperCopy(const ReportSettings& settings, const report::Templates& templates);

    bool is_wanted() const { return engine_.has_value(); }

    /// Begins to print the PDF of a volume into `folder`, beside whatever else is computed. The templates and `store` must outlive it.
    /// @param figures  those of the volume, or more; of the report all, for results.json is attached to it
    Printing begin(report::Volume volume, report::Document document, report::DrawnFigures figures, output::ResultCache* store,
                   std::filesystem::path folder) const;

private:
    const report::Templates& templates_;
    bool required_;
    std::optional<report::PdfEngine> engine_;

    std::string pdf_of(report::Volume volume, const report::Document& document, const report::DrawnFigures& figures,
                       output::ResultCache* store, const std::filesystem::path& folder) const;
};

}   // namespace meshfolio::run
