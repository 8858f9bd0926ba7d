#pragma once

#include <string_view>

#include "scenes.hpp"

namespace dovetail::wear::scenes {

/// Kinds of blocks on a floor for verdicts about their wear; numbers within a kind are random members.
enum class Family {
  crowned,    ///< random_block()
  coupled,    ///< normal and tangential stiffness coupled
  breathing,  ///< the normal load swings besides, edges lift off
  sliding,    ///< pulled beyond friction as a whole, held by springs
  sprung,     ///< near sliding as a whole, held by springs
  pressed,    ///< flat and pressed enough to stick
};
[[nodiscard]] std::string_view to_string(Family family);

[[nodiscard]] Block verdict_block(Family family, unsigned number);

}  // namespace dovetail::wear::scenes
