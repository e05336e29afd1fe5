/// @file
/// What only Linux has, in one place. Elsewhere, and with -DMESHFOLIO_PORTABLE=ON on Linux too, each does what POSIX can.
/// Files of /proc and /sys are read where they exist, and are no part of this.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#if !defined(__linux__) && !defined(MESHFOLIO_PORTABLE)
#define MESHFOLIO_PORTABLE
#endif

namespace meshfolio {

/// The file of this very program, also where another has taken its name. Elsewhere the file it was started from.
std::filesystem::path this_program();

/// The libraries that were loaded with it. Elsewhere none.
std::vector<std::string> loaded_libraries();

/// What becomes of a name that is taken: it is replaced, EEXIST, or both change places.
enum class Taken { replaced, kept, exchanged };
/// @return 0 or errno. Elsewhere EINVAL for all but `replaced`, as of a file system that cannot
int rename_with(const std::filesystem::path& from, const std::filesystem::path& to, Taken taken);

/// True where another file system (or a bind mount) begins: such a folder cannot be renamed. Elsewhere bind mounts are not seen.
bool is_mount_point(const std::filesystem::path& folder);

/// A descriptor to poll until the process has ended. Elsewhere, and in old kernels, -1.
int descriptor_of(pid_t process);

/// The signal comes to this process when its parent ends. Elsewhere it does not.
void ask_for_signal_of_parent(int signal);

/// Large pages (base/large_pages.h), to be asked for before the memory is written to. Only a hint; elsewhere nothing happens.
void prefer_large_pages(void* begin, std::size_t bytes);

/// Gives the system back what is free in the heap between what is in use, where that is much. Elsewhere nothing happens.
void return_free_memory();

/// In front of a pointer to a function that the loader calls before it initialises any library. Elsewhere nobody calls it.
#ifndef MESHFOLIO_PORTABLE
#define MESHFOLIO_BEFORE_LIBRARIES [[gnu::section(".preinit_array"), gnu::used]]
#else
#define MESHFOLIO_BEFORE_LIBRARIES [[maybe_unused]]
#endif

}   // namespace meshfolio
