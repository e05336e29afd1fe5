// Feeds a fuzz target the files of the folders named on the command line: its seeds, and what once made it fail.
#include <cstdint>
#include <cstdio>
#include <filesystem>

#include "base/errors.h"
#include "base/file_bytes.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size);

int main(int count, char** names) {
    namespace fs = std::filesystem;
    int replayed = 0;
    for (int i = 1; i < count; ++i) {
        if (!fs::is_directory(names[i])) continue;   // nothing has failed yet
        for (const fs::directory_entry& entry : fs::directory_iterator(names[i])) {
            const std::string bytes = meshfolio::read_file(entry.path());
            LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
            ++replayed;
        }
    }
    std::printf("%d inputs\n", replayed);
    return replayed > 0 ? 0 : 1;
}
