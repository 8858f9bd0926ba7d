#pragma once

#include <functional>

namespace dovetail::python {

/// How a computation that is asked to end does so.
enum class Ending {
  at_once,   ///< wherever it is (core/interruption.hpp)
  in_order,  ///< as a run does on Ctrl-C: what is finished is written
};

/// Runs `work` while other threads of the interpreter go on. Call it with the interpreter's lock held; `work` has not
/// got it. Ctrl-C ends the work, and then KeyboardInterrupt is raised. What `work` throws reaches the caller.
void compute(const std::function<void()>& work, Ending ending = Ending::at_once);

}  // namespace dovetail::python
