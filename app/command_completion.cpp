#include "app/commands.hpp"
#include "app/terminal.hpp"

#include <CLI/CLI.hpp>

#include <vector>

namespace axil::app {

namespace {

struct Option {
  std::string name;
  std::string what;
};
struct Command {
  std::string name;
  std::string what;
  std::vector<Option> options;
};

std::vector<Command> commandsOf(const CLI::App& app) {
  std::vector<Command> commands;
  for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; })) {
    Command command{sub->get_name(), sub->get_description(), {}};
    for (const CLI::Option* option : sub->get_options())
      for (const std::string& name : option->get_lnames()) command.options.push_back({"--" + name, option->get_description()});
    commands.push_back(std::move(command));
  }
  return commands;
}

std::string joined(const std::vector<Option>& options) {
  std::string text;
  for (const Option& option : options) text += (text.empty() ? "" : " ") + option.name;
  return text;
}

// Single quotes of shells: a quote inside closes, escapes itself and opens again.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

std::string bashScript(const std::vector<Command>& commands) {
  std::string names, cases;
  for (const Command& command : commands) {
    names += (names.empty() ? "" : " ") + command.name;
    cases += "    " + command.name + ") words='" + joined(command.options) + "' ;;\n";
  }
  return "# Completion of axil for bash.\n_axil() {\n  local word=${COMP_WORDS[COMP_CWORD]} words=\n  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
         "    mapfile -t COMPREPLY < <(compgen -W '" + names + " --help --version' -- \"$word\")\n    return\n  fi\n  case ${COMP_WORDS[1]} in\n" + cases +
         "  esac\n  if [[ $word == -* ]]; then mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\")\n"
         "  else mapfile -t COMPREPLY < <(compgen -f -- \"$word\"); fi\n}\ncomplete -o filenames -F _axil axil\n";
}

std::string zshScript(const std::vector<Command>& commands) {
  std::string names, cases;
  for (const Command& command : commands) {
    names += "    " + quoted(command.name + ":" + command.what) + "\n";
    cases += "    " + command.name + ") compadd -- " + joined(command.options) + "; _files ;;\n";
  }
  return "#compdef axil\n_axil() {\n  local -a commands=(\n" + names + "  )\n  if (( CURRENT == 2 )); then _describe command commands; return; fi\n  case $words[2] in\n" +
         cases + "  esac\n}\n_axil \"$@\"\n";
}

std::string fishScript(const std::vector<Command>& commands) {
  std::string text = "# Completion of axil for fish.\n";
  for (const Command& command : commands) {
    text += "complete -c axil -n __fish_use_subcommand -f -a " + command.name + " -d " + quoted(command.what) + "\n";
    for (const Option& option : command.options)
      text += "complete -c axil -n '__fish_seen_subcommand_from " + command.name + "' -l " + option.name.substr(2) + " -d " + quoted(option.what) + "\n";
  }
  return text;
}

std::string completionScript(const CLI::App& app, const std::string& shell) {
  const std::vector<Command> commands = commandsOf(app);
  if (shell == "zsh") return zshScript(commands);
  return shell == "fish" ? fishScript(commands) : bashScript(commands);
}

}  // namespace

// Made from the commands themselves, so that it never lags behind them.
void addCompletion(CLI::App& sub, int& status) {
  addExamples(sub, "  axil completion bash > ~/.local/share/bash-completion/completions/axil\n"
                   "  axil completion zsh > ~/.zfunc/_axil\n  axil completion fish > ~/.config/fish/completions/axil.fish");
  auto shell = std::make_shared<std::string>();
  sub.add_option("SHELL", *shell, "bash, zsh or fish")->required()->check(CLI::IsMember({"bash", "zsh", "fish"}));
  sub.callback([shell, &sub, &status] { status = print(completionScript(*sub.get_parent(), *shell)); });
}

}  // namespace axil::app
