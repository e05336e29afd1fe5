#include "fuzz/mesh_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace meshfolio;
    fuzzing::read_any_mesh(parse_vtp, "fuzz.vtp", fuzzing::text_of(bytes, size));
    return 0;
}
