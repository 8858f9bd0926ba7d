#pragma once

#include <string_view>

#include "scenes.hpp"
#include "steady/options.hpp"

namespace dovetail::wear::scenes {

/// Kinds of joints for verdicts about their wear; numbers within a kind are random members. Blocks on a floor unless
/// said otherwise.
enum class Family {
  crowned,       ///< random_block()
  coupled,       ///< normal and tangential stiffness coupled
  breathing,     ///< the normal load swings besides, edges lift off
  sliding,       ///< pulled beyond friction as a whole, held by springs
  sprung,        ///< near sliding as a whole, held by springs
  pressed,       ///< flat and pressed enough to stick
  punch,         ///< parabolic punches on a half-plane, off the middle and tilted
  interference,  ///< pressed by a negative gap against springs only: wear takes the load away
  hopping,       ///< the normal load swings by more than itself: the block flies, springs bring it back
  space,         ///< paraboloid punches with two tangential directions on elliptic orbits
  space_sprung,  ///< the same, pulled about as far as friction holds, springs beyond, the load swinging
};
[[nodiscard]] std::string_view to_string(Family family);

/// What verdicts about them are given with.
inline const steady::Options kVerdictSettings{.harmonics = 3, .samples = 64};

[[nodiscard]] Block verdict_block(Family family, unsigned number);
[[nodiscard]] reduction::ReducedModel verdict_model(Family family, unsigned number);

}  // namespace dovetail::wear::scenes
