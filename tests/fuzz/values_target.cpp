// The values of `render --values` and `mark`: any bytes are refused with one line, or are one value a row that is the same when written
// and read.
#include <bit>
#include <cmath>

#include "base/errors.h"
#include "base/number_text.h"
#include "fuzz/fuzz_input.h"
#include "mesh/io/csv_column.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace meshfolio;
    if (size == 0) return 0;
    const Eigen::Index rows = bytes[0] % 8;
    NumberColumn column;
    try {
        column = csv_column(fuzzing::text_of(bytes + 1, size - 1), "fuzz.csv", {"h", "x"}, rows);
    } catch (const InputError& error) {
        fuzzing::require(std::string_view(error.what()).find('\n') == std::string_view::npos, "an error is one line");
        return 0;
    }
    const Vector& values = column.values;
    fuzzing::require(values.size() == rows && column.rounding.size() == rows, "one value a row");
    std::string again = "h\n";
    for (const double x : values) again += (std::isnan(x) ? "" : exact_text(x)) + "\n";
    const Vector read = csv_column(again, "again.csv", {"h"}, rows).values;
    for (Eigen::Index v = 0; v < rows; ++v) {
        fuzzing::require(!std::isinf(values[v]), "values are finite");
        fuzzing::require(column.rounding[v] >= 0, "rounding is a length");
        const bool same = std::bit_cast<std::uint64_t>(values[v]) == std::bit_cast<std::uint64_t>(read[v]);
        fuzzing::require(same || (std::isnan(values[v]) && std::isnan(read[v])), "values survive writing and reading");
    }
    return 0;
}
