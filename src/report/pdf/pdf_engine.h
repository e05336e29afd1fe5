/// @file
/// Finds the program that turns a page into a PDF.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace meshfolio::report {

struct PdfEngine {
    enum class Kind { chromium, weasyprint } kind = Kind::chromium;
    std::filesystem::path program;
    std::string version;   // name and version by its own account: "Chromium 156.0.8078.79"
};

/// The places of a search for engines.
struct EngineSearch {
    std::string browser;                              // name or path of the only one to take; empty: any
    std::map<std::string, std::string> environment;   // MESHFOLIO_CHROME, CHROME_PATH, PUPPETEER_EXECUTABLE_PATH, PATH, HOME
};

/// Returns a search in the environment of this process.
EngineSearch engine_search(const std::string& browser = "");

struct EngineFinding {
    std::optional<PdfEngine> engine;
    std::vector<std::string> refused;   // unusable engines, each with the reason
};

/// Returns the engine `browser` if it is named; else the first usable one of the environment, the PATH, Playwright and weasyprint. A
/// browser is refused below version 131 (page numbers), or inside a snap, which cannot read the page.
EngineFinding find_pdf_engine(const EngineSearch& search);

}   // namespace meshfolio::report
