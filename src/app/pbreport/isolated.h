/// Runs what reads files in a process of its own, so that a file which makes a library crash ends in a
/// message.
#pragma once

#include <functional>

namespace pbmpi::app {

/// The exit code of `work`, which runs in a child of this process; bad_input, after a message on stderr, if a
/// signal that stands for a crash (SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT) ended it. Another signal that
/// ended the child ends this process, too. Where no child can be started `work` runs in this process.
int run_isolated(const std::function<int()>& work);

}  // namespace pbmpi::app
