#include "app/project_options.hpp"

#include <CLI/CLI.hpp>

namespace axil::app {

void addProject(CLI::App& sub, std::string& project) { sub.add_option("PROJECT", project, "A project file, NAME.axil")->required(); }

void addLiteral(CLI::App& sub, TurningRule& turning) {
  sub.add_flag_callback("--literal", [&turning] { turning = TurningRule::Literal; },
                        "Turn branches by the thesis' literal rule (for old files; rotr is then not the angle at the fork)");
}

}  // namespace axil::app
