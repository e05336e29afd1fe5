#include "submission/report_folder.h"

#include <gtest/gtest.h>

#include "base/file_bytes.h"

namespace meshfolio::submission {

using namespace std::string_view_literals;

TEST(SuspiciousFile, ProgramsAreKnownByTheirFirstBytes) {
    EXPECT_EQ(program_kind(read_file("/proc/self/exe")), "an ELF program or library");
    for (const std::string_view bytes :
         {"\177ELF\2"sv, "MZ\x90"sv, "\xcf\xfa\xed\xfe\7"sv, "\xca\xfe\xba\xbe"sv, "\0asm\1"sv, "!<arch>\nx"sv, "#!/bin/sh"sv})
        EXPECT_NE(program_kind(bytes), "") << bytes;
    for (const std::string_view bytes :
         {""sv, "%PDF-1.7"sv, "\x89PNG\r\n"sv, "ply\n"sv, "<!DOCTYPE html>"sv, "# !"sv, " #!/bin/sh"sv, "glTF\2"sv, "M"sv})
        EXPECT_EQ(program_kind(bytes), "") << bytes;
}

TEST(SuspiciousFile, PathsOutsideOrInBuildFoldersAreRefused) {
    for (const char* path :
         {"report.pdf", "meshes/q4_lily_k5.ply", ".meshfolio", "source/.ci/run", "a/..b/c..", "building/x.txt", "tables/build.csv"})
        EXPECT_EQ(path_problem(path), "") << path;
    for (const char* path :
         {"", "/etc/passwd", "../x", "a/../b", "a/..", "./x", "a//b", "a\\b", "a\nb", "\xc3\xa9", "build/x.txt", "a/CMakeFiles/x",
          "node_modules/x.js", "CMakeCache.txt", "a/main.o", "libx.so", "x.exe", "__pycache__/x", ".git/config"})
        EXPECT_NE(path_problem(path), "") << path;
}

}   // namespace meshfolio::submission
