#pragma once
/// \file
/// What the commands that measure a project share.

#include "app/terminal.hpp"
#include "base/turning.hpp"
#include "document/chain.hpp"

#include <string>

namespace CLI {
class App;
}

namespace axil::app {

void addProject(CLI::App& sub, std::string& project);
void addLiteral(CLI::App& sub, TurningRule& turning);

/// Runs `chain` on an open project and prints what it gives as `text` says.
template <class Chain, class Print>
int printed(const std::string& project, const document::ChainOptions& options, Chain chain, Print text) {
  const auto open = document::loadProject(project);
  if (!open) return report(open.error());
  const auto value = chain(*open, options);
  return value ? print(text(*value)) : report(value.error());
}

}  // namespace axil::app
