#include <cstdint>

#include "cli/cli.h"
#include "run/console.h"

namespace hwy::platform {
/// In place of libhwy's own, which measures for 3 ms at every start; only its benchmarks, which nobody runs, ask for it.
std::uint64_t TimerResolution();
std::uint64_t TimerResolution() { return 1; }
}   // namespace hwy::platform

int main(int argc, char** argv) {
    meshfolio::cli::prepare_process();
    return meshfolio::run::close_standard_output(meshfolio::cli::run(argc, argv));
}
