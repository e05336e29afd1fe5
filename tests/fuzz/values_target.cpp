// The values of `render --values`: any bytes are refused with one line, or are one value a vertex that is the same when written and read.
#include <bit>
#include <cmath>

#include "base/errors.h"
#include "base/number_text.h"
#include "run/one_mesh/fields.h"
#include "fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace meshfolio;
    if (size == 0) return 0;
    const Eigen::Index rows = bytes[0] % 8;
    Vector values;
    try {
        values = run::csv_column(fuzzing::text_of(bytes + 1, size - 1), "fuzz.csv", "h", rows);
    } catch (const InputError& error) {
        fuzzing::require(std::string_view(error.what()).find('\n') == std::string_view::npos, "an error is one line");
        return 0;
    }
    fuzzing::require(values.size() == rows, "one value a vertex");
    std::string again = "h\n";
    for (const double x : values) again += (std::isnan(x) ? "" : exact_text(x)) + "\n";
    const Vector read = run::csv_column(again, "again.csv", "h", rows);
    for (Eigen::Index v = 0; v < rows; ++v) {
        fuzzing::require(!std::isinf(values[v]), "values are finite");
        const bool same = std::bit_cast<std::uint64_t>(values[v]) == std::bit_cast<std::uint64_t>(read[v]);
        fuzzing::require(same || (std::isnan(values[v]) && std::isnan(read[v])), "values survive writing and reading");
    }
    return 0;
}
