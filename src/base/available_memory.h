#pragma once

#include <filesystem>
#include <string>

namespace meshfolio {

struct AvailableMemory {
    double bytes = 0;         // 0: the system does not say
    std::string limited_by;   // "MemAvailable", "RLIMIT_AS" or "the control group"
};

/// Returns the tightest of three limits, at least 1 byte if any is known: the memory that the machine has left without swapping, the
/// addresses that RLIMIT_AS leaves, and what the process's control group (version 1 or 2) and the groups above it leave.
/// @param root  folder of proc/ and sys/; another one in tests
AvailableMemory available_memory(const std::filesystem::path& root = "/");

}   // namespace meshfolio
