// A zip from a student: any bytes are refused with one line, or give files of our endings with plain relative paths, within the limits.
#include <filesystem>

#include "base/errors.h"
#include "fuzz/fuzz_input.h"
#include "submission/handed_in.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace meshfolio;
    const submission::HandInLimits limits{.most_entries = 20, .largest_file = 4096, .largest_total = 8192, .ratio_from = 1024};
    submission::HandedIn files;
    try {
        files = submission::unpacked(fuzzing::text_of(bytes, size), "fuzz.zip", limits);
    } catch (const InputError& error) {
        fuzzing::require(std::string_view(error.what()).find('\n') == std::string_view::npos, "an error is one line");
        return 0;
    }
    std::uintmax_t total = 0;
    for (const auto& [path, content] : files) {
        const std::filesystem::path relative(path);
        fuzzing::require(relative.is_relative() && relative.lexically_normal() == relative, "a plain relative path");
        fuzzing::require(*relative.begin() != "..", "within its folder");
        fuzzing::require(content.size() <= limits.largest_file, "no file is larger than it may be");
        total += content.size();
    }
    fuzzing::require(total <= limits.largest_total, "nor are all together");
    return 0;
}
