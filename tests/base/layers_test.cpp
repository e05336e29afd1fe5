// Includes point downwards only. The allowed ones are listed here; whoever needs another changes this table, and says why.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string>

#include "file_bytes.h"
#include "source_dir.h"

using namespace meshfolio;
namespace fs = std::filesystem;

namespace {

const fs::path source = MESHFOLIO_SOURCE_DIR;

/// Layer → what of ours it may include besides itself and the base (errors, file_bytes, number_text).
const std::map<std::string, std::set<std::string>> allowed{
    {"mesh", {}},
    {"geometry", {"mesh"}},
    {"report", {}},
    {"output", {"report", "mesh", "render"}},
    {"submission", {"output", "report"}},
    {"questions", {"output", "report", "geometry", "mesh"}},
    {"cli", {"submission", "questions", "output", "report", "geometry", "mesh", "render"}},
};

std::set<std::string> included_by(const fs::path& file) {
    const std::string text = read_file(file);
    static const std::regex include("#include \"([^\"]+)\"");
    std::set<std::string> headers;
    for (std::sregex_iterator it(text.begin(), text.end(), include), end; it != end; ++it) headers.insert((*it)[1]);
    return headers;
}

bool is_source(const fs::path& path) { return path.extension() == ".h" || path.extension() == ".cpp"; }

}   // namespace

TEST(Layers, EachIncludesOnlyWhatLiesBelow) {
    for (const auto& [layer, below] : allowed) {
        for (const auto& entry : fs::directory_iterator(source / "src" / layer)) {
            if (!is_source(entry.path())) continue;
            for (const std::string& header : included_by(entry.path())) {
                const std::size_t slash = header.find('/');
                if (slash == std::string::npos) {
                    // The base, the renderer's headers (on the path of those who may have them), or something generated.
                    const bool of_renderer = fs::exists(source / "render" / header) && !fs::exists(source / "src" / header);
                    EXPECT_TRUE(!of_renderer || below.contains("render")) << entry.path() << " includes " << header;
                    continue;
                }
                const std::string owner = header.substr(0, slash);
                EXPECT_TRUE(owner == layer || below.contains(owner)) << entry.path() << " includes " << header;
            }
        }
    }
}

TEST(Layers, TheRendererKnowsNothingOfUs) {
    for (const auto& entry : fs::directory_iterator(source / "render")) {
        if (!is_source(entry.path())) continue;
        for (const std::string& header : included_by(entry.path())) {
            EXPECT_FALSE(fs::exists(source / "src" / header)) << entry.path() << " includes " << header;
        }
    }
}
