#pragma once

#include <cstddef>

namespace dovetail::geometry {

/// A number of a node or an element as the containers of the standard library want it.
inline std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

}  // namespace dovetail::geometry
