#include "output/publish/user_files.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <map>
#include <string>
#include <vector>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "output/publish/publish.h"
#include "output/publish/temporaries.h"
#include "temporary_folder.h"

using namespace meshfolio;
using namespace meshfolio::output;
using testing_tools::dead_process;
using testing_tools::entries_in;
using testing_tools::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

using Files = std::map<std::string, std::string>;

/// A folder that is published repeatedly.
class CarriedOver : public testing::Test {
protected:
    TemporaryFolder place;
    const fs::path out = place.path() / "out";

    Notes publish(const Files& files, const fs::path& target) const {
        Publication publication(target);
        for (const auto& [name, bytes] : files) {
            fs::create_directories((publication.folder() / name).parent_path());
            write_file(publication.folder() / name, bytes);
        }
        Notes notes = publication.publish();
        EXPECT_EQ(notes.warning, "");
        return notes;
    }
    Notes publish(const Files& files) const { return publish(files, out); }
    void SetUp() override { publish({{"report.md", "old"}, {"tables/a.csv", "1"}}); }
    void write(const std::string& name, const std::string& bytes) const {
        fs::create_directories((out / name).parent_path());
        write_file(out / name, bytes);
    }
    std::string text(const std::string& name) const { return read_file(out / name); }
};

struct stat status_of(const fs::path& path) {
    struct stat status {};
    EXPECT_EQ(::lstat(path.c_str(), &status), 0) << path;
    return status;
}

}   // namespace

TEST_F(CarriedOver, FilesFoldersLinksModesAndTimesStay) {
    write("thesis.tex", "months");
    write("tables/mine.csv", "2");
    write("notes/deep/a", "a");
    fs::create_directories(out / "empty" / "inside");
    fs::create_symlink("/nowhere/at all", out / "link");
    fs::create_directory_symlink("/etc", out / "folder-link");
    ASSERT_EQ(::mkfifo((out / "pipe").c_str(), 0600), 0);
    write("strange\nname\xff", "x");
    fs::create_hard_link(out / "thesis.tex", place.path() / "second name");
    ::chmod((out / "thesis.tex").c_str(), 0640);
    write("closed", "secret");
    ::chmod((out / "closed").c_str(), 0);
    ::chmod((out / "notes").c_str(), 0555);
    const timespec times[] = {{1, 0}, {1000000000, 5}};
    ::utimensat(AT_FDCWD, (out / "thesis.tex").c_str(), times, 0);
    ::utimensat(AT_FDCWD, (out / "notes").c_str(), times, 0);
    const auto before = status_of(out / "thesis.tex");
    const Notes notes = publish({{"report.md", "new"}});
    ASSERT_EQ(notes.kept.size(), 1U);
    EXPECT_NE(notes.kept[0].find("kept 9 files of yours"), std::string::npos) << notes.kept[0];
    EXPECT_EQ(text("report.md"), "new");
    EXPECT_FALSE(fs::exists(out / "tables/a.csv"));
    const auto after = status_of(out / "thesis.tex");
    EXPECT_EQ(after.st_mode, before.st_mode);
    EXPECT_EQ(after.st_mtim.tv_nsec, before.st_mtim.tv_nsec);
    EXPECT_EQ(after.st_ino, before.st_ino) << "no byte is copied, however large the file";
    EXPECT_EQ(after.st_nlink, 2U) << "the name outside, and this one";
    EXPECT_EQ(text("tables/mine.csv"), "2");
    EXPECT_EQ(text("notes/deep/a"), "a");
    EXPECT_EQ(text("strange\nname\xff"), "x");
    EXPECT_TRUE(fs::is_directory(out / "empty" / "inside"));
    EXPECT_EQ(fs::read_symlink(out / "link"), "/nowhere/at all");
    EXPECT_TRUE(fs::is_symlink(out / "folder-link"));
    EXPECT_TRUE(fs::is_fifo(out / "pipe"));
    EXPECT_EQ(status_of(out / "closed").st_mode & 07777, 0U);
    EXPECT_EQ(status_of(out / "notes").st_mode & 07777, 0555U);
    EXPECT_EQ(status_of(out / "notes").st_mtim.tv_sec, 1000000000);
    EXPECT_EQ(entries_in(place.path()), 2) << "nothing is left beside";
    ::chmod((out / "notes").c_str(), 0755);
}

TEST_F(CarriedOver, EachEditedVersionIsKeptOnceUnderAnotherName) {
    write("report.md", "edited");
    EXPECT_NE(publish({{"report.md", "new"}}).kept.at(0).find("report.md.edited"), std::string::npos);
    EXPECT_EQ(text("report.md"), "new");
    EXPECT_EQ(text("report.md.edited"), "edited");
    write("report.md", "edited");
    publish({{"report.md", "new"}});
    EXPECT_FALSE(fs::exists(out / "report.md.edited.2")) << "the same edit";
    write("report.md", "again");
    publish({{"report.md", "newer"}});
    EXPECT_EQ(text("report.md"), "newer");
    EXPECT_EQ(text("report.md.edited"), "edited");
    EXPECT_EQ(text("report.md.edited.2"), "again");
    write("report.md", "no longer made");
    publish({{"index.html", "x"}});
    EXPECT_EQ(text("report.md.edited.3"), "no longer made");
    EXPECT_FALSE(fs::exists(out / "report.md"));
}

TEST_F(CarriedOver, FilesWithNamesOfTheNewFolderAreRenamed) {
    write("appendix.md", "mine");
    write("same.md", "same");
    write("x/file", "a folder where a file comes");
    write("y", "a file where a folder comes");
    fs::remove_all(out / "tables");
    fs::create_directory_symlink("/etc", out / "tables");
    publish({{"appendix.md", "ours"}, {"same.md", "same"}, {"x", "file"}, {"y/z", "z"}, {"tables/a.csv", "2"}});
    EXPECT_EQ(text("appendix.md"), "ours");
    EXPECT_EQ(text("appendix.md.edited"), "mine");
    EXPECT_FALSE(fs::exists(out / "same.md.edited"));
    EXPECT_EQ(text("x.edited/file"), "a folder where a file comes");
    EXPECT_EQ(text("y.edited"), "a file where a folder comes");
    EXPECT_EQ(fs::read_symlink(out / "tables.edited"), "/etc");
    EXPECT_EQ(text("tables/a.csv"), "2");
}

TEST_F(CarriedOver, WithoutSumsEveryFileCountsAsTheUsers) {
    for (const char* how : {"missing", "damaged", "link"}) {
        publish({{"report.md", how}, {"only/old", how}});
        fs::remove(out / sums_file);
        if (how == std::string("damaged")) write(sums_file, "this is no list\n");
        if (how == std::string("link")) fs::create_symlink("/etc/hostname", out / sums_file);
        publish({{"report.md", std::string("after ") + how}});
        EXPECT_EQ(text("report.md"), std::string("after ") + how);
        EXPECT_EQ(text("only/old"), how);
        EXPECT_TRUE(sums_of(out).is_there) << how;
        fs::remove_all(out / "only");
    }
    EXPECT_EQ(text("report.md.edited"), "missing");
    EXPECT_EQ(text("report.md.edited.2"), "damaged");
    EXPECT_EQ(text("SHA256SUMS.edited"), "this is no list\n");
    EXPECT_EQ(fs::read_symlink(out / "SHA256SUMS.edited.2"), "/etc/hostname");
}

TEST_F(CarriedOver, SumsDoNotLeadOutside) {
    write_file(place.path() / "precious", "x");
    const std::string digest = "2d711642b726b04401627ca9fbac32f5c8530fb1903cc4db02258717921a4881";   // of "x"
    write(sums_file, text(sums_file) + digest + "  ../precious\n" + digest + "  " + (place.path() / "precious").string() + "\n");
    publish({{"report.md", "new"}});
    EXPECT_EQ(read_file(place.path() / "precious"), "x");
}

TEST_F(CarriedOver, RemovingAFailedReportLeavesTheUsersFiles) {
    const fs::path failed = failed_beside(out);
    publish({{"report.md", "bad"}}, failed);
    write_file(failed / "notes.txt", "mine");
    Publication bad(out);
    write_file(bad.folder() / "report.md", "worse");
    bad.step_aside();
    bad.publish();
    EXPECT_EQ(read_file(failed / "report.md"), "worse");
    EXPECT_EQ(read_file(failed / "notes.txt"), "mine");
    Publication good(out);
    good.publish();
    EXPECT_EQ(good.remove_failed().size(), 1U);
    EXPECT_EQ(read_file(failed / "notes.txt"), "mine");
    EXPECT_FALSE(fs::exists(failed / "report.md"));
    fs::remove(failed / "notes.txt");
    EXPECT_TRUE(good.remove_failed().empty());
    EXPECT_FALSE(fs::exists(failed));
}

TEST_F(CarriedOver, SweepingLeftoversRestoresTheUsersFiles) {
    const std::string dead = std::to_string(dead_process());
    for (const char* name : {".tmp-", ".old-"}) {
        const fs::path leftover = out.string() + name + dead;
        publish({{"report.md", "replaced"}}, leftover);
        write_file(leftover / (std::string("thesis") + name), name);
        sweep_leftovers(out);
        EXPECT_FALSE(fs::exists(leftover)) << name;
        EXPECT_EQ(text(std::string("thesis") + name), name);
        EXPECT_EQ(text("report.md"), "old");
    }
    fs::rename(out, out.string() + ".tmp-" + dead);
    sweep_leftovers(out);
    EXPECT_EQ(text("report.md"), "old") << "a finished folder becomes the missing one";
}

TEST_F(CarriedOver, ConcurrentRunsLoseNoFile) {
    for (int i = 0; i < 20; ++i) write("mine" + std::to_string(i), std::to_string(i));
    write("report.md", "edited");
    std::vector<pid_t> children;
    for (int i = 0; i < 4; ++i) {
        const pid_t child = ::fork();
        if (child == 0) {
            try {
                for (int k = 0; k < 5; ++k) {
                    write_file(out / ("late" + std::to_string(i) + "-" + std::to_string(k)), "late");
                    Publication publication(out);
                    write_file(publication.folder() / "report.md", std::to_string(i));
                    publication.publish();
                }
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
    for (int i = 0; i < 20; ++i) {
        EXPECT_EQ(text("mine" + std::to_string(i)), std::to_string(i));
        EXPECT_EQ(text("late" + std::to_string(i / 5) + "-" + std::to_string(i % 5)), "late");
    }
    EXPECT_EQ(text("report.md.edited"), "edited");
    EXPECT_EQ(entries_in(place.path()), 1);
}

TEST_F(CarriedOver, TheLastCheckSeesTheReportOfAnotherRun) {
    Publication publication(out);
    publish({{"report.md", "another"}});
    EXPECT_THROW(publication.publish({}, [&] { throw OutputError("out", read_file(out / "report.md")); }), OutputError);
    EXPECT_EQ(text("report.md"), "another");
}

TEST(ReplaceListed, KeepsFilesThatDifferFromTheList) {
    const TemporaryFolder place;
    write_file(place.path() / "b", "the user's");
    EXPECT_EQ(replace_listed(place.path(), {{"a", "1"}, {"b", "1"}}), std::vector<std::string>{"b.edited"});
    EXPECT_TRUE(replace_listed(place.path(), {{"a", "2"}, {"b", "2"}}).empty());
    write_file(place.path() / "a", "edited");
    EXPECT_EQ(replace_listed(place.path(), {{"a", "3"}, {"b", "3"}}), std::vector<std::string>{"a.edited"});
    EXPECT_EQ(read_file(place.path() / "a"), "3");
    EXPECT_EQ(read_file(place.path() / "a.edited"), "edited");
    EXPECT_EQ(read_file(place.path() / "b.edited"), "the user's");
    EXPECT_EQ(first_changed(place.path()), "");
    const std::string sums = read_file(place.path() / sums_file);
    EXPECT_TRUE(replace_listed(place.path(), {{"a", "3"}, {"b", "3"}}).empty());
    EXPECT_EQ(read_file(place.path() / sums_file), sums) << "each file once, where nothing has changed";
    write_file(place.path() / sums_file, std::string(64, '0') + "  another list\n");
    EXPECT_EQ(replace_listed(place.path(), {{"a", "3"}, {"b", "3"}}), std::vector<std::string>{"SHA256SUMS.edited"});
}

TEST(FirstChanged, NamesTheChangedFile) {
    const TemporaryFolder place;
    const fs::path out = place.path() / "out";
    {
        Publication publication(out);
        for (const char* name : {"a", "b"}) write_file(publication.folder() / name, name);
        publication.publish();
    }
    write_file(out / "mine", "x");
    EXPECT_EQ(first_changed(out), "");
    write_file(out / "b", "changed");
    EXPECT_EQ(first_changed(out), "b");
    fs::remove(out / "a");
    EXPECT_EQ(first_changed(out), "a");
    fs::remove(out / sums_file);
    EXPECT_THROW(first_changed(out), InputError);
}
