#include "optimizer/responses/response_table.hpp"

#include <algorithm>

namespace dovetail::optimizer {

Stage last_stage(const std::vector<std::string>& names) {
  Stage last = Stage::model;
  for (const std::string& name : names)
    if (const Response* response = find_response(name)) last = std::max(last, response->stage);
  return last;
}

bool by_finer_mesh(const std::vector<std::string>& names) {
  return std::ranges::any_of(names, [](const std::string& name) {
    const Response* response = find_response(name);
    return response != nullptr && response->by_finer_mesh;
  });
}

bool of_a_mission(const std::vector<std::string>& names) {
  return std::ranges::any_of(names, [](const std::string& name) {
    const Response* response = find_response(name);
    return response != nullptr && response->alone != nullptr;
  });
}

std::vector<std::string> response_names() {
  std::vector<std::string> names;
  for (const Response& response : responses()) names.emplace_back(response.name);
  for (const Response& response : mission_responses()) names.emplace_back(response.name);
  return names;
}

const Response* find_response(std::string_view name) {
  const auto found = std::ranges::find(kResponses, name, &Response::name);
  if (found != kResponses.end()) return *found;
  const auto of_mission = std::ranges::find(kMissionResponses, name, &Response::name);
  return of_mission == kMissionResponses.end() ? nullptr : *of_mission;
}

}  // namespace dovetail::optimizer
