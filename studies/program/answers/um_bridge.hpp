#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "optimizer/problem/evaluation.hpp"

/// Answers in the UM-Bridge protocol, version 1.0: a model with one vector in and one out, over HTTP.
namespace dovetail::studies {

struct UmModel {
  std::string name;
  std::vector<std::string> inputs;   ///< keys of the design variables, in the unit of the file
  std::vector<std::string> outputs;  ///< responses, SI
  std::function<optimizer::Evaluation(std::span<const double>)> evaluate;
};

struct UmReply {
  int status = 200;  ///< of HTTP
  std::string body;  ///< JSON
};

/// The answer to a request for a path with a JSON body (none for /Info): /Info, /ModelInfo, /InputSizes, /OutputSizes
/// and /Evaluate; /ModelInfo names inputs and outputs besides. What is wrong, derivatives, and designs without an
/// answer are errors of the protocol with a sentence.
[[nodiscard]] UmReply um_bridge(const UmModel& model, const std::string& path, const std::string& body);

}  // namespace dovetail::studies
