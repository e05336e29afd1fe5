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
    std::string version;   // as it says itself: "Chromium 156.0.8078.79"
};

/// Where to look.
struct EngineSearch {
    std::string browser;                              // asked for by name or path: that one or none
    std::map<std::string, std::string> environment;   // MESHFOLIO_CHROME, CHROME_PATH, PUPPETEER_EXECUTABLE_PATH, PATH, HOME
};

/// With the environment of this process.
EngineSearch engine_search(const std::string& browser = "");

struct EngineFinding {
    std::optional<PdfEngine> engine;
    std::vector<std::string> refused;   // what was found and cannot serve, each with the reason
};

/// The first that serves: the one asked for; else those of the environment, those on the PATH (browsers before weasyprint), those of
/// Playwright. A browser serves from version 131 on (page numbers); one inside a snap cannot read our files.
EngineFinding find_pdf_engine(const EngineSearch& search);

}   // namespace meshfolio::report
