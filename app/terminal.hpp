#pragma once
/// \file
/// Words for the person at the terminal, all on stderr, so that stdout carries data alone.

#include "base/progress.hpp"
#include "base/result.hpp"

#include <string>

namespace axil::app {

/// Prints an error and its details; gives the exit status 1.
int report(const Error& error);
/// Writes data to stdout; gives the exit status (1 where stdout is closed or full).
int print(const std::string& data);

/// Reports progress once the work has gone on for a second: a line that renews itself on a terminal, a line every two
/// seconds elsewhere. Ctrl+C, a closed terminal and a polite kill cancel the work, so that what is half
/// done is cleaned up.
[[nodiscard]] Watch terminalWatch();
/// Clears the renewing line.
void endProgress();

}  // namespace axil::app
