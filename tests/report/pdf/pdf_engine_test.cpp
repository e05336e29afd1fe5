#include "report/pdf/pdf_engine.h"

#include <gtest/gtest.h>

#include "report/test_tools.h"

namespace meshfolio::report {
namespace {

namespace fs = std::filesystem;

/// A folder of programs that say a version and do nothing.
class PdfEngines : public testing::Test {
protected:
    TemporaryFolder folder_;
    EngineSearch search_{"", {{"PATH", (folder_.path() / "bin").string()}, {"HOME", (folder_.path() / "home").string()}}};

    fs::path program(const std::string& name, const std::string& says, int code = 0) {
        const fs::path path = folder_.path() / name;
        fs::create_directories(path.parent_path());
        folder_.write(name, "#!/bin/sh\necho '" + says + "'\nexit " + std::to_string(code) + "\n");
        fs::permissions(path, fs::perms::owner_all);
        return path;
    }
    fs::path found() const {
        const EngineFinding finding = find_pdf_engine(search_);
        return finding.engine ? finding.engine->program : fs::path();
    }
};

TEST_F(PdfEngines, MayBeMissing) {
    const EngineFinding finding = find_pdf_engine(search_);
    EXPECT_FALSE(finding.engine);
    EXPECT_TRUE(finding.refused.empty());
}

TEST_F(PdfEngines, HaveAnOrderOfPreference) {
    const auto expect_found = [&](const fs::path& newest) { EXPECT_EQ(newest, found()); };
    // In ascending order of preference: each new one is found instead of the one before.
    expect_found(program("bin/weasyprint", "WeasyPrint version 57.2"));
    EXPECT_EQ(find_pdf_engine(search_).engine->kind, PdfEngine::Kind::weasyprint);
    expect_found(program("home/.cache/ms-playwright/chromium-1100/chrome-linux/chrome", "Chromium 140.0.1"));
    expect_found(program("home/.cache/ms-playwright/chromium_headless_shell-1200/chrome-linux/headless_shell", "Chromium 141.0.1"));
    for (const char* name : {"microsoft-edge", "google-chrome", "google-chrome-stable", "chromium-browser", "chromium",
                             "chrome-headless-shell", "chromium-headless-shell"}) {
        expect_found(program(std::string("bin/") + name, "Google Chrome 150.0.1"));
    }
    for (const char* variable : {"PUPPETEER_EXECUTABLE_PATH", "CHROME_PATH", "MESHFOLIO_CHROME"}) {
        search_.environment[variable] = program(std::string("elsewhere/") + variable, "Chromium 131.0.6778.0").string();
        EXPECT_EQ(search_.environment[variable], found());
    }
    search_.browser = program("mine/browser", "Chromium 156.0.8078.79 built on Debian").string();
    EXPECT_EQ(search_.browser, found());
    EXPECT_EQ(find_pdf_engine(search_).engine->version, "Chromium 156.0.8078.79");
}

TEST_F(PdfEngines, DoNotReplaceTheOneAskedFor) {
    program("bin/chromium", "Chromium 150.0");
    search_.browser = "/nonexistent/browser";
    const EngineFinding finding = find_pdf_engine(search_);
    EXPECT_FALSE(finding.engine);
    ASSERT_EQ(finding.refused.size(), 1u);
    EXPECT_NE(finding.refused[0].find("--pdf-browser"), std::string::npos);
}

TEST_F(PdfEngines, UnusableEnginesAreSkippedAndReported) {
    program("bin/chromium-headless-shell", "Chromium 130.0.1");   // no page numbers
    program("bin/chrome-headless-shell", "Chromium 150.0", 3);    // does not start
    program("bin/chromium", "exec /snap/bin/chromium");           // in a snap
    program("bin/chromium-browser", "nothing");
    const fs::path last = program("bin/google-chrome", "Google Chrome 133.0.1");
    folder_.write("bin/google-chrome-stable", "not executable");
    const EngineFinding finding = find_pdf_engine(search_);
    ASSERT_TRUE(finding.engine);
    EXPECT_EQ(finding.engine->program, last);
    ASSERT_EQ(finding.refused.size(), 4u);
    const char* reasons[] = {"older than version 131", "exit code 3", "snap", "does not say"};
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NE(finding.refused[i].find(reasons[i]), std::string::npos) << finding.refused[i];
}

TEST_F(PdfEngines, IgnoreRelativeFoldersOfThePath) {
    program("bin/chromium", "Chromium 150.0");
    const fs::path before = fs::current_path();
    fs::current_path(folder_.path());
    search_.environment["PATH"] = "bin:";
    EXPECT_EQ(found(), fs::path());
    fs::current_path(before);
}

}   // namespace
}   // namespace meshfolio::report
