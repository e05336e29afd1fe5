#include "submission/source_listing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>
#include <sstream>

#include "base/file_bytes.h"
#include "source_dir.h"

namespace meshfolio::submission {
namespace {

const std::vector<SourceFile> tree = {
    {"src/questions/q1_areas.cpp", "#include \"a.h\"\n\ndouble answer() {\n    return area(1);\n}\n"},
    {"src/questions/tools.cpp", "int tools() {\n}\n"},
    {"src/geometry/area.cpp", "double area(double);\n\n\ndouble area(double r) { return r; }"},
    {"src/geometry/area.h", "double area(double);\n"},
    {"src/geometry/volume.cpp", ""},
    {"render/ray.cpp", "struct Ray {\n};\n"},
    {"README.md", "words for people\n"},
    {"data/cube.obj", "v 0 0 0\n"},
    {"templates/report.md", "{{title}}\n"},
    {"run-tests", "#!/bin/sh\n"},
    {"tests/empty_test.cpp", ""},
};
const std::vector<CitingSection> index = {
    {"Q1", "Areas", {{"area", "src/geometry/area.cpp", "π r²"}, {"gone", "src/geometry/area.cpp", ""}}}};

/// Checks the numbers of the lines and returns the lines without them.
std::vector<std::string> plain_lines(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) {
        EXPECT_EQ(std::stoul(line.substr(0, 6)), lines.size() + 1);
        EXPECT_TRUE(line.size() == 6 || line.substr(6, 2) == "  ") << line;
        EXPECT_FALSE(line.ends_with(' ')) << line;
        lines.push_back(line.size() == 6 ? "" : line.substr(8));
    }
    return lines;
}

/// Returns path → the text below the banner of each file, as many lines as the banner says.
std::map<std::string, std::string> texts_below_banners(const std::vector<std::string>& lines) {
    std::map<std::string, std::string> texts;
    for (std::size_t i = 1; i + 1 < lines.size(); ++i) {
        const std::size_t end = lines[i].find("   (L");
        if (end == std::string::npos || lines[i - 1] != std::string(100, '=') || lines[i + 1] != lines[i - 1]) continue;
        std::size_t first = 0, last = 0;
        EXPECT_EQ(std::sscanf(lines[i].c_str() + end, "   (L%zu to L%zu)", &first, &last), 2) << lines[i];
        EXPECT_EQ(first, i + 3) << lines[i];
        std::string& text = texts[lines[i].substr(0, end)];
        for (std::size_t line = first; line <= last; ++line) text += lines[line - 1] + "\n";
    }
    return texts;
}

}   // namespace

TEST(SourceListing, HoldsEveryFileUnchanged) {
    const auto lines = plain_lines(SourceListing("own", tree, index).text());
    auto texts = texts_below_banners(lines);
    for (const SourceFile& file : tree) {
        if (!SourceListing::is_source(file.path)) continue;
        const std::string text(file.bytes);
        EXPECT_EQ(texts[file.path], text + (text.empty() || text.ends_with('\n') ? "" : "\n")) << file.path;
    }
    EXPECT_EQ(lines.front(), "own");
}

TEST(SourceListing, HoldsThisProjectUnchanged) {
    const std::vector<SourceFile> own = source_tree();
    auto texts = texts_below_banners(plain_lines(SourceListing("own", own, {}).text()));
    std::size_t listed = 0;
    for (const SourceFile& file : own) {
        EXPECT_EQ(file.bytes, read_file(std::filesystem::path(MESHFOLIO_SOURCE_DIR) / file.path)) << file.path;
        if (!SourceListing::is_source(file.path)) continue;
        ++listed;
        EXPECT_EQ(texts[file.path], file.bytes) << file.path;
    }
    EXPECT_GT(listed, 300u);
}

TEST(SourceListing, FindsDefinitionsByTheirLines) {
    const SourceListing listing("own", tree, index);
    const auto lines = plain_lines(listing.text());
    const int line = listing.line_of("area", "src/geometry/area.cpp");
    ASSERT_GT(line, 0);
    EXPECT_EQ(lines[static_cast<std::size_t>(line) - 1], "double area(double r) { return r; }");
    EXPECT_EQ(listing.line_of("area", "src/geometry/area.h"), 0) << "declared only";
    EXPECT_EQ(listing.line_of("area", "src/questions/q1_areas.cpp"), 0) << "called only";
    EXPECT_EQ(listing.line_of("area", "src/geometry/volume.cpp"), 0) << "no such file";
    EXPECT_EQ(listing.index().front().code.front().line, line);
    const auto named = std::find_if(lines.begin(), lines.end(), [](const std::string& l) { return l.find("  area ") != l.npos; });
    EXPECT_TRUE(named->starts_with("  L" + std::to_string(line) + " ")) << *named;
}

TEST(SourceListing, AnsweringFilesComeFirstAndHeadersBeforeTheirImplementation) {
    const std::string text = SourceListing("own", tree, index).text();
    std::size_t at = 0;
    for (const char* path : {"src/geometry/area.h   (", "src/geometry/area.cpp   (", "src/questions/q1_areas.cpp   (",
                             "src/geometry/volume.cpp   (", "src/questions/tools.cpp   (", "render/ray.cpp   ("}) {
        const std::size_t found = text.find(path);
        ASSERT_NE(found, text.npos) << path;
        EXPECT_GT(found, at) << path;
        at = found;
    }
    EXPECT_EQ(text.find("words for people"), text.npos);
    EXPECT_EQ(text.find("v 0 0 0"), text.npos);
    for (const char* path : {"templates/report.md   (", "tests/empty_test.cpp   (", "run-tests   ("}) EXPECT_EQ(text.find(path), text.npos);
}

TEST(SourceListing, TheOrderOfTheFilesDoesNotMatter) {
    std::vector<SourceFile> reversed(tree.rbegin(), tree.rend());
    EXPECT_EQ(SourceListing("own", tree, index).text(), SourceListing("own", reversed, index).text());
}

// The modules nearest to the questions come first; a module is taken as a whole or not at all.
TEST(ReadingOrder, AnsweringFilesAreIncludedOrCitedWithinTheLimit) {
    const std::vector<SourceFile> files{
        {"src/questions/q1_areas/chapter.cpp", "#include \"geometry/area.h\"\n#include \"report/document.h\"\n"},
        {"src/geometry/area.h", "\n"},
        {"src/geometry/area.cpp", "#include \"geometry/area.h\"\n#include \"geometry/far.h\"\n"},
        {"src/geometry/far.h", "#include \"mesh/io/reader.h\"\n"},
        {"src/geometry/cited.cpp", "\n"},
        {"src/geometry/unused.cpp", "\n"},
        {"src/mesh/io/reader.h", "\n"},
        {"src/report/document.h", "\n"}};
    const std::vector<std::string> cited{"src/geometry/cited.cpp", "src/geometry/gone.cpp"};
    const std::set<std::string> near{"src/questions/q1_areas/chapter.cpp", "src/geometry/area.h", "src/geometry/area.cpp",
                                     "src/geometry/cited.cpp"};
    std::set<std::string> all = near;
    all.insert("src/geometry/far.h");
    EXPECT_EQ(answering_files(files, cited, 1000, 0), all);
    EXPECT_EQ(answering_files(files, cited, 7, 0), all);
    EXPECT_EQ(answering_files(files, cited, 6, 0), near);
    EXPECT_EQ(answering_files(files, cited, 2, 0), (std::set<std::string>{"src/questions/q1_areas/chapter.cpp"}));
    EXPECT_EQ(answering_files(files, cited, 3, 1), (std::set<std::string>{"src/questions/q1_areas/chapter.cpp"}));
}

TEST(SourceTree, HoldsEachFileOnceAndTheMeshesToo) {
    std::set<std::string> paths;
    for (const SourceFile& file : source_tree()) EXPECT_TRUE(paths.insert(file.path).second) << file.path;
    for (const char* path :
         {"CMakeLists.txt", "build-report", "LICENSE", "data/cube.obj", "data/report.toml", "data/reports/laboratory.toml",
          "render/scene/image.cpp", "src/main.cpp", "templates/report.html", "tests/setup.sh", "src/submission/NOTICES.md"})
        EXPECT_TRUE(paths.contains(path)) << path;
    for (const std::string& path : paths) EXPECT_FALSE(path.starts_with("build/") || path.starts_with("/")) << path;
}

TEST(SourceTree, BuildPackagesAreReadFromTheSetupScript) {
    EXPECT_EQ(build_packages("x=1\nbuild_packages=\"cmake g++\n    ninja\"\ny=\"z\""), (std::vector<std::string>{"cmake", "g++", "ninja"}));
    EXPECT_THROW((void)build_packages("packages=\"cmake\""), std::logic_error);
}

TEST(Citations, GetALineOrAWarning) {
    const SourceListing listing("own", tree, {});
    report::Document document;
    document.sections.resize(2);
    document.sections[0].id = "q1";
    document.sections[0].code = index.front().code;
    const std::vector<std::string> missing = cite(document, listing);
    EXPECT_EQ(document.sections[0].code[0].line, listing.line_of("area", "src/geometry/area.cpp"));
    EXPECT_EQ(document.sections[0].code[1].line, 0);
    ASSERT_EQ(missing.size(), 1u);
    EXPECT_EQ(missing[0], "q1 cites gone of src/geometry/area.cpp, which src.txt does not define");
    ASSERT_EQ(document.sections[0].warnings.size(), 1u);
    EXPECT_TRUE(document.sections[1].warnings.empty());
}

}   // namespace meshfolio::submission
