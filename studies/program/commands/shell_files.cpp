#include "studies/program/commands/shell_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>
#include <vector>

#include "studies/program/answers/version.hpp"

namespace dovetail::studies {
namespace {

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

std::vector<const CLI::Option*> options_of(const CLI::App& command, bool named) {
  std::vector<const CLI::Option*> found;
  for (const CLI::Option* option : command.get_options())
    if (option->nonpositional() == named) found.push_back(option);
  return found;
}

/// "-o" and "--output".
std::vector<std::string> spellings(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

/// What a value may be, as the check of the option has it: "{a,b}" behind the name of its type.
std::vector<std::string> choices(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t begin = type.find('{'), end = type.find('}');
  std::vector<std::string> words;
  if (begin == type.npos || end == type.npos) return words;
  std::istringstream list(type.substr(begin + 1, end - begin - 1));
  for (std::string word; std::getline(list, word, ',');) words.push_back(word);
  return words;
}

std::string type_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  return type.substr(0, type.find(':'));
}

bool takes_value(const CLI::Option& option) {
  return option.get_items_expected_max() > 0;
}

std::string replaced_all(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != text.npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

/// Text of a manual: what roff would take for itself is escaped.
std::string roff(std::string text) {
  text = replaced_all(replaced_all(std::move(text), "\\", "\\e"), "-", "\\-");
  std::string lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    lines += (line.starts_with(".") || line.starts_with("'") ? "\\&" : "") + line + "\n";
  return lines;
}

}  // namespace

std::string bash_completion(const CLI::App& app) {
  std::string names, cases;
  for (const CLI::App* command : commands_of(app)) {
    names += (names.empty() ? "" : " ") + command->get_name();
    std::string words, values;
    for (const CLI::Option* option : options_of(*command, true)) {
      words += fmt::format("{}{}", words.empty() ? "" : " ", fmt::join(spellings(*option), " "));
      const std::vector<std::string> of = choices(*option);
      if (!of.empty())
        values += fmt::format("        {}) words=\"{}\" ;;\n", fmt::join(spellings(*option), "|"), fmt::join(of, " "));
    }
    cases += fmt::format("    {})\n      words=\"{}\"\n", command->get_name(), words);
    if (!values.empty()) cases += "      case \"$before\" in\n" + values + "      esac\n";
    cases += "      ;;\n";
  }
  return "# Completes dovetail in bash.\n_dovetail() {\n  local word=\"${COMP_WORDS[COMP_CWORD]}\" "
         "before=\"${COMP_WORDS[COMP_CWORD-1]}\" words=\"\"\n  if [ \"$COMP_CWORD\" = 1 ]; then\n    "
         "COMPREPLY=($(compgen -W \"" +
         names + " --help --version\" -- \"$word\"))\n    return\n  fi\n  case \"${COMP_WORDS[1]}\" in\n" + cases +
         "  esac\n  case \"$words\" in -*) case \"$word\" in -*) ;; *) return ;; esac ;; esac\n"
         "  COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n}\ncomplete -o default -F _dovetail dovetail "
         "dovetail-mpi\n";
}

std::string zsh_completion(const CLI::App& app) {
  // What separates the parts of a specification is escaped in its text.
  const auto plain = [](std::string text) {
    for (const char* mark : {"[", "]", ":"}) text = replaced_all(text, mark, std::string("\\") + mark);
    return replaced_all(replaced_all(std::move(text), "'", "'\\''"), "\n", " ");
  };
  std::string names, cases;
  for (const CLI::App* command : commands_of(app)) {
    names += fmt::format("    '{}:{}'\n", command->get_name(), plain(command->get_description()));
    cases += fmt::format("    {})\n      _arguments", command->get_name());
    for (const CLI::Option* option : options_of(*command, true))
      for (const std::string& name : spellings(*option)) {
        cases += fmt::format(" \\\n        '*{}[{}]", name, plain(option->get_description()));
        const std::vector<std::string> of = choices(*option);
        if (takes_value(*option))
          cases += fmt::format(":{}:{}", plain(type_of(*option)),
                               of.empty() ? "_files" : fmt::format("({})", fmt::join(of, " ")));
        cases += "'";
      }
    cases += " \\\n        '*:file:_files'\n      ;;\n";
  }
  return "#compdef dovetail dovetail-mpi\n_dovetail() {\n  local -a commands\n  commands=(\n" + names +
         "  )\n  if (( CURRENT == 2 )); then\n    _describe command commands\n    return\n  fi\n  local "
         "command=$words[2]\n"
         "  shift words\n  (( CURRENT-- ))\n  case $command in\n" +
         cases + "  esac\n}\n_dovetail \"$@\"\n";
}

std::string manual_page(const CLI::App& app) {
  std::string text = fmt::format(
      ".TH DOVETAIL 1 \"\" \"dovetail {}\"\n.SH NAME\ndovetail \\- optimises dovetail joints "
      "against fretting wear\n.SH SYNOPSIS\n.B dovetail\n.I COMMAND\n[OPTIONS]\n.SH "
      "DESCRIPTION\n.nf\n",
      version());
  text += roff(app.get_description()) + ".fi\n.SH COMMANDS\n";
  for (const CLI::App* command : commands_of(app)) {
    text += ".SS dovetail " + roff(command->get_name());
    text += roff(command->get_description()) + ".\n";
    for (const bool named : {false, true})
      for (const CLI::Option* option : options_of(*command, named)) {
        const std::string name = named ? fmt::format("{}", fmt::join(spellings(*option), ", ")) : option->get_name();
        text += ".TP\n\\fB" + replaced_all(name, "-", "\\-") + "\\fR";
        if (named && takes_value(*option)) text += " " + replaced_all(type_of(*option), "-", "\\-");
        text += "\n" + roff(option->get_description());
      }
    if (!command->get_footer().empty()) text += ".PP\n" + roff(command->get_footer());
  }
  return text + ".SH EXIT STATUS\n" + roff(app.get_footer());
}

}  // namespace dovetail::studies
