#pragma once

#include <chrono>
#include <condition_variable>
#include <fstream>
#include <functional>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <ostream>
#include <string>
#include <thread>

#include "studies/program/questions/tell_choice.hpp"

namespace dovetail::studies {

/// When the progress of a stage is shown, s after it began.
struct TellerParams {
  double terminal_first = 2, terminal_every = 1;  ///< a line that is renewed
  double plain_first = 10, plain_times = 2;       ///< lines of a log, each after so many times the time of the last
};

/// Tells people and programs what a command does while it does it: the stage at hand with the time it has taken and the
/// time left, remarks, events of a log; and what Ctrl-C waits for.
class Teller {
 public:
  /// Of a stage, after so many seconds of it.
  using Words = std::function<std::string(double seconds)>;

  /// @param plain  progress is told, too, where the stream is no terminal
  /// Throws InputError where the log cannot be written.
  Teller(std::ostream& err, const TellChoice& choice, bool plain = false);
  ~Teller();
  Teller(const Teller&) = delete;
  Teller& operator=(const Teller&) = delete;

  /// A stage begins, which takes about so many seconds, or so many steps: 0 where nobody knows.
  void begin(const std::string& what, double expected_s = 0, int all = 0);
  /// So many steps of the stage are done.
  void step(int done);
  /// How things stand, now and as time goes on; Ctrl-C waits for `under_way`.
  void status(Words words, const std::string& under_way);
  /// Nothing is under way that takes time.
  void end();

  /// Where a remark is written, a line of its own; nowhere when quiet.
  [[nodiscard]] std::ostream& remark();
  /// An event of the log, with what belongs to it.
  void event(const char* name, const nlohmann::ordered_json& fields);
  /// From now on Ctrl-C says that of what it leaves.
  void keeps(const std::string& kept);
  /// Whether anybody sees the progress.
  [[nodiscard]] bool shows() const { return shows_; }

 private:
  using Clock = std::chrono::steady_clock;
  struct Stage {
    Words words = {};
    Clock::time_point begin = Clock::now();
    double next = 0;  // s of the stage, when it is shown
  };

  void enter(Words words, double next);
  void show(const std::string& text);
  void clear();
  void tick();

  std::ostream& err_;
  std::ostream silence_{nullptr};
  std::ofstream log_;
  bool terminal_, shows_, quiet_, open_ = false, ended_ = false;
  std::string what_, kept_ = "nothing is written";
  double expected_ = 0;
  int done_ = 0, all_ = 0;
  Clock::time_point begin_ = Clock::now();
  std::mutex mutex_;  // of all that the thread shows
  Stage stage_;
  std::condition_variable wake_;
  std::thread thread_;
};

/// "about 40 s to go", "about 3 min to go".
[[nodiscard]] std::string time_words(double seconds);

}  // namespace dovetail::studies
