/// @file
/// BLAS from several threads. CHOLMOD's supernodal code calls BLAS and LAPACK, and not every library of them may be called by two threads
/// at once: OpenBLAS built for one thread then hands the same buffer to both, and their factors are wrong without a word.
#pragma once

#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace meshfolio {

struct BlasLibrary {
    std::vector<std::string> files;   // that the routines come from; empty: none is loaded
    std::string configuration;        // in OpenBLAS's own words; empty for every other library
    bool is_safe = false;             // may be called by several threads at once
};

/// The library loaded with the program, whichever the system's alternatives or the environment have chosen. It is asked once, and a safe
/// one is held to one thread of its own from then on: its sums then do not depend on how many there could be.
const BlasLibrary& blas_library();

/// How OpenBLAS was built to work in parallel (openblas_get_parallel()).
enum class BlasThreads { none = 0, posix = 1, openmp = 2 };

/// True if such a build of OpenBLAS guards its buffers: one with POSIX threads, or for one thread with USE_LOCKING, which its configuration
/// names from version 0.3.28 on. A build with OpenMP counts only the threads of OpenMP.
bool guards_its_buffers(BlasThreads threads, std::string_view configuration);

/// To be held around every call that reaches BLAS. Only one thread holds it at a time, unless the library is safe.
/// Nothing that waits for another task may run meanwhile.
[[nodiscard]] std::unique_lock<std::mutex> blas_turn();

}   // namespace meshfolio
