#include "wear/start.hpp"

#include <algorithm>

#include "core/errors.hpp"

namespace dovetail::wear {

void require_nothing_released(const steady::Condition& start) {
  if (std::ranges::all_of(start.released, [](char released) { return released == 0; })) return;
  throw InputError(Violation{.file = {},
                             .key = "start.released",
                             .value = "some nodes",
                             .allowed = "must release no node: which ones wear off is the answer"});
}

}  // namespace dovetail::wear
