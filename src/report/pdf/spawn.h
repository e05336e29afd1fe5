/// @file
/// How another program begins.
#pragma once

#include <sys/types.h>

#include "report/pdf/child_process.h"

namespace meshfolio::report {

/// Starts the program in a group of its own, with no signal blocked or ignored, no input, both streams into `output`, and `channel`, unless
/// it is -1, as its descriptors 3 and 4. @return errno, or 0 with the number of the process
int spawn(const ChildTask& task, int output, int channel, pid_t& process);

}   // namespace meshfolio::report
