#include "cli/cli.h"
#include "cli/signals.h"

int main(int argc, char** argv) {
    meshfolio::cli::prepare_process();
    return meshfolio::cli::run(argc, argv);
}
