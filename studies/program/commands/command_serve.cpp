#include <fmt/format.h>

#include <mutex>
#include <ostream>

#include "optimizer/cases.hpp"
#include "studies/program/answers/um_bridge.hpp"
#include "studies/program/commands/commands.hpp"
#include "studies/program/engine/engine.hpp"
#include "studies/program/engine/loaded_model.hpp"
#include "studies/program/engine/run_folder.hpp"
#include "studies/program/study_file/refusal.hpp"
// Last: macros of <resolv.h>, which comes with it, are names in Eigen.
#include <httplib.h>

namespace dovetail::studies {
namespace {

UmModel served(const Study& study) {
  if (study.problem.space.size() == 0 || study.problem.objective.empty())
    refuse(study.file, "has no [[variable]] or no [[objective]]: these are what a model of it has in and out");
  UmModel model{.name = study.name, .inputs = study.problem.space.keys(), .outputs = {}, .evaluate = {}};
  for (const std::string& name : optimizer::responses_of(study.problem))
    if (study.problem.cases.empty())
      model.outputs.push_back(name);
    else
      for (const optimizer::LoadCase& load : study.problem.cases)
        model.outputs.push_back(optimizer::of_case(name, load.name));
  model.evaluate = study_engine(study).evaluate;
  return model;
}

}  // namespace

int run_serve(const ServeOptions& options, const Streams& streams) {
  const Study study = load_study(study_or_best(options.study, &streams.err), overrides(options.set));
  const UmModel model = served(study);
  httplib::Server server;
  std::mutex one;  // evaluation at a time, each on all cores
  const auto answer = [&](const httplib::Request& request, httplib::Response& response) {
    const std::scoped_lock lock(one);
    const UmReply reply = um_bridge(model, request.path, request.body);
    response.status = reply.status;
    response.set_content(reply.body, "application/json");
  };
  server.Get("/Info", answer);
  server.Post("/.*", answer);
  const int port = options.port > 0 ? (server.bind_to_port(options.host.c_str(), options.port) ? options.port : -1)
                                    : server.bind_to_any_port(options.host.c_str());
  if (port < 0)
    refuse("--host and --port", "cannot be served at: the port is in use or not allowed, or the host no address here",
           fmt::format("{}:{}", options.host, options.port));
  streams.out << fmt::format("{}: served at http://{}:{} until Ctrl-C; {} variables in, {} responses out\n", model.name,
                             options.host, port, model.inputs.size(), model.outputs.size())
              << std::flush;
  return server.listen_after_bind() ? kDone : kNotConverged;
}

}  // namespace dovetail::studies
