#pragma once
/// \file
/// Commands that need heavy libraries live in programs of their own, beside this one; see docs/decisions/start.md.

namespace axil::app {

/// Goes on as `program` with the same arguments; comes back only where that is not possible, with exit status 1 and a message.
/// It is looked for beside this program, then in ../libexec/axil.
int handOver(const char* program, char** argv);

}  // namespace axil::app
