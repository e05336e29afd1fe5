#include "output/publish/publish.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <map>
#include <sstream>
#include <thread>
#include <vector>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "base/sha256.h"
#include "output/publish/temporaries.h"
#include "temporary_folder.h"

using namespace meshfolio;
using namespace meshfolio::output;
using testing_tools::dead_process;
using testing_tools::entries_in;
using testing_tools::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

/// Returns relative path → bytes of every file below a folder.
std::map<std::string, std::string> contents(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file()) files[entry.path().lexically_relative(folder).generic_string()] = read_file(entry.path());
    }
    return files;
}

void publish(const fs::path& target, const std::map<std::string, std::string>& files) {
    Publication publication(target);
    for (const auto& [name, bytes] : files) {
        fs::create_directories((publication.folder() / name).parent_path());
        write_file(publication.folder() / name, bytes);
    }
    EXPECT_EQ(publication.publish().warning, "");
}

}   // namespace

TEST(Publication, FirstRunMakesTheFolderAndItsParents) {
    const TemporaryFolder folder;
    const fs::path target = folder.path() / "a" / "b" / "out";
    publish(target, {{"index.html", "one"}, {"images/x.png", "two"}});
    const auto files = contents(target);
    EXPECT_EQ(files.at("index.html"), "one");
    EXPECT_EQ(files.at("images/x.png"), "two");
    EXPECT_TRUE(files.contains(marker_file));
    EXPECT_EQ(entries_in(target.parent_path()), 1) << "the temporary folder is gone";
}

TEST(Publication, AFolderClosedToOthersStaysClosed) {
    const TemporaryFolder folder;
    const fs::path target = folder.path() / "out";
    publish(target, {{"index.html", "old"}});
    EXPECT_NE(fs::status(target).permissions() & fs::perms::others_read, fs::perms::none);
    fs::permissions(target, fs::perms::owner_all);
    publish(target, {{"index.html", "new"}});
    EXPECT_EQ(fs::status(target).permissions(), fs::perms::owner_all);
}

TEST(Publication, ReplacesTheEarlierReportAsAWhole) {
    const TemporaryFolder folder;
    const fs::path target = folder.path() / "out";
    publish(target, {{"index.html", "old"}, {"stale.txt", "stale"}});
    publish(target, {{"index.html", "new"}});
    const auto files = contents(target);
    EXPECT_EQ(files.at("index.html"), "new");
    EXPECT_FALSE(files.contains("stale.txt"));
    EXPECT_EQ(entries_in(folder.path()), 1);
}

TEST(Publication, AFailedReportStaysBesideTheGoodOneUntilTheNextGoodOne) {
    const TemporaryFolder folder;
    const fs::path target = folder.path() / "out", failed = folder.path() / "out.failed";
    EXPECT_EQ(failed_beside(target), failed);
    EXPECT_EQ(failed_beside(target / ""), failed);
    publish(target, {{"index.html", "good"}});
    const auto before = contents(target);
    for (const std::string text : {"bad", "worse"}) {
        Publication publication(target);
        write_file(publication.folder() / "index.html", text);
        publication.step_aside();
        EXPECT_EQ(publication.publish().warning, "");
        EXPECT_EQ(contents(target), before);
        EXPECT_EQ(contents(failed).at("index.html"), text);
        EXPECT_EQ(entries_in(folder.path()), 2);
    }
    Publication good(target);
    good.publish();
    good.remove_failed();
    EXPECT_EQ(entries_in(folder.path()), 1);
    fs::create_directory(failed);
    write_file(failed / "thesis.tex", "precious");
    good.remove_failed();
    EXPECT_TRUE(fs::exists(failed / "thesis.tex")) << "not ours";
    Publication bad(target);
    EXPECT_THROW(bad.step_aside(), OutputError);
}

TEST(Publication, LeavesTheOldFolderUnchangedIfItIsNotPublished) {
    const TemporaryFolder folder;
    const fs::path target = folder.path() / "out";
    publish(target, {{"index.html", "old"}});
    const auto before = contents(target);
    {
        const Publication publication(target);
        write_file(publication.folder() / "index.html", "half");
        EXPECT_EQ(contents(target), before) << "nothing of the new one shows before it is published";
    }
    EXPECT_EQ(contents(target), before);
    EXPECT_EQ(entries_in(folder.path()), 1);
}

TEST(Publication, SumsNameEveryOtherFileSortedWithItsDigest) {
    const TemporaryFolder folder;
    const fs::path target = folder.path() / "out";
    fs::create_directory(target);
    write_file(target / ".gitignore", "*\n");
    publish(target, {{"b", "1"}, {"a/z", "2"}, {"a.txt", "3"}});
    auto files = contents(target);
    std::istringstream sums(files.at(sums_file));
    files.erase(sums_file);
    files.erase(".gitignore");   // the user's
    std::map<std::string, std::string> listed;
    std::string line, previous;
    while (std::getline(sums, line)) {
        const std::string name = line.substr(66);
        EXPECT_EQ(line.substr(64, 2), "  ");
        EXPECT_LT(previous, name);
        previous = name;
        listed[name] = line.substr(0, 64);
    }
    ASSERT_EQ(listed.size(), files.size());
    for (const auto& [name, bytes] : files) EXPECT_EQ(listed.at(name), sha256(bytes)) << name;
}

TEST(Publication, KeepsTheGitignore) {
    const TemporaryFolder folder;
    const fs::path target = folder.path() / "out";
    fs::create_directory(target);
    write_file(target / ".gitignore", "*\n!.gitignore\n");
    publish(target, {{"index.html", "one"}});
    publish(target, {{"index.html", "two"}});
    EXPECT_EQ(contents(target).at(".gitignore"), "*\n!.gitignore\n");
}

TEST(Publication, RefusesAForeignFolder) {
    const TemporaryFolder folder;
    const fs::path target = folder.path() / "thesis";
    fs::create_directory(target);
    write_file(target / "chapter1.tex", "months of work");
    EXPECT_THROW(Publication{target}, OutputError);
    EXPECT_EQ(contents(target), (std::map<std::string, std::string>{{"chapter1.tex", "months of work"}}));
    EXPECT_EQ(entries_in(folder.path()), 1);
}

TEST(Publication, RefusesAFolderThatBecameForeignMeanwhile) {
    const TemporaryFolder folder;
    const fs::path target = folder.path() / "out";
    Publication publication(target);
    fs::create_directory(target);
    write_file(target / "mine.txt", "mine");
    EXPECT_THROW(publication.publish(), OutputError);
    EXPECT_EQ(read_file(target / "mine.txt"), "mine");
}

TEST(Publication, RefusesAFileAsTargetOrParent) {
    const TemporaryFolder folder;
    write_file(folder.path() / "file", "x");
    EXPECT_THROW(Publication{folder.path() / "file"}, OutputError);
    EXPECT_THROW(Publication{folder.path() / "file" / "out"}, OutputError);
    EXPECT_EQ(read_file(folder.path() / "file"), "x");
}

TEST(Publication, FollowsALinkToAFolder) {
    const TemporaryFolder folder;
    publish(folder.path() / "real", {{"index.html", "old"}});
    fs::create_directory_symlink("real", folder.path() / "link");
    publish(folder.path() / "link", {{"index.html", "new"}});
    EXPECT_TRUE(fs::is_symlink(folder.path() / "link"));
    EXPECT_EQ(read_file(folder.path() / "real" / "index.html"), "new");
}

TEST(Publication, TrailingSlashAndDotsNameTheSameFolder) {
    const TemporaryFolder folder;
    publish(folder.path() / "x" / ".." / "out" / "", {{"index.html", "here"}});
    EXPECT_EQ(read_file(folder.path() / "out" / "index.html"), "here");
}

TEST(Publication, TwoConcurrentRunsLeaveOneWholeReport) {
    const TemporaryFolder folder;
    const fs::path target = folder.path() / "out";
    std::vector<pid_t> children;
    for (int i = 0; i < 4; ++i) {
        const pid_t child = ::fork();
        if (child == 0) {
            const std::string text = std::to_string(i);
            try {
                Publication publication(target);
                write_file(publication.folder() / "a", text);
                write_file(publication.folder() / "b", text);
                publication.publish();
            } catch (const Error&) {
                ::_exit(1);
            }
            ::_exit(0);
        }
        children.push_back(child);
    }
    for (const pid_t child : children) {
        int status = 0;
        ::waitpid(child, &status, 0);
        EXPECT_EQ(status, 0);
    }
    EXPECT_EQ(read_file(target / "a"), read_file(target / "b"));
    EXPECT_EQ(entries_in(folder.path()), 1);
}

TEST(Leftovers, OfDeadRunsAreRemovedAndOthersStay) {
    const TemporaryFolder folder;
    const fs::path target = folder.path() / "out";
    const auto make = [&](const std::string& name, const std::string& file) {
        fs::create_directory(folder.path() / name);
        write_file(folder.path() / name / file, file == marker_file ? report_folder.contents : "x");
    };
    const std::string dead = std::to_string(dead_process()), alive = std::to_string(::getppid());
    make("out.tmp-" + dead, marker_file);
    make("out.tmp-" + alive, marker_file);
    make("other.tmp-" + dead, marker_file);
    make("out.tmp-x", marker_file);
    make("out.tmp-999999999", "not_ours.txt");
    publish(target, {{"index.html", "x"}});
    EXPECT_FALSE(fs::exists(folder.path() / ("out.tmp-" + dead)));
    EXPECT_TRUE(fs::exists(folder.path() / ("out.tmp-" + alive)));
    EXPECT_TRUE(fs::exists(folder.path() / ("other.tmp-" + dead)));
    EXPECT_TRUE(fs::exists(folder.path() / "out.tmp-x"));
    EXPECT_TRUE(fs::exists(folder.path() / "out.tmp-999999999"));
}

TEST(Leftovers, AZombieProcessIsDead) {
    const pid_t child = ::fork();
    if (child == 0) ::_exit(0);
    siginfo_t state{};
    ASSERT_EQ(::waitid(P_PID, static_cast<id_t>(child), &state, WEXITED | WNOWAIT), 0);
    EXPECT_TRUE(is_dead(child));
    ::waitpid(child, nullptr, 0);
    EXPECT_FALSE(is_dead(::getpid()));
    EXPECT_FALSE(is_dead(1));
}

TEST(Leftovers, AReplacedFolderIsRestoredIfItsSuccessorIsMissing) {
    const TemporaryFolder folder;
    const fs::path target = folder.path() / "out";
    publish(target, {{"index.html", "old"}});
    fs::rename(target, target.string() + ".old-" + std::to_string(dead_process()));
    sweep_leftovers(target);
    EXPECT_EQ(read_file(target / "index.html"), "old");
    EXPECT_EQ(entries_in(folder.path()), 1);
}

TEST(AbandonPublications, RemovesUnfinishedFilesAndStopsPublishing) {
    const TemporaryFolder folder;
    const fs::path target = folder.path() / "out";
    publish(target, {{"index.html", "old"}});
    const pid_t child = ::fork();
    if (child == 0) {
        const Publication publication(target);
        write_file(publication.folder() / "index.html", "half");
        abandon_publications();
        ::_exit(fs::exists(publication.folder()) ? 1 : 0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
    EXPECT_EQ(read_file(target / "index.html"), "old");
    EXPECT_EQ(entries_in(folder.path()), 1);
}
