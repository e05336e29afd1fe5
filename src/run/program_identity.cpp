#include "run/program_identity.h"

#include <link.h>
#include <sys/stat.h>

#include <fstream>
#include <set>
#include <string_view>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "base/sha256.h"
#include "output/cache/result_cache.h"
#include "run/arguments.h"

namespace meshfolio::run {

namespace {

int add_library(dl_phdr_info* info, std::size_t, void* key) {
    struct stat status {};
    if (info->dlpi_name == nullptr || ::stat(info->dlpi_name, &status) != 0) return 0;   // the program itself, the kernel's page
    static_cast<output::KeyMaker*>(key)
        ->add(info->dlpi_name)
        .add(std::to_string(status.st_size))
        .add(std::to_string(status.st_mtim.tv_sec) + "." + std::to_string(status.st_mtim.tv_nsec));
    return 0;
}

/// The first line of each kind that identifies the processor.
void add_processor(output::KeyMaker& key) {
    std::ifstream file("/proc/cpuinfo");
    std::set<std::string> seen;
    for (std::string line; std::getline(file, line);) {
        const std::string name = line.substr(0, line.find('\t'));
        const bool tells = name == "vendor_id" || name == "cpu family" || name == "model" || name == "model name" || name == "flags" ||
                           name == "CPU part" || name == "Features";
        if (tells && seen.insert(name).second) key.add(line);
    }
}

std::string made() try {
    output::KeyMaker key;
    key.add(sha256_of_file("/proc/self/exe"));
    ::dl_iterate_phdr(add_library, &key);
    add_processor(key);
    for (const char* name : {"OPENBLAS_CORETYPE", "GLIBC_TUNABLES", "LD_PRELOAD"}) key.add(environment(name));
    return key.key();
} catch (const InputError&) {
    return "";
}

}   // namespace

const std::string& program_identity() {
    static const std::string identity = made();
    return identity;
}

}   // namespace meshfolio::run
