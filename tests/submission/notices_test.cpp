// NOTICES.md names the packages that the build installs and the libraries that CMake links.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <regex>
#include <set>
#include <string>

#include "base/file_bytes.h"
#include "source_dir.h"
#include "submission/source_listing.h"

namespace meshfolio::submission {
namespace {

const std::string source = MESHFOLIO_SOURCE_DIR;

const std::string& notices() {
    static const std::string text = read_file(source + "/src/submission/NOTICES.md");
    return text;
}

/// True if a row of the tables names the package and a licence.
bool has_row(const std::string& package) {
    const std::size_t at = notices().find("`" + package + "`");
    if (at == std::string::npos) return false;
    const std::size_t begin = notices().rfind('\n', at) + 1;
    const std::string row = notices().substr(begin, notices().find('\n', at) - begin);
    return row.starts_with("| ") && std::count(row.begin(), row.end(), '|') >= 4;
}

}   // namespace

TEST(Notices, NameEveryPackageThatTheBuildNeeds) {
    const auto packages = build_packages(read_file(source + "/tests/setup.sh"));
    EXPECT_GT(packages.size(), 15u);
    for (const std::string& package : packages) EXPECT_TRUE(has_row(package)) << package << " has no row in src/submission/NOTICES.md";
    EXPECT_FALSE(has_row("libnothing-dev"));
}

// Every library that CMakeLists.txt looks for, and every font, belongs to a package that the notices name.
TEST(Notices, NameEveryLibraryAndFontOfTheBuild) {
    const std::map<std::string, std::string> packages{{"Eigen3", "libeigen3-dev"},
                                                      {"spectra", "libspectra-dev"},
                                                      {"tinyobjloader", "libtinyobjloader-dev"},
                                                      {"glm", "libglm-dev"},
                                                      {"CLI11", "libcli11-dev"},
                                                      {"nlohmann_json", "nlohmann-json3-dev"},
                                                      {"pugixml", "libpugixml-dev"},
                                                      {"TBB", "libtbb-dev"},
                                                      {"HWY", "libhwy-dev"},
                                                      {"libdeflate", "libdeflate-dev"},
                                                      {"nettle", "nettle-dev"},
                                                      {"libarchive", "libarchive-dev"},
                                                      {"qpdf", "libqpdf-dev"},
                                                      {"stb_image_write.h", "libstb-dev"},
                                                      {"mustache.hpp", "libkainjow-mustache-dev"},
                                                      {"toml++/toml.h", "libtomlplusplus-dev"},
                                                      {"texgyrepagella-regular.otf", "fonts-texgyre"},
                                                      {"texgyrepagella-italic.otf", "fonts-texgyre"},
                                                      {"texgyrepagella-bold.otf", "fonts-texgyre"},
                                                      {"texgyrepagella-math.otf", "fonts-texgyre-math"},
                                                      {"Inter-Regular.otf", "fonts-inter"},
                                                      {"Inter-Italic.otf", "fonts-inter"},
                                                      {"Inter-SemiBold.otf", "fonts-inter"},
                                                      {"DejaVuSansMono.ttf", "fonts-dejavu-core"}};
    const std::set<std::string> not_linked{"PkgConfig", "Threads", "Git"};
    const std::string cmake = read_file(source + "/CMakeLists.txt") + read_file(source + "/templates/fonts/fonts.cmake");
    const std::regex asked(
        "(?:find_package\\(|pkg_check_modules\\(\\w+ REQUIRED IMPORTED_TARGET |find_path\\(\\w+ |find_library\\(\\w+ |make_font\\([\\w-]+ "
        ")([^ )]+)");
    std::size_t count = 0;
    for (std::sregex_iterator it(cmake.begin(), cmake.end(), asked), end; it != end; ++it) {
        const std::string name = (*it)[1];
        if (not_linked.contains(name)) continue;
        ++count;
        ASSERT_TRUE(packages.contains(name)) << name << ": say here of which package it is, and in NOTICES.md under which licence";
        EXPECT_TRUE(has_row(packages.at(name))) << name;
    }
    EXPECT_GT(count, 15u);
}

TEST(Notices, AreNamedInTheReadme) { EXPECT_NE(read_file(source + "/README.md").find("src/submission/NOTICES.md"), std::string::npos); }

}   // namespace meshfolio::submission
