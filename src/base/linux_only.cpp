#include "base/linux_only.h"

#include <sys/stat.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>

#ifdef MESHFOLIO_PORTABLE
#include <dlfcn.h>
#else
#include <fcntl.h>
#include <link.h>
#include <linux/stat.h>
#include <malloc.h>
#include <sys/mman.h>
#include <sys/prctl.h>

extern "C" {
#include <sys/pidfd.h>   // glibc 2.36 lacks the extern "C"
}
#endif

namespace meshfolio {

namespace fs = std::filesystem;

namespace {

bool is_on_another_device(const fs::path& folder) {
    struct stat inside {};
    struct stat outside {};
    if (::stat(folder.c_str(), &inside) != 0 || ::stat((folder / "..").c_str(), &outside) != 0) return false;
    return inside.st_dev != outside.st_dev;
}

}   // namespace

#ifndef MESHFOLIO_PORTABLE

fs::path this_program() { return "/proc/self/exe"; }

std::vector<std::string> loaded_libraries() {
    std::vector<std::string> names;
    const auto add = [](dl_phdr_info* info, std::size_t, void* list) {
        if (info->dlpi_name != nullptr) static_cast<std::vector<std::string>*>(list)->emplace_back(info->dlpi_name);
        return 0;
    };
    ::dl_iterate_phdr(add, &names);
    return names;
}

int rename_with(const fs::path& from, const fs::path& to, Taken taken) {
    const unsigned flags = taken == Taken::kept ? RENAME_NOREPLACE : taken == Taken::exchanged ? RENAME_EXCHANGE : 0;
    return ::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), flags) == 0 ? 0 : errno;
}

int descriptor_of(pid_t process) { return ::pidfd_open(process, 0); }

void ask_for_signal_of_parent(int signal) { static_cast<void>(::prctl(PR_SET_PDEATHSIG, signal)); }

void prefer_large_pages(void* begin, std::size_t bytes) {
    constexpr std::size_t page = 4096, worth_it = std::size_t{2} << 20;
    if (bytes < worth_it) return;
    const std::size_t to_page = (page - reinterpret_cast<std::uintptr_t>(begin) % page) % page;
    ::madvise(static_cast<char*>(begin) + to_page, (bytes - to_page) / page * page, MADV_HUGEPAGE);
}

void return_free_memory() {
    constexpr std::size_t worth_it = std::size_t{64} << 20;
    if (::mallinfo2().fordblks > worth_it) ::malloc_trim(0);
}

bool is_mount_point(const fs::path& folder) {
    struct statx status {};
    if (::statx(AT_FDCWD, folder.c_str(), AT_SYMLINK_NOFOLLOW, STATX_BASIC_STATS, &status) != 0) return false;
    if (status.stx_attributes_mask & STATX_ATTR_MOUNT_ROOT) return (status.stx_attributes & STATX_ATTR_MOUNT_ROOT) != 0;
    return is_on_another_device(folder);
}

#else

fs::path this_program() {
    Dl_info place{};
    std::error_code error;
    if (::dladdr(reinterpret_cast<const void*>(&this_program), &place) == 0 || place.dli_fname == nullptr) return {};
    return fs::absolute(place.dli_fname, error);
}

std::vector<std::string> loaded_libraries() { return {}; }

int rename_with(const fs::path& from, const fs::path& to, Taken taken) {
    if (taken != Taken::replaced) return EINVAL;
    return std::rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
}

int descriptor_of(pid_t) { return -1; }

void ask_for_signal_of_parent(int) {}

void prefer_large_pages(void*, std::size_t) {}

void return_free_memory() {}

bool is_mount_point(const fs::path& folder) { return is_on_another_device(folder); }

#endif

}   // namespace meshfolio
