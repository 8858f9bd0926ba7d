#pragma once

namespace dovetail::geometry {

inline constexpr double kPerMillimetre = 1e3;  ///< drawings and input decks are in mm, positions here in m

}  // namespace dovetail::geometry
