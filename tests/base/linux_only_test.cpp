#include "base/linux_only.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "base/file_bytes.h"
#include "temporary_folder.h"

namespace fs = std::filesystem;
using namespace meshfolio;

TEST(LinuxOnly, ThisProgramIsTheFileThatRuns) { EXPECT_TRUE(fs::equivalent(this_program(), "/proc/self/exe")); }

TEST(LinuxOnly, ATakenNameIsReplacedKeptOrExchanged) {
    const testing_tools::TemporaryFolder folder;
    const fs::path a = folder.path() / "a", b = folder.path() / "b";
    write_file(a, "1");
    write_file(b, "2");
    if (const int error = rename_with(a, b, Taken::exchanged); error != EINVAL) {   // elsewhere, and on file systems that cannot
        ASSERT_EQ(error, 0);
        EXPECT_EQ(read_file(a) + read_file(b), "21");
        EXPECT_EQ(rename_with(a, b, Taken::kept), EEXIST);
        ASSERT_EQ(rename_with(b, a, Taken::exchanged), 0);
    }
    EXPECT_EQ(read_file(a) + read_file(b), "12");
    EXPECT_EQ(rename_with(a, b, Taken::replaced), 0);
    EXPECT_EQ(read_file(b), "1");
    EXPECT_EQ(rename_with(a, b, Taken::replaced), ENOENT);
}

TEST(LinuxOnly, MountPointsAreSeen) {
    EXPECT_FALSE(is_mount_point(testing_tools::TemporaryFolder().path()));
    EXPECT_TRUE(is_mount_point("/proc"));
}

TEST(LinuxOnly, ADescriptorTellsTheEndOfItsProcess) {
    const pid_t child = ::fork();
    if (child == 0) ::pause();
    pollfd watched{descriptor_of(child), POLLIN, 0};
    if (watched.fd >= 0) {   // not in old kernels
        EXPECT_EQ(::poll(&watched, 1, 0), 0);
    }
    ::kill(child, SIGKILL);
    if (watched.fd >= 0) {
        EXPECT_EQ(::poll(&watched, 1, 10000), 1);
    }
    ::waitpid(child, nullptr, 0);
    ::close(watched.fd);
    EXPECT_EQ(descriptor_of(-1), -1);
}

#ifndef MESHFOLIO_PORTABLE
TEST(LinuxOnly, LibrariesAreNamed) {
    EXPECT_TRUE(
        std::ranges::any_of(loaded_libraries(), [](const std::string& name) { return name.find("/libstdc++.so") != std::string::npos; }));
}
#endif
