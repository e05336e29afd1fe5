#include "output/publish/file_group.h"

#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <vector>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "temporary_folder.h"

using namespace meshfolio;
using namespace meshfolio::output;
using testing_tools::dead_process;
using testing_tools::entries_in;
using testing_tools::TemporaryFolder;
namespace fs = std::filesystem;

TEST(FileGroup, NoFileAppearsBeforeAllAreWritten) {
    const TemporaryFolder folder;
    replace_file(folder.path() / "a", "old");
    FileGroup files;
    files.add(folder.path() / "a", "new");
    files.add(folder.path() / "b", "new");
    EXPECT_EQ(read_file(folder.path() / "a"), "old");
    EXPECT_FALSE(fs::exists(folder.path() / "b"));
    files.publish();
    EXPECT_EQ(read_file(folder.path() / "a"), "new");
    EXPECT_EQ(read_file(folder.path() / "b"), "new");
}

TEST(FileGroup, NoFileIsWrittenTwice) {
    const TemporaryFolder folder;
    fs::create_directory(folder.path() / "b");
    replace_file(folder.path() / "a", "old");
    fs::create_symlink("a", folder.path() / "link");
    {
        FileGroup files;
        files.add(folder.path() / "a", "one");
        EXPECT_THROW(files.add(folder.path() / "b" / ".." / "a", "two"), UsageError);
        EXPECT_THROW(files.add(folder.path() / "link", "two"), UsageError);
        files.publish();
    }
    EXPECT_EQ(read_file(folder.path() / "a"), "one");
}

TEST(FileGroup, ProtectedInputsAreNotReplacedUnderAnyName) {
    const TemporaryFolder folder;
    const fs::path input = folder.path() / "mesh.obj";
    replace_file(input, "input");
    fs::create_symlink("mesh.obj", folder.path() / "link");
    FileGroup files;
    files.keep(folder.path() / "link");
    EXPECT_THROW(files.add(input, "output"), UsageError);
    EXPECT_THROW(files.add(folder.path() / "nowhere" / ".." / "link", "output"), UsageError);
    files.add(folder.path() / "other", "output");
    files.publish();
    EXPECT_EQ(read_file(input), "input");
    EXPECT_EQ(entries_in(folder.path()), 3);
}

TEST(ReplaceFile, KeepsThePermissionsOfTheOldFile) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "file";
    for (const fs::perms permissions : {fs::perms{0600}, fs::perms{0666}, fs::perms{0444}}) {   // the umask would take bits of the second
        replace_file(file, "old");
        fs::permissions(file, permissions);
        replace_file(file, "new");
        EXPECT_EQ(fs::status(file).permissions(), permissions);
        EXPECT_EQ(read_file(file), "new");
    }
}

TEST(FileGroup, LeavesNothingIfItIsNotPublished) {
    const TemporaryFolder folder;
    {
        FileGroup files;
        files.add(folder.path() / "a", "new");
    }
    EXPECT_EQ(entries_in(folder.path()), 0);
}

// The folder comes between writing and publishing; exchanging the two names would work, and then remove it.
TEST(FileGroup, RestoresAllFilesIfOneCannotBeRenamed) {
    const TemporaryFolder folder;
    replace_file(folder.path() / "a", "old");
    {
        FileGroup files;
        for (const char* name : {"a", "b", "c"}) files.add(folder.path() / name, "new");
        fs::create_directory(folder.path() / "c");
        replace_file(folder.path() / "c" / "precious", "kept");
        EXPECT_THROW(files.publish(), OutputError);
    }
    EXPECT_EQ(read_file(folder.path() / "a"), "old");
    EXPECT_FALSE(fs::exists(folder.path() / "b"));
    EXPECT_EQ(read_file(folder.path() / "c" / "precious"), "kept");
    EXPECT_EQ(entries_in(folder.path()), 2);
}

TEST(ReplaceFile, CreatesAndReplacesAndLeavesNothingElse) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "mesh.ply";
    replace_file(file, "one");
    replace_file(file, "two");
    EXPECT_EQ(read_file(file), "two");
    EXPECT_EQ(entries_in(folder.path()), 1);
}

TEST(ReplaceFile, WorksInSeveralThreadsInOneFolder) {
    const TemporaryFolder folder;
    {
        std::vector<std::jthread> threads;
        for (int t = 0; t < 4; ++t) {
            threads.emplace_back([&folder, t] {
                for (int i = 0; i < 20; ++i) replace_file(folder.path() / std::to_string(t), std::to_string(i));
            });
        }
    }
    for (int t = 0; t < 4; ++t) EXPECT_EQ(read_file(folder.path() / std::to_string(t)), "19");
    EXPECT_EQ(entries_in(folder.path()), 4);
}

TEST(ReplaceFile, SweepsPartsOfDeadRuns) {
    const TemporaryFolder folder;
    write_file(folder.path() / (".meshfolio.part-" + std::to_string(dead_process()) + "-0"), "half");
    replace_file(folder.path() / "x", "x");
    EXPECT_EQ(entries_in(folder.path()), 1);
}

TEST(ReplaceFile, NamesTheFileThatCannotBeWritten) {
    const TemporaryFolder folder;
    try {
        replace_file(folder.path() / "missing" / "mesh.ply", "x");
        FAIL();
    } catch (const OutputError& error) {
        EXPECT_NE(std::string(error.what()).find("mesh.ply"), std::string::npos) << error.what();
    }
    EXPECT_THROW(replace_file("/dev/full", "x"), OutputError);
    replace_file("/dev/null", "x");
    EXPECT_FALSE(fs::is_regular_file("/dev/null"));
}

// The target of the link may never exist; the user asked for a file of this name.
TEST(ReplaceFile, ReplacesADanglingLink) {
    const TemporaryFolder folder;
    fs::create_symlink("nowhere", folder.path() / "x");
    replace_file(folder.path() / "x", "new");
    EXPECT_EQ(read_file(folder.path() / "x"), "new");
    EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(folder.path() / "x")) || fs::exists(folder.path() / "nowhere"));
}

TEST(ReplaceFile, WritesTheTargetOfALink) {
    const TemporaryFolder folder;
    replace_file(folder.path() / "file", "old");
    fs::create_symlink("file", folder.path() / "x");
    replace_file(folder.path() / "x", "new");
    EXPECT_EQ(read_file(folder.path() / "file"), "new");
    EXPECT_TRUE(fs::is_symlink(folder.path() / "x"));
}
