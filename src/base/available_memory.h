/// @file
/// How much memory this process may still take.
#pragma once

#include <filesystem>
#include <string>

namespace meshfolio {

struct AvailableMemory {
    double bytes = 0;         // 0: the system does not say
    std::string limited_by;   // "MemAvailable", "RLIMIT_AS" or "the control group"
};

/// The least of what the machine has left without swapping, what the process may address beyond what it has (RLIMIT_AS), and what its
/// control group (version 1 or 2) and those above it leave.
/// @param root  where /proc and /sys are; for tests
AvailableMemory available_memory(const std::filesystem::path& root = "/");

}   // namespace meshfolio
