#include "optimizer/scene/responses.hpp"

#include <algorithm>
#include <array>

#include "optimizer/scene/scene_kind.hpp"

namespace dovetail::optimizer {

std::span<const ResponseName> response_names() {
  static constexpr std::array<ResponseName, 18> table{{
      {"asymptotic_wear_volume_m3", "m^3", "Volume worn off both surfaces of both flanks when wear has come to rest."},
      {"asymptotic_wear_depth_max_m", "m", "Largest wear depth, both surfaces together, when wear has come to rest."},
      {"initial_wear_rate_m3_per_cycle", "m^3", "Volume worn off per cycle while the flanks are unworn."},
      {"resonance_hz", "Hz", "Frequency of the largest amplitude of the followed mode, unworn, with friction."},
      {"worn_resonance_hz", "Hz", "The same after wear has come to rest."},
      {"resonance_drift", "", "Worn over unworn resonance frequency, minus one."},
      {"peak_amplitude_m", "m", "Amplitude of the aerofoil tip at the unworn resonance."},
      {"worn_peak_amplitude_m", "m", "Amplitude of the aerofoil tip at the worn resonance."},
      {"mass_kg", "kg", "Mass of one blade."},
      {"peak_stress_pa", "Pa",
       "Largest nodal von Mises stress on the fillets, over a period at the unworn resonance, from 0.35 fillet radii "
       "beyond "
       "the flanks' ends on."},
      {"contact_pressure_max_pa", "Pa",
       "Smooth maximum of the flank pressure under the spin-up load, 11.5 MPa above a uniform one; at a sharp flank "
       "end (flank_edge_radius_mm = "
       "0) its peak does not converge with the mesh."},
      {"contact_pressure_mean_pa", "Pa", "Mean flank pressure under the spin-up load, of the more loaded flank."},
      {"neck_tension_pa", "Pa", "Mean tension across the narrowest width of the blade's neck under the spin-up load."},
      {"blade_fillet_stress_pa", "Pa",
       "Smooth maximum of the von Mises stress on the blade's neck fillets, over a period at the unworn resonance; it "
       "fades out from 0.35 to 0.2 fillet radii from the flank's end, whose singularity is not the fillet's."},
      {"disk_fillet_stress_pa", "Pa",
       "Smooth maximum of the von Mises stress on the disk's slot fillets, over a period at the unworn resonance, "
       "faded out "
       "like the blade's."},
      {"post_width_m", "m", "Narrowest width of the disk post between two slots."},
      {"dissipated_energy_j", "J", "Energy lost to friction in one period at the unworn resonance."},
      {"glued_frequency_hz", "Hz", "Natural frequency of the followed mode with the flanks glued, at speed."},
  }};
  return table;
}

const ResponseName* find_response(std::string_view name) {
  const std::span<const ResponseName> table = response_names();
  const auto found = std::find_if(table.begin(), table.end(), [&](const ResponseName& r) { return r.name == name; });
  return found == table.end() ? nullptr : &*found;
}

std::vector<std::string> responses_without_limit(const Scene& scene) {
  const bool sharp =
      std::ranges::any_of(scene.geometry.flanks, [](const auto& flank) { return flank.edge_radius == 0; });
  const bool rough = scene.contact.normal_stiffness > 0 && scene.kind->rough_peaks;
  return sharp && !rough ? std::vector<std::string>{"contact_pressure_max_pa"} : std::vector<std::string>{};
}

}  // namespace dovetail::optimizer
