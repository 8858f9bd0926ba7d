#include "studies/ready_study/program.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>

#include "core/errors.hpp"
#include "core/replace_file.hpp"
#include "numerics/process.hpp"
#include "studies/report/record/run_record.hpp"
#include "studies/report/words/table.hpp"
#include "studies/report/words/units.hpp"

namespace dovetail::ready_study {

double Call::passed() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

Made Call::made(const std::string& study_text) const {
  return {.quick = quick, .commit = commit, .seconds = passed(), .study_text = study_text};
}

void Call::say(const std::string& what) const {
  std::printf("%6.1f s  %s\n", passed(), what.c_str());
  std::fflush(stdout);
}

int run(int argc, char** argv, const Program& program) try {
  numerics::prepare_process(argv);
  CLI::App app{program.about};
  Call call;
  app.add_option("folder", call.folder, std::string("Folder of ") + program.files)->required();
  app.add_option("--study", call.study_file, "Study file of the scene")->required();
  app.add_option("--commit", call.commit, "Commit of the sources, to be recorded");
  app.add_flag("--quick", call.quick, program.quick);
  for (const Flag& flag : program.flags) app.add_flag(flag.name, *flag.set, flag.help);
  CLI11_PARSE(app, argc, argv);
  const std::vector<std::string> failures = program.run(call);
  call.say("done: " + call.folder + "/" + program.page);
  for (const std::string& failure : failures) std::fprintf(stderr, "%s\n", failure.c_str());
  return failures.empty() ? 0 : 3;
} catch (const InputError& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}

std::string page(const std::string& title, std::string_view rules, std::string_view text, report::Blanks blanks,
                 const Made& made, const std::vector<std::pair<std::string, std::string>>& more) {
  const report::Provenance by = report::provenance();
  std::vector<std::pair<std::string, std::string>> rows{{"Time taken", report::significant(made.seconds, 3) + " s"}};
  rows.insert(rows.end(), more.begin(), more.end());
  for (const auto& [name, value] : {std::pair{"Commit", made.commit}, {"Compiler", by.compiler}, {"Date", by.date_utc}})
    rows.emplace_back(name, value);
  blanks["quick"] = made.quick ? "yes" : "";
  blanks["provenance"] = report::definition_list(rows);
  blanks["study"] = made.study_text;
  return report::page(title, rules, report::fill(text, blanks));
}

void write(const std::filesystem::path& folder, const std::vector<std::pair<std::string, std::string>>& files) {
  std::error_code ignored;  // what is missing is named when a file cannot be written
  std::filesystem::create_directories(folder, ignored);
  for (const auto& [name, content] : files) replace_file(folder / name, content);
}

}  // namespace dovetail::ready_study
