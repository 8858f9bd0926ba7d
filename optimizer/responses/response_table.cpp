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

const Response* find_response(std::string_view name) {
  const auto found = std::ranges::find(kResponses, name, &Response::name);
  return found == kResponses.end() ? nullptr : *found;
}

}  // namespace dovetail::optimizer
