/// Reads files in a separate process, so that a file which crashes a library ends in a message.
#pragma once

#include <functional>

namespace pbmpi::app {

/// Runs `work` in a child process and returns its exit code; bad_input, after a message on stderr, if a
/// signal that stands for a crash (SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT) ended it. Another signal that
/// ended the child ends this process, too. If no child can be started, `work` runs in this process.
int run_isolated(const std::function<int()>& work);

}  // namespace pbmpi::app
