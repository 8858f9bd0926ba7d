#include "studies/program/answers/um_bridge.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/errors.hpp"
#include "studies/program/engine/json_values.hpp"

namespace dovetail::studies {
namespace {

constexpr int kBadRequest = 400, kNotFound = 404, kServerError = 500;

UmReply error(int status, const char* type, const std::string& message) {
  return {.status = status, .body = text({{"error", {{"type", type}, {"message", message}}}})};
}

UmReply invalid(const std::string& message) {
  return error(kBadRequest, "InvalidInput", message);
}

UmReply evaluated(const UmModel& model, const Json& request) {
  std::vector<std::vector<double>> input;
  try {
    input = request.at("input").get<std::vector<std::vector<double>>>();
  } catch (const Json::exception&) {
    return invalid("\"input\" must be a list of one list of numbers");
  }
  if (input.size() != 1 || input.front().size() != model.inputs.size())
    return invalid(fmt::format("\"input\" must be one list of {} numbers", model.inputs.size()));
  optimizer::Evaluation evaluation;
  try {
    evaluation = model.evaluate(input.front());
  } catch (const InputError& wrong) {
    return invalid(wrong.what());
  }
  const std::string why = evaluation.messages.empty() ? "" : ": " + evaluation.messages.front();
  if (!evaluation.converged()) return error(kServerError, "InvalidOutput", evaluation.status + why);
  Json output = Json::array();
  for (const std::string& name : model.outputs) {
    const auto found = evaluation.responses.find(name);
    if (found == evaluation.responses.end() || !std::isfinite(found->second))
      return error(kServerError, "InvalidOutput", name + " has no value");
    output.push_back(found->second);
  }
  return {.body = text({{"output", Json::array({output})}})};
}

}  // namespace

UmReply um_bridge(const UmModel& model, const std::string& path, const std::string& body) {
  if (path == "/Info") return {.body = text({{"protocolVersion", 1.0}, {"models", Json::array({model.name})}})};
  const bool derivative = path == "/Gradient" || path == "/ApplyJacobian" || path == "/ApplyHessian";
  if (path != "/ModelInfo" && path != "/InputSizes" && path != "/OutputSizes" && path != "/Evaluate" && !derivative)
    return error(kNotFound, "InvalidInput", path + " is no path of UM-Bridge 1.0");
  const Json request = Json::parse(body, nullptr, false);
  if (!request.is_object()) return invalid("the request must be a JSON object");
  if (!request.contains("name") || request.at("name") != model.name)
    return error(kBadRequest, "ModelNotFound", "the model served is " + model.name);
  if (request.contains("config") && !request.at("config").empty())
    return invalid("\"config\" must be empty: what there is to configure stands in the study");
  if (derivative)
    return error(kBadRequest, "UnsupportedFeature", path.substr(1) + " is not supported: there are no derivatives");
  if (path == "/ModelInfo")
    return {
        .body = text(
            {{"support", {{"Evaluate", true}, {"Gradient", false}, {"ApplyJacobian", false}, {"ApplyHessian", false}}},
             {"inputs", model.inputs},
             {"outputs", model.outputs}})};
  if (path == "/InputSizes") return {.body = text({{"inputSizes", Json::array({model.inputs.size()})}})};
  if (path == "/OutputSizes") return {.body = text({{"outputSizes", Json::array({model.outputs.size()})}})};
  return evaluated(model, request);
}

}  // namespace dovetail::studies
