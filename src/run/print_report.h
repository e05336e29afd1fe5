/// @file
/// report.pdf: the engine, and the printing.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "report/pdf/pdf_engine.h"
#include "report/writers.h"
#include "run/settings/report_settings.h"

namespace meshfolio::run {

/// The engine that --pdf asks for; with `auto`, when there is none, says so in a warning.
/// @throws EngineError when one is required and none is there
std::optional<report::PdfEngine> wanted_engine(const ReportSettings& settings);

/// The bytes of report.pdf. Nothing in them depends on the time or the place.
/// @throws EngineError if the engine does not deliver
std::string printed_report(const report::Document& document, const report::DrawnFigures& figures, const report::Templates& templates,
                           report::Extent extent, const report::PdfEngine& engine);

}   // namespace meshfolio::run
