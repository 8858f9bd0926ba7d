#include <cblas.h>
#include <fmt/format.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <fstream>
#include <string>

#include "studies/report/record/run_record.hpp"
#include "studies/work_precision/results.hpp"

namespace dovetail::work_precision {
namespace {

// The value of the first "key : value" or KEY="value" line, or what is said instead.
std::string value_in(const char* file, const std::string& key, char separator, const std::string& otherwise) {
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find(separator);
    if (at == std::string::npos || !line.starts_with(key)) continue;
    const std::size_t from = line.find_first_not_of(" \t\"", at + 1);
    const std::size_t to = line.find_last_not_of(" \t\"");
    if (from != std::string::npos) return line.substr(from, to - from + 1);
  }
  return otherwise;
}

}  // namespace

Circumstances circumstances() {
  Circumstances made;
  const double memory = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  made.machine = fmt::format("{} at {} MHz, {} cores of which one is used, {:.0f} GiB",
                             value_in("/proc/cpuinfo", "model name", ':', "unknown processor"),
                             value_in("/proc/cpuinfo", "cpu MHz", ':', "?"), sysconf(_SC_NPROCESSORS_ONLN),
                             memory / (1024.0 * 1024.0 * 1024.0));
  utsname kernel{};
  uname(&kernel);
  made.system =
      value_in("/etc/os-release", "PRETTY_NAME", '=', "unknown system") + ", " + kernel.sysname + " " + kernel.release;
  made.blas = std::string(openblas_get_config()) + ", kernels for " + openblas_get_corename();
  const report::Provenance provenance = report::provenance();
  made.compiler = provenance.compiler;
  made.date_utc = provenance.date_utc;
  return made;
}

}  // namespace dovetail::work_precision
