// With what the results were made.
#include <map>
#include <string>

#include "studies/report/pages/report_tables.hpp"
#include "studies/report/words/table.hpp"
#include "studies/report/words/units.hpp"

namespace dovetail::report {

namespace {

std::string folded_values(const char* title, const std::map<std::string, std::string>& values) {
  if (values.empty()) return {};
  Table table{.columns = {{""}, {"", true}}, .rows = {}};
  for (const auto& [key, value] : values) table.rows.push_back({{Html{"<code>" + escape(key) + "</code>"}, value}});
  return folded("", title, table_html(table));
}

}  // namespace

std::string provenance_section(const RunRecord& record) {
  const Provenance& p = record.provenance;
  std::string libraries;
  for (const auto& [name, version] : p.libraries) libraries += (libraries.empty() ? "" : ", ") + name + " " + version;
  std::string text =
      definition_list({{"Program", p.program_version.empty() ? "" : "dovetail " + p.program_version},
                       {"Date", p.date_utc},
                       {"Time taken", !(record.seconds > 0)  ? ""
                                      : record.seconds < 120 ? significant(record.seconds, 3) + " s"
                                                             : significant(record.seconds / 60, 3) + " min"},
                       {"Compiler", p.compiler},
                       {"Libraries", libraries},
                       {"Study", p.study_file}});
  text += folded_values("Settings chosen for the accuracy asked for", p.settings);
  text += folded_values("Options of the optimiser", p.options);
  if (!p.study_text.empty()) text += folded("", "The study file", "<pre>" + escape(p.study_text) + "</pre>");
  return text;
}

}  // namespace dovetail::report
