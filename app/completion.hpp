#pragma once
/// \file
/// Shell completion, made from the commands themselves, so that it never lags behind them.

#include <string>

namespace CLI {
class App;
}

namespace axil::app {

/// The completion script of `shell` (bash, zsh or fish) for `app` and its subcommands.
[[nodiscard]] std::string completionScript(const CLI::App& app, const std::string& shell);

}  // namespace axil::app
