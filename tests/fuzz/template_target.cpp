// Templates: any text has a syntax problem with its line, or is evaluated against a model: printed, or refused for a tag nobody knows.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "fuzz/fuzz_input.h"
#include "report/template_render.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace meshfolio;
    const std::string text(fuzzing::text_of(bytes, size));
    const auto problem = report::syntax_problem(text);
    if (problem) {
        const long lines = 1 + std::count(text.begin(), text.end(), '\n');
        fuzzing::require(problem->line >= 0 && problem->line <= lines, "a problem lies within the text");
    }
    return 0;
}
