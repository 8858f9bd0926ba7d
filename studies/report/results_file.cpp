#include "studies/report/results_file.hpp"

#include "studies/report/results_archive.hpp"

namespace dovetail::report {

namespace {

constexpr const char* kFormat = "dovetail-results";
constexpr std::int64_t kVersion = 1;
constexpr const char* kVerifications = "/verifications";
constexpr const char* kFiner = "/finer";

std::int64_t index_of(const std::optional<std::size_t>& index) {
  return index ? static_cast<std::int64_t>(*index) : -1;
}

void write_options(Writer& writer, const std::string& path, const std::map<std::string, std::string>& named) {
  std::vector<std::string> names, values;
  for (const auto& [name, value] : named) {
    names.push_back(name);
    values.push_back(value);
  }
  writer.texts(path + "_names", names);
  writer.texts(path + "_values", values);
}

void write_provenance(Writer& writer, const Provenance& p) {
  writer.texts("/provenance/study_text", {p.study_text});
  write_options(writer, "/provenance/library", p.libraries);
  write_options(writer, "/provenance/option", p.options);
  writer.text("/provenance", "program_version", p.program_version);
  writer.text("/provenance", "date_utc", p.date_utc);
  writer.text("/provenance", "compiler", p.compiler);
  writer.text("/provenance", "study_file", p.study_file);
}

void read_options(const Reader& r, const std::string& path, std::map<std::string, std::string>& named) {
  std::vector<std::string> names, values;
  r.texts(path + "_names", names);
  r.texts(path + "_values", values);
  r.require_size(path + "_values", values.size(), names.size());
  for (std::size_t i = 0; i < names.size(); ++i) named[names[i]] = values[i];
}

void read_provenance(const Reader& r, Provenance& p) {
  std::vector<std::string> study;
  r.texts("/provenance/study_text", study);
  r.require_size("/provenance/study_text", study.size(), 1);
  p.study_text = study.front();
  read_options(r, "/provenance/library", p.libraries);
  read_options(r, "/provenance/option", p.options);
  r.text("/provenance", "program_version", p.program_version);
  r.text("/provenance", "date_utc", p.date_utc);
  r.text("/provenance", "compiler", p.compiler);
  r.text("/provenance", "study_file", p.study_file);
}

void read_index(const Reader& r, const std::string& name, std::size_t count, std::optional<std::size_t>& index) {
  std::int64_t value = -1;
  r.whole("/", name, value);
  if (value < -1 || value >= static_cast<std::int64_t>(count))
    r.refuse(name, std::to_string(value), "must be the index of an evaluation, or -1");
  if (value >= 0) index = static_cast<std::size_t>(value);
}

void require_format(const Reader& r) {
  std::string format;
  if (r.file().has_attribute("/", "format")) r.text("/", "format", format);
  if (format != kFormat)
    r.refuse("format", format, "must be \"dovetail-results\": this is no results file of dovetail");
  std::int64_t version = 0;
  r.whole("/", "version", version);
  if (version < 1 || version > kVersion)
    r.refuse("version", std::to_string(version),
             "must be " + std::to_string(kVersion) + ": the file was written by another version of dovetail");
}

}  // namespace

void write_results(const std::filesystem::path& path, const RunRecord& record) {
  hdf5::write_and_rename(path.string(), [&](hdf5::File& file) {
    Writer w(file);
    w.text("/", "format", kFormat);
    w.whole("/", "version", kVersion);
    w.text("/", "name", record.name);
    w.text("/", "title", record.title);
    w.text("/", "status", record.status);
    w.text("/", "message", record.message);
    w.number("/", "seconds", record.seconds);
    w.whole("/", "best", index_of(record.best));
    w.whole("/", "least_broken", index_of(record.least_broken));
    w.whole("/", "baseline", index_of(record.baseline));
    write_provenance(w, record.provenance);
    write_problem(w, record.problem);
    write_evaluations(w, record);
    w.optional("/best", record.best_design, [&](const DesignRecord& design) { exchange(w, "/best", design); });
    w.optional("/baseline", record.baseline_design,
               [&](const DesignRecord& design) { exchange(w, "/baseline", design); });
    w.records(kVerifications, record.verifications,
              [&](const std::string& group, const VerificationRecord& v) { exchange(w, group, v); });
    w.records(kFiner, record.finer,
              [&](const std::string& group, const FinerRecord& check) { exchange(w, group, check); });
  });
}

RunRecord read_results(const std::filesystem::path& path) {
  const hdf5::File file = hdf5::File::open(path.string());
  const Reader r(file);
  require_format(r);
  RunRecord record;
  r.text("/", "name", record.name);
  r.text("/", "title", record.title);
  r.text("/", "status", record.status);
  r.text("/", "message", record.message);
  r.number("/", "seconds", record.seconds);
  read_provenance(r, record.provenance);
  read_problem(r, record.problem);
  read_evaluations(r, record);
  read_index(r, "best", record.evaluations.size(), record.best);
  read_index(r, "least_broken", record.evaluations.size(), record.least_broken);
  read_index(r, "baseline", record.evaluations.size(), record.baseline);
  r.optional("/best", record.best_design, [&](DesignRecord& design) { exchange(r, "/best", design); });
  r.optional("/baseline", record.baseline_design, [&](DesignRecord& design) { exchange(r, "/baseline", design); });
  // Files of runs without verification, and of versions before it, have none.
  if (file.exists(kVerifications))
    r.records(kVerifications, record.verifications,
              [&](const std::string& group, VerificationRecord& v) { exchange(r, group, v); });
  if (file.exists(kFiner))
    r.records(kFiner, record.finer, [&](const std::string& group, FinerRecord& check) { exchange(r, group, check); });
  for (const FinerRecord& check : record.finer)
    if (check.evaluation < 0 || check.evaluation >= static_cast<std::int64_t>(record.evaluations.size()))
      r.refuse(std::string(kFiner) + ", evaluation", std::to_string(check.evaluation),
               "must be the index of an evaluation");
  for (const VerificationRecord& v : record.verifications)
    if (v.evaluation < 0 || v.evaluation >= static_cast<std::int64_t>(record.evaluations.size()))
      r.refuse(std::string(kVerifications) + ", evaluation", std::to_string(v.evaluation),
               "must be the index of an evaluation");
  return record;
}

}  // namespace dovetail::report
