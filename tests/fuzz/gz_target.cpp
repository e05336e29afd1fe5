// What gzip has packed: any bytes are refused with one line, or are a mesh that is the same when written and read.
#include "fuzz/mesh_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace meshfolio;
    fuzzing::read_any_mesh(parse_mesh, "fuzz.obj.gz", fuzzing::text_of(bytes, size));
    return 0;
}
