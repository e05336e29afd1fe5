// Files packed by gzip: any bytes are refused with one line, or give a mesh that is the same after writing and reading.
#include "fuzz/mesh_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace meshfolio;
    fuzzing::read_any_mesh(parse_mesh, "fuzz.obj.gz", fuzzing::text_of(bytes, size));
    return 0;
}
