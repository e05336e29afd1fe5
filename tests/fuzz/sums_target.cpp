// SHA256SUMS: any bytes are refused with one line, or list the same files when written as sha256sum would.
#include "base/errors.h"
#include "fuzz/fuzz_input.h"
#include "output/publish/publish.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace meshfolio;
    std::map<std::string, output::FileSum> sums;
    try {
        sums = output::parse_sums(std::string(fuzzing::text_of(bytes, size)), "SHA256SUMS");
    } catch (const InputError& error) {
        fuzzing::require(std::string_view(error.what()).find('\n') == std::string_view::npos, "an error is one line");
        return 0;
    }
    std::string again;
    for (const auto& [path, sum] : sums) again += sum.digest + "  " + path + "\n";
    const auto read = output::parse_sums(again, "again");
    fuzzing::require(read.size() == sums.size(), "as many files");
    for (const auto& [path, sum] : sums) fuzzing::require(read.at(path).digest == sum.digest, "a digest survives writing and reading");
    return 0;
}
