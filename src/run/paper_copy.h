/// @file
/// report.pdf and appendix.pdf among the other files of a report: each taken from the cache where an earlier run printed the same, else
/// printed.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "output/cache/result_cache.h"
#include "report/pdf/pdf_engine.h"
#include "report/writers.h"
#include "run/settings/report_settings.h"

namespace meshfolio::run {

class PaperCopy {
public:
    /// @throws EngineError when the flags require an engine and none is there
    PaperCopy(const ReportSettings& settings, const report::Templates& templates);

    bool is_wanted() const { return engine_.has_value(); }

    /// Looks into the cache whether an earlier run printed the same from the sheets in `folder`.
    void look_up(const report::Document& document, const report::DrawnFigures& figures, output::ResultCache* store,
                 const std::filesystem::path& folder);
    /// Writes the PDF of both volumes into `folder`, and what was printed into the cache.
    /// @return what to warn of, else empty
    /// @throws EngineError if the engine does not deliver what is required; OutputError
    std::string write(const report::Document& document, const report::DrawnFigures& figures, output::ResultCache* store,
                      const std::filesystem::path& folder) const;

private:
    struct Copy {
        report::Volume volume;
        std::string key = {};                     // in the cache; empty: not asked
        std::optional<std::string> stored = {};   // bytes that the cache had
    };

    const report::Templates& templates_;
    bool required_;
    std::optional<report::PdfEngine> engine_;
    std::array<Copy, 2> copies_{{{report::Volume::report}, {report::Volume::appendix}}};

    std::string key_of(report::Volume volume, const report::Document& document, const report::DrawnFigures& figures,
                       const std::filesystem::path& folder) const;
    std::string pdf_of(const Copy& copy, const report::Document& document, const report::DrawnFigures& figures,
                       output::ResultCache* store) const;
};

}   // namespace meshfolio::run
