// Feeds a fuzz target, named on the command line, the files of the folders named after it: its seeds, and what once made it fail.
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string_view>
#include <utility>

#include "base/file_bytes.h"
#include "targets.h"   // all *_target.cpp

int main(int count, char** names) {
    namespace fs = std::filesystem;
    int replayed = 0;
    for (const auto& [name, target] : targets) {
        if (count < 2 || name != names[1]) continue;
        for (int i = 2; i < count; ++i) {
            if (!fs::is_directory(names[i])) continue;   // nothing has failed yet
            for (const fs::directory_entry& entry : fs::directory_iterator(names[i])) {
                const std::string bytes = meshfolio::read_file(entry.path());
                target(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
                ++replayed;
            }
        }
    }
    std::printf("%d inputs\n", replayed);
    return replayed > 0 ? 0 : 1;
}
