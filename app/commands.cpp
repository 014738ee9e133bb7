#include "app/commands.hpp"

#include <CLI/CLI.hpp>

#include <string>
#include <utility>

namespace axil::app {

void setCallback(CLI::App& sub, std::function<void()> call) { sub.callback(std::move(call)); }

void addExamples(CLI::App& sub, const char* examples) { sub.footer(std::string("Examples:\n") + examples); }

}  // namespace axil::app
