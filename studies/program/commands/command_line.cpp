#include "studies/program/commands/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <functional>
#include <memory>
#include <ostream>
#include <sstream>
#include <system_error>
#include <type_traits>
#include <vector>

#include "core/options.hpp"
#include "studies/program/answers/version.hpp"
#include "studies/program/commands/commands.hpp"
#include "studies/program/commands/help.hpp"
#include "studies/program/commands/shell_files.hpp"
#include "studies/program/commands/told.hpp"

namespace dovetail::studies {
namespace {

/// Those of a list like 2,3. Throws CLI::ValidationError for anything else.
std::vector<int> whole_numbers(const std::string& option, const std::string& text) {
  std::vector<int> result;
  for (const char* at = text.data(); at != nullptr;) {
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(at, end, result.emplace_back());
    if (error == std::errc::result_out_of_range)
      throw CLI::ValidationError(option + " = " + text, "holds a number that is too large");
    if (error != std::errc() || (stop != end && *stop != ','))
      throw CLI::ValidationError(option + " = " + text, "must be whole numbers separated by commas");
    at = stop == end ? nullptr : stop + 1;
  }
  return result;
}

template <class S>
void add_option(CLI::App& command, S& options, const Option<S>& row) {
  CLI::Option* option = std::visit(
      [&]<class Member>(const Member& member) {
        if constexpr (std::is_same_v<Member, EnumMember<S>>) {
          const auto set = [&options, member](const std::string& word) { member.set(options, word); };
          return command.add_option_function<std::string>(row.name, set, row.help)
              ->type_name(std::string(row.type))
              ->check(CLI::IsMember(std::vector<std::string>(member.names().begin(), member.names().end())));
        } else if constexpr (std::is_same_v<Member, bool S::*>) {
          return command.add_flag(row.name, options.*member, row.help);
        } else if constexpr (std::is_same_v<Member, std::vector<int> S::*>) {
          const auto set = [&options, member, name = row.name](const std::string& text) {
            options.*member = whole_numbers(name, text);
          };
          return command.add_option_function<std::string>(row.name, set, row.help)->type_name(std::string(row.type));
        } else {
          using T = std::decay_t<decltype(options.*member)>;
          CLI::Option* added =
              command.add_option(row.name, options.*member, row.help)->type_name(std::string(row.type));
          // A named one is repeated; words without a name follow each other.
          if constexpr (std::is_same_v<T, std::vector<std::string>>)
            if (row.name.starts_with("-"))
              added->expected(row.values)
                  ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
                  ->allow_extra_args(false);
          return added;
        }
      },
      row.member);
  option->required(row.required);
  if (!row.choices.empty())
    option->check(CLI::IsMember(std::vector<std::string>(row.choices.begin(), row.choices.end())));
}

/// The command chosen, ready to run.
using Chosen = std::function<int(const Streams&)>;

/// A command with the options of its table; chosen, it checks them and runs.
template <class Options, class Run>
void add_command(CLI::App& app, Chosen& chosen, const CommandHelp& help, Run run) {
  CLI::App* command = app.add_subcommand(help.name, help.what);
  command->footer(help.footer);
  const auto options = std::make_shared<Options>();
  visit_options(*options, [&]<class S>(S& part, std::span<const Option<S>> table) {
    for (const Option<S>& row : table) add_option(*command, part, row);
  });
  command->callback([options, run, name = help.name, &chosen] {
    chosen = [options, run, name](const Streams& streams) {
      complaints(*options).raise();
      if constexpr (std::is_invocable_v<Run, const Options&, Teller&, const Streams&>)
        return told({.name = name}, options->tell, streams,
                    [&](Teller& teller) { return run(*options, teller, streams); });
      else
        return run(*options, streams);
    };
  });
}

void add_commands(CLI::App& app, Chosen& chosen, const PoolFactory& pools) {
  add_command<RunOptions>(app, chosen, help::run(), [pools](const RunOptions& options, const Streams& streams) {
    return run_study(options, streams, study_engine, pools);
  });
  add_command<EvaluateOptions>(app, chosen, help::evaluate(), run_evaluate);
  add_command<ReduceOptions>(app, chosen, help::reduce(), run_reduce);
  add_command<CheckOptions>(app, chosen, help::check(), run_check);
  add_command<NewOptions>(app, chosen, help::create(), run_new);
  add_command<MaterialsOptions>(app, chosen, help::materials(), run_materials);
  add_command<ResponseOptions>(app, chosen, help::response(), run_response);
  add_command<BackboneOptions>(app, chosen, help::backbone(), run_backbone);
  add_command<WearOptions>(app, chosen, help::wear(), run_wear);
  add_command<ImportOptions>(app, chosen, help::import_model(), run_import);
  add_command<ExportOptions>(app, chosen, help::export_files(), run_export);
  add_command<RunsOptions>(app, chosen, help::runs(), run_runs);
  add_command<ServeOptions>(app, chosen, help::serve(), run_serve);
  add_command<SchemaOptions>(app, chosen, help::schema(), run_schema);
  add_command<CompletionOptions>(app, chosen, help::completion(),
                                 [&app](const CompletionOptions& options, const Streams& streams) {
                                   streams.out << (options.file == ShellFile::bash  ? bash_completion(app)
                                                   : options.file == ShellFile::zsh ? zsh_completion(app)
                                                                                    : manual_page(app));
                                   return kDone;
                                 });
  add_command<MergeOptions>(app, chosen, help::merge(), run_merge);
  add_command<ReportOptions>(app, chosen, help::report(), run_report);
}

/// What to say of a first word that is no command; empty when it is one.
std::string unknown_command(const CLI::App& app, const std::string& word) {
  std::vector<std::string> commands;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    commands.push_back(command->get_name());
  if (std::find(commands.begin(), commands.end(), word) != commands.end()) return {};
  const std::string near = nearest(word, commands);
  return "unknown command " + one_line(word) + (near.empty() ? "" : "; did you mean " + near + "?");
}

/// Help and version are answers; everything else CLI11 complains about is one line. `word` is the first argument.
int parse_failure(const CLI::App& app, const CLI::ParseError& error, const std::string& word, const Streams& streams) {
  std::ostringstream answer, ignored;
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
    app.exit(error, answer, ignored);
    streams.out << answer.str();
    return kDone;
  }
  std::string command;
  for (const CLI::App* chosen : app.get_subcommands()) command = " " + chosen->get_name();
  std::string complaint = word.empty() || word.starts_with("-") ? "" : unknown_command(app, word);
  if (complaint.empty()) complaint = one_line(error.what());
  streams.err << "dovetail" << command << ": " << complaint << "; see dovetail" << command << " --help\n";
  return kWrongInput;
}

}  // namespace

int run_program(int argc, const char* const* argv, const Streams& streams, const PoolFactory& pools) {
  CLI::App app(help::kDescription, "dovetail");
  Chosen chosen;
  app.set_version_flag("--version", std::string("dovetail ") + version());
  app.require_subcommand(1);
  app.footer(help::kFooter);
  add_commands(app, chosen, pools);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return parse_failure(app, error, argc > 1 ? argv[1] : "", streams);
  }
  try {
    return chosen(streams);
  } catch (...) {
    const auto [status, words] = failure();
    streams.err << words << "\n";
    return status;
  }
}

}  // namespace dovetail::studies
