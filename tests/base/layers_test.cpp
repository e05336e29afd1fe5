// Includes point downwards only. This table lists the allowed ones; a change to it needs a reason.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "base/file_bytes.h"
#include "layer_sources.h"
#include "source_dir.h"

using namespace meshfolio;
namespace fs = std::filesystem;

namespace {

const fs::path source = MESHFOLIO_SOURCE_DIR;

/// Layer → what of ours it may include besides itself.
const std::map<std::string, std::set<std::string>> allowed{
    {"base", {}},
    {"mesh", {"base"}},
    {"geometry", {"base", "mesh"}},
    {"report", {"base"}},
    {"output", {"base", "report", "mesh", "render"}},
    {"submission", {"base", "output", "report", "mesh"}},   // the endings of meshes that are handed in
    {"questions", {"base", "output", "report", "geometry", "mesh"}},
    {"run", {"base", "submission", "questions", "output", "report", "geometry", "mesh", "render"}},
    {"python", {"base", "run", "output", "geometry", "mesh", "render"}},
    {"cli", {"base", "run", "submission", "questions", "output", "report", "geometry", "mesh", "render"}},
};

std::set<std::string> included_by(const fs::path& file) {
    const std::string text = read_file(file);
    static const std::regex include("#include \"([^\"]+)\"");
    std::set<std::string> headers;
    for (std::sregex_iterator it(text.begin(), text.end(), include), end; it != end; ++it) headers.insert((*it)[1]);
    return headers;
}

std::vector<fs::path> sources_below(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".h" || entry.path().extension() == ".cpp") files.push_back(entry.path());
    return files;
}

/// "questions/core/chapter.h" → {"questions", "core", "chapter.h"}.
std::vector<std::string> parts_of(const fs::path& path) { return {path.begin(), path.end()}; }

}   // namespace

TEST(Layers, EachIncludesOnlyWhatLiesBelow) {
    for (const auto& [layer, below] : allowed) {
        for (const fs::path& file : sources_below(source / "src" / layer)) {
            for (const std::string& header : included_by(file)) {
                const bool ours = fs::exists(source / "src" / header), of_renderer = !ours && fs::exists(source / "render" / header);
                const std::string owner = ours ? parts_of(header).front() : of_renderer ? "render" : layer;   // else generated
                EXPECT_TRUE(owner == layer || below.contains(owner))
                    << file << " includes " << header << ", which is not below it: see `allowed` in this test";
            }
        }
    }
}

TEST(Layers, EveryFolderOfTheSourceIsALayer) {
    for (const auto& entry : fs::directory_iterator(source / "src"))
        EXPECT_TRUE(!entry.is_directory() || allowed.contains(entry.path().filename().string()))
            << entry.path() << ": say in `allowed` what it may include, and make it a layer() of CMakeLists.txt";
}

TEST(Layers, ChaptersDoNotKnowEachOther) {
    for (const fs::path& file : sources_below(source / "src/questions")) {
        const std::string chapter = parts_of(file.lexically_relative(source / "src/questions")).front();
        for (const std::string& header : included_by(file)) {
            if (!header.starts_with("questions/")) continue;
            const std::string other = parts_of(header)[1];
            EXPECT_TRUE(other == chapter || other == "core" || (other == "bench" && chapter != "core"))
                << file << " includes " << header << ": what several chapters need is in questions/bench";
        }
    }
}

TEST(Layers, OnlySpectrumAndDistributedIncludeTheSpectralEngine) {
    const fs::path spectrum = source / "src/geometry/spectrum", other_way = source / "src/geometry/distributed";
    for (const fs::path& file : sources_below(source / "src")) {
        if (file.string().starts_with(spectrum.string()) || file.string().starts_with(other_way.string())) continue;
        for (const std::string& header : included_by(file))
            EXPECT_FALSE(header.starts_with("geometry/spectrum/engine/")) << file << " includes " << header;
    }
}

TEST(Layers, TheRendererKnowsNothingOfUs) {
    for (const fs::path& file : sources_below(source / "render"))
        for (const std::string& header : included_by(file))
            EXPECT_FALSE(fs::exists(source / "src" / header)) << file << " includes " << header;
}

TEST(Layers, EverySourceBelongsToOneTarget) {
    std::map<fs::path, int> targets;
    std::istringstream listed(MESHFOLIO_LAYER_SOURCES);
    for (std::string path; std::getline(listed, path, ';');) ++targets[path];
    for (const char* folder : {"src", "render"})
        for (const fs::path& file : sources_below(source / folder))
            if (file.extension() == ".cpp" && file != source / "src/main.cpp" && file != source / "src/python/module.cpp") {   // programs
                EXPECT_EQ(targets[file], 1) << file << " is in so many targets: layer() in CMakeLists.txt takes all of a folder";
            }
}

TEST(Layers, NoFolderHasMoreThanFortyFiles) {
    std::map<fs::path, int> files;
    for (const char* folder : {"src", "render"})
        for (const fs::path& file : sources_below(source / folder)) ++files[file.parent_path()];
    for (const auto& [folder, count] : files) EXPECT_LE(count, 40) << folder << ": make a subfolder";
}
