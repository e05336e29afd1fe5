/// @file
/// How much memory a piece of work takes at most, from the kernel's account of this process (Linux; 0 elsewhere).
#pragma once

#include <malloc.h>

#include <fstream>
#include <string>

namespace bench {

/// A line of /proc/self/status, as "VmHWM" [bytes].
inline double memory_status(const std::string& name) {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with(name + ":")) return 1024 * std::stod(line.substr(name.size() + 1));
    return 0;
}

/// Most resident memory while `work` ran, above that before it [bytes].
template <class Work> double peak_memory_of(const Work& work) {
    malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << 5;   // the high-water mark starts again from here
    const double before = memory_status("VmRSS");
    work();
    return memory_status("VmHWM") - before;
}

}   // namespace bench
