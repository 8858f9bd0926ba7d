#include "studies/program/run/run_clock.hpp"

#include <algorithm>
#include <fstream>

#include "core/replace_file.hpp"
#include "core/signals_held.hpp"
#include "studies/program/engine/json_values.hpp"

namespace dovetail::studies {
namespace {

constexpr const char* kTaken = "time.json";
/// Between two times it is written: nobody misses them.
constexpr std::chrono::seconds kEvery(5);

}  // namespace

double seconds_taken(const std::filesystem::path& directory) {
  std::ifstream stream(directory / kTaken);
  const Json json = Json::parse(stream, nullptr, false);  // damaged: the run counts anew
  if (!json.is_object() || !json.contains("seconds") || !json["seconds"].is_number()) return 0;
  return std::max(json["seconds"].get<double>(), 0.0);
}

void keep_seconds_taken(const std::filesystem::path& directory, double seconds) {
  replace_file(directory / kTaken, text({{"seconds", seconds}}));
}

RunClock::RunClock(const std::filesystem::path& directory, bool resume)
    : directory_(directory), before_(resume ? seconds_taken(directory) : 0), writer_([this] {
        const SignalsHeld held;  // they are for the thread that computes
        return std::jthread([this](const std::stop_token& stop) {
          std::unique_lock lock(mutex_);
          while (!ends_.wait_for(lock, stop, kEvery, [&] { return stop.stop_requested(); })) keep();
        });
      }()) {}

RunClock::~RunClock() {
  writer_.request_stop();
  writer_.join();
  if (counts_) keep();
}

double RunClock::session() const {
  return std::chrono::duration<double>(Clock::now() - begin_).count();
}

void RunClock::keep() {
  try {
    keep_seconds_taken(directory_, total());
  } catch (const InputError&) {
    // A directory that cannot be written any more is told of elsewhere.
  }
}

}  // namespace dovetail::studies
