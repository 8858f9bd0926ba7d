#include "optimizer/responses/response_table.hpp"

#include <algorithm>

namespace dovetail::optimizer {

const Response* find_response(std::string_view name) {
  const auto found = std::ranges::find(kResponses, name, &Response::name);
  return found == kResponses.end() ? nullptr : *found;
}

}  // namespace dovetail::optimizer
