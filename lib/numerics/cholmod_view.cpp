#include "numerics/cholmod_view.hpp"

#include <csignal>
#include <mutex>

#include "core/signals_held.hpp"

namespace dovetail::numerics {

// METIS draws from the process's one sequence of random numbers: two at a time would find other orders every time. It
// takes SIGTERM and SIGABRT for itself while it works, and gives them back to handlers that then serve once.
cholmod_factor* analyse_alone(cholmod_sparse& matrix, cholmod_common& common) {
  static std::mutex mutex;
  const std::scoped_lock lock(mutex);
  const SignalsHeld held;
  struct sigaction terminate {
  }, abort{};
  sigaction(SIGTERM, nullptr, &terminate);
  sigaction(SIGABRT, nullptr, &abort);
  cholmod_factor* factor = cholmod_analyze(&matrix, &common);
  sigaction(SIGTERM, &terminate, nullptr);
  sigaction(SIGABRT, &abort, nullptr);
  return factor;
}

}  // namespace dovetail::numerics
