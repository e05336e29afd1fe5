// Settings files: any bytes are read, or refused with errors that each are one line.
#include "fuzz/fuzz_input.h"
#include "run/settings/report_settings.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace meshfolio;
    try {
        run::parse_settings(fuzzing::text_of(bytes, size), "fuzz.toml");
    } catch (const run::SettingsErrors& errors) {
        fuzzing::require(!errors.problems().empty(), "a refusal has a reason");
        for (const UsageError& problem : errors.problems()) {
            fuzzing::require(std::string_view(problem.what()).find('\n') == std::string_view::npos, "an error is one line");
        }
    }
    return 0;
}
