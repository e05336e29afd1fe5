// results.json: any bytes are refused with one line, or are a document that is the same after being written and read again.
#include "base/errors.h"
#include "fuzz/fuzz_input.h"
#include "report/json/read_json.h"
#include "report/writers.h"

namespace {

using namespace meshfolio;

std::string written(const report::ReadReport& read) { return report::write_json(read.document, read.figures, {.timings = read.timings}); }

}   // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    report::ReadReport read;
    try {
        read = report::read_json(fuzzing::text_of(bytes, size), "fuzz.json");
    } catch (const InputError& error) {
        fuzzing::require(std::string_view(error.what()).find('\n') == std::string_view::npos, "an error is one line");
        return 0;
    }
    const std::string once = written(read);
    fuzzing::require(written(report::read_json(once, "again.json")) == once, "a document survives writing and reading");
    return 0;
}
