#pragma once

#include <memory>
#include <string_view>

#include "steady/state.hpp"
#include "verdict_scenes.hpp"

namespace dovetail::wear::scenes {

/// What becomes of the wear in a scene, by explicit histories.
enum class Label {
  stops,      ///< the history wears out where the released state is, or there is no such state
  elsewhere,  ///< the released state is at rest, but the history wears out more than 1 % of the largest depth away
  goes_on,    ///< the rates of the history level out under load
  open,       ///< too near to a limit to say
};
[[nodiscard]] std::string_view to_string(Label label);

/// Two explicit histories of increments 0.4 % and 0.2 % of the released state's depth at four times the samples of
/// `steady`, not finished by release: they share neither the implicit steps nor the finish with what they judge. Both
/// have to agree, the finer one by 0.3 % of the depth beyond the limit, which is more than a node of it overshoots by.
/// Rates level out when the largest changes by less than 1e-3 over the second half of 1500 steps of a tenth of the
/// largest penetration.
[[nodiscard]] Label explicit_label(const std::shared_ptr<const dynamics::CondensedModel>& model, double omega,
                                   steady::Options steady);

}  // namespace dovetail::wear::scenes
