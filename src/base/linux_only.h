/// @file
/// Functions that need Linux. Without it, and with -DMESHFOLIO_PORTABLE=ON, each does what POSIX can. (Code that reads /proc and /sys where
/// they exist is not collected here.)
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

/// Returns a path to the running program, even if another file has taken its name. Without Linux: the file from which it was started.
std::filesystem::path this_program();

/// Returns the paths of the shared libraries of this process. Without Linux: none.
std::vector<std::string> loaded_libraries();

/// The treatment of a target name that exists: the old file is replaced, kept (EEXIST), or exchanged with the new one.
enum class Taken { replaced, kept, exchanged };
/// Renames a file. Returns 0 or errno: EINVAL if the file system cannot treat `to` as asked, and without Linux for all but `replaced`.
int rename_with(const std::filesystem::path& from, const std::filesystem::path& to, Taken taken);

/// True if another file system or a bind mount begins at the folder, which therefore cannot be renamed. Without Linux, bind mounts are
/// missed.
bool is_mount_point(const std::filesystem::path& folder);

/// Returns a descriptor that becomes readable when the process ends. Without Linux, and with old kernels: -1.
int descriptor_of(pid_t process);

/// Has the system send this process the signal when its parent ends. Without Linux: does nothing.
void ask_for_signal_of_parent(int signal);

/// Asks for large pages, in which large arrays take a fraction of the time to write for the first time and to read in random order. To be
/// called before the memory is first written. A hint, for 2 MB or more; without Linux: does nothing.
void prefer_large_pages(void* begin, std::size_t bytes);

/// Returns `size` zeros in large pages.
template <class T> std::vector<T> large_vector(std::size_t size) {
    std::vector<T> values;
    values.reserve(size);
    prefer_large_pages(values.data(), size * sizeof(T));
    values.resize(size);
    return values;
}

/// Returns free heap memory to the system if it is more than 64 MB. Without Linux: does nothing.
void return_free_memory();

/// Marks a pointer to a function that the loader calls before it initialises any library. Without Linux, it is not called.
#ifndef MESHFOLIO_PORTABLE
#define MESHFOLIO_BEFORE_LIBRARIES [[gnu::section(".preinit_array"), gnu::used]]
#else
#define MESHFOLIO_BEFORE_LIBRARIES [[maybe_unused]]
#endif

}   // namespace meshfolio
