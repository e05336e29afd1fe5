/// @file
/// The command line: arguments in, exit code out; and the process around it.
#pragma once

namespace meshfolio::cli {

/// Runs the command that the arguments name: `help` if there are none, `report` if there are only options. Returns the exit code; prints an
/// error as one line on stderr.
int run(int argc, const char* const* argv);

/// Prepares the process. To be called first, before any thread begins:
/// - keeps freed memory for later allocations;
/// - opens closed standard descriptors, so that no output file gets their number; writing to standard output still fails then;
/// - makes writes fail instead of SIGPIPE and SIGXFSZ ending the process, see end_by_broken_pipe();
/// - ends the process cleanly, with exit code 1, after an exception that cannot be caught;
/// - on SIGINT, SIGTERM and SIGHUP ends child processes, removes everything unpublished and ends the process with 128 + signal; a SIGHUP
///   that nohup ignores stays ignored.
void prepare_process();

/// Ends the process quietly, as SIGPIPE would have done: `meshfolio curvature m.obj | head -1`.
[[noreturn]] void end_by_broken_pipe();

}   // namespace meshfolio::cli
