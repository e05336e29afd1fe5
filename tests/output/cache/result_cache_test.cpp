#include "output/cache/result_cache.h"

#include <gtest/gtest.h>

#include <fstream>
#include <thread>
#include <vector>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "base/sha256.h"
#include "temporary_folder.h"

using namespace meshfolio;
using namespace meshfolio::output;
using testing_tools::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t roomy = 1 << 20;

std::string key_of(std::string_view word) { return KeyMaker().add(word).key(); }

std::vector<fs::path> paths_below(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file()) files.push_back(entry.path());
    }
    return files;
}

/// Overwrites a file by a new one: other links to it keep what they have.
void spoil(const fs::path& path, const std::string& bytes) {
    fs::remove(path);
    write_file(path, bytes);
}

}   // namespace

TEST(KeyMaker, DifferentListsOfWordsHaveDifferentKeys) {
    EXPECT_NE(KeyMaker().add("ab").add("c").key(), KeyMaker().add("a").add("bc").key());
    EXPECT_NE(KeyMaker().add("").key(), KeyMaker().key());
    EXPECT_EQ(KeyMaker().add("a").key(), KeyMaker().add("a").key());
}

TEST(ResultCache, GivesBackWhatWasPut) {
    const TemporaryFolder folder;
    ResultCache cache(folder.path() / "cache", roomy);
    EXPECT_FALSE(cache.get(key_of("a")));
    cache.put(key_of("a"), std::string("x\0y", 3));
    cache.put(key_of("b"), "");
    EXPECT_EQ(cache.get(key_of("a")), std::string("x\0y", 3));
    EXPECT_EQ(cache.get(key_of("b")), "");
    cache.put(key_of("a"), "other");
    EXPECT_EQ(ResultCache(folder.path() / "cache", roomy).get(key_of("a")), "other");
}

TEST(ResultCache, FilesAreKeptByTheirContent) {
    const TemporaryFolder folder;
    ResultCache cache(folder.path() / "cache", roomy);
    EXPECT_EQ(cache.keep("picture"), sha256("picture"));
    EXPECT_EQ(cache.keep("picture"), sha256("picture"));
    EXPECT_EQ(cache.size().files, 1u);
    EXPECT_EQ(cache.bytes_of(sha256("picture")), "picture");
    EXPECT_EQ(cache.bytes_of(sha256("none")), std::nullopt);
}

TEST(ResultCache, DamageCountsAsAbsence) {
    for (const std::string& damaged : {std::string(), std::string("p"), std::string("picturf"), std::string("picture ")}) {
        const TemporaryFolder folder;
        ResultCache cache(folder.path() / "cache", roomy);
        const std::string digest = cache.keep("picture");
        cache.put(key_of("a"), "bytes");
        for (const fs::path& file : paths_below(folder.path())) spoil(file, damaged);
        EXPECT_FALSE(cache.get(key_of("a")));
        EXPECT_FALSE(cache.bytes_of(digest));
        EXPECT_TRUE(paths_below(folder.path()).empty()) << "what is damaged is removed";
        cache.put(key_of("a"), "bytes");
        EXPECT_EQ(cache.keep("picture"), digest);
        EXPECT_EQ(cache.get(key_of("a")), "bytes");
        EXPECT_EQ(cache.bytes_of(digest), "picture");
    }
}

TEST(ResultCache, KeepingRepairsWhatIsDamaged) {
    const TemporaryFolder folder;
    ResultCache cache(folder.path() / "cache", roomy);
    const std::string digest = cache.keep("picture");
    for (const fs::path& file : paths_below(folder.path() / "cache")) spoil(file, "damaged");
    EXPECT_EQ(cache.keep("picture"), digest);
    EXPECT_EQ(cache.bytes_of(digest), "picture");
}

TEST(ResultCache, NamesThatAreNoDigestsLeadNowhere) {
    const TemporaryFolder folder;
    ResultCache cache(folder.path() / "cache", roomy);
    write_file(folder.path() / "secret", "x");
    for (const char* name : {"", "ab", "../../secret", "/etc/passwd"}) EXPECT_FALSE(cache.bytes_of(name)) << name;
}

TEST(ResultCache, TheLeastRecentlyUsedGoesFirst) {
    const TemporaryFolder folder;
    ResultCache cache(folder.path() / "cache", 3000);
    const auto wait = [] { std::this_thread::sleep_for(std::chrono::milliseconds(20)); };
    for (const char* name : {"a", "b", "c"}) {
        cache.put(key_of(name), std::string(1200, 'x'));
        wait();
    }
    EXPECT_TRUE(cache.get(key_of("a")));
    cache.trim();
    EXPECT_TRUE(cache.get(key_of("a")));
    EXPECT_FALSE(cache.get(key_of("b")));
    EXPECT_TRUE(cache.get(key_of("c")));
    EXPECT_LE(cache.size().bytes, 3000u);
}

TEST(ResultCache, ClearingRemovesWhatIsStoredAndNothingElse) {
    const TemporaryFolder folder;
    ResultCache cache(folder.path(), roomy);
    cache.put(key_of("a"), "bytes");
    cache.keep("picture");
    write_file(folder.path() / "mine", "x");
    cache.clear();
    EXPECT_EQ(paths_below(folder.path()), std::vector<fs::path>{folder.path() / "mine"});
    cache.put(key_of("a"), "bytes");
    EXPECT_EQ(cache.get(key_of("a")), "bytes");
}

TEST(ResultCache, ManyWritersDoNotDisturbEachOther) {
    const TemporaryFolder folder;
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t) {
        threads.emplace_back([&] {
            ResultCache cache(folder.path() / "cache", roomy);
            for (int i = 0; i < 50; ++i) {
                const std::string name = std::to_string(i), bytes(1000, static_cast<char>('a' + i % 20));
                cache.put(key_of(name), bytes);
                const auto got = cache.get(key_of(name));
                EXPECT_TRUE(!got || *got == bytes);
                const auto object = cache.bytes_of(cache.keep(bytes));
                EXPECT_TRUE(!object || *object == bytes);
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
}

TEST(ResultCache, AnUnusableFolderIsNamed) {
    const TemporaryFolder folder;
    write_file(folder.path() / "file", "");
    EXPECT_THROW(ResultCache(folder.path() / "file", roomy), OutputError);
}
