#include "cli/cli.h"

int main(int argc, char** argv) { return meshfolio::cli::run(argc, argv); }
