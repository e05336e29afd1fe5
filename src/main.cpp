#include "cli/cli.h"
#include "cli/console.h"
#include "cli/signals.h"

int main(int argc, char** argv) {
    meshfolio::cli::prepare_process();
    return meshfolio::cli::close_standard_output(meshfolio::cli::run(argc, argv));
}
