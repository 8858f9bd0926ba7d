#include "studies/python/computation.hpp"

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <future>
#include <optional>

#include "core/interruption.hpp"
#include "studies/program/engine/interrupt.hpp"

namespace dovetail::python {

namespace py = pybind11;

namespace {

/// How often signals are looked at: people do not notice it, and the interpreter's lock is hardly ever taken.
constexpr std::chrono::milliseconds kLook{20};

}  // namespace

void compute(const std::function<void()>& work, Ending ending) {
  std::atomic<bool> stop{false}, end{false};  // at once, in order
  // Python handles signals in its main thread, between its own instructions: so the work has a thread of its own.
  std::optional<py::error_already_set> raised;
  std::exception_ptr thrown;
  {
    const py::gil_scoped_release free;
    const std::future<void> done = std::async(std::launch::async, [&] {
      try {
        const Interruptible interruptible(stop);
        const studies::AskedToEnd asked(end);
        work();
      } catch (const Interrupted&) {
      } catch (...) {
        thrown = std::current_exception();
      }
    });
    while (done.wait_for(kLook) != std::future_status::ready) {
      const py::gil_scoped_acquire held;
      if (PyErr_CheckSignals() == 0) continue;
      const bool again = raised.has_value();
      raised.emplace();
      (ending == Ending::at_once || again ? stop : end) = true;
    }
  }
  if (raised) throw py::error_already_set(*raised);
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace dovetail::python
