#pragma once

#include <string>

namespace dovetail::studies {

/// What a command tells of its work while it works, beside its answer.
struct TellChoice {
  bool quiet = false;  ///< nothing but errors
  std::string log;     ///< file of events, a JSON object a line; empty: none
};

}  // namespace dovetail::studies
