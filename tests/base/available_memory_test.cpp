#include "base/available_memory.h"

#include <gtest/gtest.h>

#include "base/file_bytes.h"
#include "temporary_folder.h"

using namespace meshfolio;
using testing_tools::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

/// A machine with invented files in /proc and /sys: 8 GiB are left without limits.
class Machine {
public:
    Machine() { put("proc/meminfo", "MemTotal: 16777216 kB\nMemFree: 1 kB\nMemAvailable: 8388608 kB\n"); }
    void put(const std::string& file, const std::string& text) const {
        fs::create_directories((folder_.path() / file).parent_path());
        write_file(folder_.path() / file, text);
    }
    AvailableMemory memory() const { return available_memory(folder_.path()); }

private:
    TemporaryFolder folder_;
};

constexpr double gigabyte = 1 << 30;

}   // namespace

TEST(AvailableMemory, WithoutLimitsItIsTheMemoryTheMachineHasLeft) {
    EXPECT_EQ(Machine().memory().bytes, 8 * gigabyte);
    EXPECT_EQ(Machine().memory().limited_by, "MemAvailable");
    EXPECT_GT(available_memory().bytes, 1e6) << "of this one";
}

TEST(AvailableMemory, TheTightestGroupOfVersion2OrAboveItLimits) {
    const Machine machine;
    machine.put("proc/self/cgroup", "0::/user/job\n");
    machine.put("sys/fs/cgroup/user/job/memory.max", "max\n");
    machine.put("sys/fs/cgroup/user/job/memory.current", "1073741824\n");
    EXPECT_EQ(machine.memory().bytes, 8 * gigabyte);
    machine.put("sys/fs/cgroup/user/memory.max", "3221225472\n");
    machine.put("sys/fs/cgroup/user/memory.current", "2147483648\n");
    EXPECT_EQ(machine.memory().bytes, gigabyte);
    EXPECT_EQ(machine.memory().limited_by, "the control group");
    machine.put("sys/fs/cgroup/user/memory.stat", "anon 1\ninactive_file 1073741824\n");
    EXPECT_EQ(machine.memory().bytes, 2 * gigabyte) << "pages of files can be dropped";
}

TEST(AvailableMemory, AGroupOfVersion1LimitsInsideAndOutsideAContainer) {
    for (const std::string folder : {"sys/fs/cgroup/memory/docker/ab/", "sys/fs/cgroup/memory/"}) {
        const Machine machine;
        machine.put("proc/self/cgroup", "9:name=systemd:/\n4:hugetlb,memory:/docker/ab\n");
        machine.put(folder + "memory.limit_in_bytes", "2147483648\n");
        machine.put(folder + "memory.usage_in_bytes", "1073741824\n");
        EXPECT_EQ(machine.memory().bytes, gigabyte) << folder;
    }
}
