#include "report/pdf/pdf_engine.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <regex>
#include <set>
#include <utility>

#include "base/child_process.h"
#include "base/errors.h"
#include "base/number_text.h"

namespace meshfolio::report {

namespace fs = std::filesystem;

namespace {

constexpr long long oldest_browser = 131;   // the first with margin boxes of @page

constexpr const char* variables[] = {"MESHFOLIO_CHROME", "CHROME_PATH", "PUPPETEER_EXECUTABLE_PATH"};
constexpr const char* browsers[] = {"chromium-headless-shell", "chrome-headless-shell", "chromium",      "chromium-browser",
                                    "google-chrome-stable",    "google-chrome",         "microsoft-edge"};

std::string value_of(const EngineSearch& search, const std::string& variable) {
    const auto it = search.environment.find(variable);
    return it != search.environment.end() ? it->second : "";
}

bool is_program(const fs::path& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored) && ::access(path.c_str(), X_OK) == 0;
}

/// Returns the program of this path, or of this name in the folders of PATH; empty if there is none.
fs::path program_of(const std::string& name, const EngineSearch& search) {
    if (name.find('/') != std::string::npos) return is_program(name) ? fs::absolute(name) : fs::path();
    const std::string path = value_of(search, "PATH");
    for (std::size_t begin = 0; begin <= path.size();) {
        const std::size_t end = std::min(path.find(':', begin), path.size());
        const fs::path folder = path.substr(begin, end - begin);
        if (folder.is_absolute() && is_program(folder / name)) return folder / name;
        begin = end + 1;
    }
    return {};
}

/// Returns the browsers that Playwright downloaded with their numbers, newest first.
std::set<std::pair<long long, fs::path>, std::greater<>> playwright_browsers(const EngineSearch& search) {
    std::set<std::pair<long long, fs::path>, std::greater<>> found;
    const std::string home = value_of(search, "HOME");
    std::error_code error;
    if (home.empty()) return found;
    for (fs::directory_iterator it(fs::path(home) / ".cache/ms-playwright", error), end; !error && it != end; it.increment(error)) {
        const std::string name = it->path().filename().string();
        const std::size_t dash = name.rfind('-');
        if (!name.starts_with("chromium") || dash == std::string::npos) continue;
        for (const char* program : {"chrome-linux/headless_shell", "chrome-linux/chrome"}) {
            if (is_program(it->path() / program)) found.emplace(parse_integer(name.substr(dash + 1)).value_or(0), it->path() / program);
        }
    }
    return found;
}

/// True for a program in a snap, or a small script that calls one.
bool is_in_snap(const fs::path& program) {
    std::error_code error;
    const fs::path real = fs::canonical(program, error);
    if (real.string().starts_with("/snap/") || real.filename() == "snap") return true;
    if (fs::file_size(program, error) > 65536 || error) return false;
    std::ifstream file(program, std::ios::binary);
    const std::string script{std::istreambuf_iterator<char>(file), {}};
    return script.starts_with("#!") && script.find("/snap/bin/") != std::string::npos;
}

/// Returns the engine that a program is; else adds the reason to `refused`.
std::optional<PdfEngine> engine_of(const fs::path& program, std::vector<std::string>& refused) {
    const auto refuse = [&](const std::string& why) {
        refused.push_back(printable(program.string()) + " " + why);
        return std::nullopt;
    };
    if (is_in_snap(program)) return refuse("is in a snap, which cannot read the page");
    const ChildEnd end = run_child({program, {"--version"}, {{"LC_ALL", "C.UTF-8"}}, "/", std::chrono::seconds(20)});
    if (end.kind != ChildEnd::Kind::exited || end.code != 0) return refuse(words_of(end));
    std::smatch found;
    static const std::regex weasyprint("WeasyPrint version ([0-9.]+)"), browser("([A-Z][A-Za-z]*(?: [A-Z][A-Za-z]*)*) ([0-9]+)[0-9.]*");
    if (std::regex_search(end.output, found, weasyprint))
        return PdfEngine{PdfEngine::Kind::weasyprint, program, "WeasyPrint " + found.str(1)};
    if (!std::regex_search(end.output, found, browser)) return refuse("does not say which version it is");
    if (parse_integer(found.str(2)).value_or(0) < oldest_browser)
        return refuse("is older than version " + std::to_string(oldest_browser) + " (" + found.str(0) + ")");
    return PdfEngine{PdfEngine::Kind::chromium, program, found.str(0)};
}

}   // namespace

EngineSearch engine_search(const std::string& browser) {
    EngineSearch search{browser, {}};
    for (const char* name : {variables[0], variables[1], variables[2], "PATH", "HOME"}) {
        if (const char* value = std::getenv(name)) search.environment[name] = value;
    }
    return search;
}

EngineFinding find_pdf_engine(const EngineSearch& search) {
    EngineFinding finding;
    const auto serves = [&](const fs::path& program) {
        finding.engine = engine_of(program, finding.refused);
        return finding.engine.has_value();
    };
    const auto named_serves = [&](const std::string& name, const std::string& from) {
        const fs::path program = program_of(name, search);
        if (program.empty()) finding.refused.push_back(from + " names " + printable(name) + ", which is no program");
        return !program.empty() && serves(program);
    };
    if (!search.browser.empty()) {
        named_serves(search.browser, "--pdf-browser");
        return finding;
    }
    for (const char* variable : variables) {
        const std::string name = value_of(search, variable);
        if (!name.empty() && named_serves(name, variable)) return finding;
    }
    for (const char* name : browsers) {
        const fs::path program = program_of(name, search);
        if (!program.empty() && serves(program)) return finding;
    }
    for (const auto& [number, program] : playwright_browsers(search))
        if (serves(program)) return finding;
    const fs::path weasyprint = program_of("weasyprint", search);
    if (!weasyprint.empty()) serves(weasyprint);
    return finding;
}

}   // namespace meshfolio::report
