#pragma once

#include <string>

namespace dovetail::geometry {

/// A DXF file whose dictionaries and what they list name their owners (group 330): the dictionary that lists them, 0
/// for the one that no other does. Files of R2000 need that; dxflib leaves it out, and readers that check repair it.
[[nodiscard]] std::string with_owners(const std::string& dxf);

}  // namespace dovetail::geometry
