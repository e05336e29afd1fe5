#include "run/program_identity.h"

#include <sys/stat.h>

#include <fstream>
#include <set>
#include <string_view>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "base/linux_only.h"
#include "base/sha256.h"
#include "output/cache/result_cache.h"
#include "run/arguments.h"

namespace meshfolio::run {

namespace {

void add_library(output::KeyMaker& key, const std::string& name) {
    struct stat status {};
    if (::stat(name.c_str(), &status) != 0) return;   // the program itself, the kernel's page
    key.add(name)
        .add(std::to_string(status.st_size))
        .add(std::to_string(status.st_mtim.tv_sec) + "." + std::to_string(status.st_mtim.tv_nsec));
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
    key.add(sha256_of_file(this_program()));
    for (const std::string& name : loaded_libraries()) add_library(key, name);
    add_processor(key);
    for (const char* name : {"GLIBC_TUNABLES", "LD_PRELOAD"}) key.add(environment(name));
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
