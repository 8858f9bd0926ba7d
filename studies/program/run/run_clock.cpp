#include "studies/program/run/run_clock.hpp"

#include <fstream>

#include "core/replace_file.hpp"
#include "studies/program/engine/json_values.hpp"

namespace dovetail::studies {
namespace {

constexpr const char* kTaken = "time.json";
/// s, between two times it is written: nobody misses them, and a file is written at once beside any evaluation.
constexpr double kEvery = 5;

}  // namespace

double seconds_taken(const std::filesystem::path& directory) {
  std::ifstream stream(directory / kTaken);
  const Json json = Json::parse(stream, nullptr, false);  // damaged: the run counts anew
  if (!json.is_object() || !json.contains("seconds") || !json["seconds"].is_number()) return 0;
  return json["seconds"].get<double>();
}

void keep_seconds_taken(const std::filesystem::path& directory, double seconds) {
  replace_file(directory / kTaken, text({{"seconds", seconds}}));
}

RunClock::RunClock(const std::filesystem::path& directory, bool resume)
    : directory_(directory), before_(resume ? seconds_taken(directory) : 0) {}

RunClock::~RunClock() {
  try {
    keep();
  } catch (const InputError&) {
    // A directory that cannot be written any more has said so elsewhere.
  }
}

double RunClock::session() const {
  return std::chrono::duration<double>(Clock::now() - begin_).count();
}

void RunClock::tick() {
  if (session() >= kept_ + kEvery) keep();
}

void RunClock::keep() {
  kept_ = session();
  keep_seconds_taken(directory_, total());
}

}  // namespace dovetail::studies
