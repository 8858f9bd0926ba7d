#include "studies/program/commands/told.hpp"

#include <exception>
#include <new>
#include <system_error>

#include "core/options.hpp"
#include "studies/program/answers/version.hpp"

namespace dovetail::studies {

Failure failure() {
  try {
    throw;
  } catch (const InputError& error) {
    return {.status = kWrongInput, .words = error.what()};
  } catch (const std::system_error& error) {
    return {.status = kWrongInput, .words = "dovetail: " + one_line(error.what())};
  } catch (const std::bad_alloc&) {
    return {.status = kWrongInput,
            .words =
                "dovetail: there is not enough memory for this; fewer harmonics, samples, modes or elements need "
                "less"};
  } catch (const std::exception& error) {
    return {.status = kNotConverged,
            .words = std::string("dovetail: the computation ended unexpectedly: ") + one_line(error.what())};
  }
}

int told(const ToldCommand& command, const TellChoice& choice, const Streams& streams,
         const std::function<int(Teller&)>& work) {
  Teller teller(streams.err, choice, command.plain);
  nlohmann::ordered_json begin{{"version", 1}, {"program", version()}, {"command", command.name}};
  begin.update(command.fields);
  teller.event("begin", begin);
  const auto end = [&](int status) { teller.event("end", {{"exit_status", status}}); };
  try {
    const int status = work(teller);
    end(status);
    return status;
  } catch (...) {
    end(failure().status);
    throw;
  }
}

}  // namespace dovetail::studies
