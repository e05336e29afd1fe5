#include "cli/cli.h"
#include "run/console.h"

int main(int argc, char** argv) {
    meshfolio::cli::prepare_process();
    return meshfolio::run::close_standard_output(meshfolio::cli::run(argc, argv));
}
