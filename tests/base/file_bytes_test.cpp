#include "base/file_bytes.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "base/errors.h"

using namespace meshfolio;
namespace fs = std::filesystem;

TEST(FileBytes, RoundTripKeepsEveryByte) {
    const fs::path path = fs::path(testing::TempDir()) / "bytes";
    std::string bytes;
    for (int i = 0; i < 256; ++i) bytes += static_cast<char>(i);
    write_file(path, bytes);
    EXPECT_EQ(read_file(path), bytes);
    EXPECT_THROW(read_file(path, 255), InputError);
}

TEST(FileBytes, OnlyRegularFilesAreRead) {
    EXPECT_THROW(read_file(testing::TempDir()), InputError);
    EXPECT_THROW(read_file(fs::path(testing::TempDir()) / "absent"), InputError);
    EXPECT_THROW(read_file("/dev/zero"), InputError);
    const fs::path fifo = fs::path(testing::TempDir()) / "fifo";
    fs::remove(fifo);
    ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
    EXPECT_THROW(read_file(fifo), InputError);
}

TEST(FileBytes, AFullDiskIsAnError) {
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
    try {
        write_file("/dev/full", "x");
        FAIL() << "no error";
    } catch (const OutputError& error) {
        EXPECT_NE(std::string(error.what()).find("/dev/full"), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("No space left"), std::string::npos);
    }
}
