/// @file
/// The command line: arguments in, exit code out; and the process around it.
#pragma once

namespace meshfolio::cli {

/// Runs the command that the arguments name (`help` when there are none, `report` when options alone are given). Every error becomes one
/// line on stderr and its exit code.
int run(int argc, const char* const* argv);

/// To be called first, before any thread begins:
/// - freed memory is kept for what is allocated next;
/// - standard descriptors that are closed are filled, so that no file of ours is opened in their place; writing to standard output
///   still fails then;
/// - SIGPIPE and SIGXFSZ no longer kill: the write fails and is reported, see end_by_broken_pipe();
/// - an exception that cannot be caught (no memory left while another is handled, say) ends the process in the same clean way, exit code 1;
/// - SIGINT, SIGTERM and SIGHUP kill the programs we run, remove everything unpublished and end the process with 128 + signal (130, 143,
/// 129); a SIGHUP that was ignored from the beginning, by nohup, stays so.
void prepare_process();

/// Ends the process quietly as SIGPIPE would have, once everything unpublished is removed: `meshfolio curvature m.obj | head -1`.
[[noreturn]] void end_by_broken_pipe();

}   // namespace meshfolio::cli
