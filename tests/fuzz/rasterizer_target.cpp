// One triangle of any size and place covers just the samples that exact arithmetic says, by the fast path and the wide one.
#include "fuzz/fuzz_input.h"
#include "render/raster/coverage_reference.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace render_tests;
    using meshfolio::fuzzing::require;
    meshfolio::fuzzing::Bytes input(bytes, size);
    const int bits = 8 + input.take<std::uint8_t>() % 33;   // reach, in grid steps
    const int phase = input.take<std::uint8_t>() % 241;     // a few of the samples at a time: the reference is slow
    Triangle2 t;
    for (ScreenPoint& p : t.corner) {
        const std::int64_t reach = std::int64_t{1} << bits;
        p.x = left + side / 2 + input.take<std::int64_t>() % reach;
        p.y = top + side / 2 + input.take<std::int64_t>() % reach;
        p.depth = input.take<std::int16_t>();
    }
    const std::uint8_t choice = input.take<std::uint8_t>();
    const bool everything = size > 60;   // asked for by the length: all samples, by all paths
    for (const int samples : {1, 4}) {
        for (const bool wide : {false, true}) {
            if (!everything && choice % 4 != (samples == 4 ? 2 : 0) + (wide ? 1 : 0)) continue;
            const SampleTile tile = wide ? drawn_wide({t}, samples) : drawn({t}, samples);
            require(disagreements(t, tile, everything ? 1 : 241, everything ? 0 : phase) == 0, "coverage is exact");
        }
    }
    return 0;
}
