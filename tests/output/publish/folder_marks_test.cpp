#include "output/publish/folder_marks.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "temporary_folder.h"

using namespace meshfolio;
using namespace meshfolio::output;
using testing_tools::TemporaryFolder;
namespace fs = std::filesystem;

TEST(FolderMarks, AreRegularFilesWithOurContents) {
    const TemporaryFolder place;
    const fs::path folder = place.path() / "out", mark = folder / marker_file;
    const auto refused = [&](const char* how) {
        EXPECT_FALSE(has_mark(folder, report_folder)) << how;
        EXPECT_FALSE(is_marked(folder)) << how;
        EXPECT_THROW(require_ours(folder, report_folder), OutputError) << how;
        fs::remove_all(mark);
    };
    fs::create_directory(folder);
    fs::create_directory(mark);
    refused("a folder of that name");
    write_file(place.path() / "ours", report_folder.contents);
    fs::create_symlink(place.path() / "ours", mark);
    refused("a link to a mark");
    const std::vector<std::string> foreign{"", "x", batch_folder.contents, replaced_as_a_whole + std::string("x")};
    for (const std::string& text : foreign) {
        write_file(mark, text);
        refused(text.c_str());
    }
    ASSERT_EQ(::mkfifo(mark.c_str(), 0600), 0);
    refused("a pipe");
    write_file(mark, "This folder was made by meshfolio, which replaces it as a whole.\n");   // as earlier versions wrote it
    EXPECT_TRUE(has_mark(folder, report_folder));
    EXPECT_NO_THROW(require_ours(folder, report_folder));
    for (const FolderKind& other : {marks_folder, batch_folder}) EXPECT_THROW(require_ours(folder, other), OutputError) << other.words;
}

TEST(FolderMarks, LeftoversOfAKilledRunDoNotCountAsFiles) {
    const TemporaryFolder place;
    write_file(place.path() / ".meshfolio.part-999999999-0", "half an index\n");
    EXPECT_NO_THROW(require_ours(place.path(), batch_folder));
    write_file(place.path() / "notes.part", "mine\n");
    EXPECT_THROW(require_ours(place.path(), batch_folder), OutputError);
}

TEST(FolderMarks, AHomeFolderIsNeverReplaced) {
    const TemporaryFolder home;
    const std::string before = std::getenv("HOME") == nullptr ? "" : std::getenv("HOME");
    ::setenv("HOME", home.path().c_str(), 1);
    EXPECT_THROW(require_ours(home.path(), report_folder), OutputError) << "empty";
    write_file(home.path() / marker_file, report_folder.contents);
    EXPECT_THROW(require_ours(home.path(), report_folder), OutputError) << "marked";
    ::setenv("HOME", before.c_str(), 1);
    EXPECT_NO_THROW(require_ours(home.path(), report_folder));
}

TEST(FolderMarks, AForeignFolderUnderVersionControlIsRefused) {
    const TemporaryFolder place;
    const fs::path folder = place.path() / "out";
    fs::create_directories(folder / ".git");
    EXPECT_THROW(require_ours(folder, report_folder), OutputError);
    fs::remove_all(folder / ".git");
    write_file(folder / ".git", "gitdir: ../elsewhere\n");
    EXPECT_THROW(require_ours(folder, report_folder), OutputError);
    fs::remove(folder / ".git");
    write_file(folder / ".gitignore", "*\n");
    EXPECT_NO_THROW(require_ours(folder, report_folder));
}
