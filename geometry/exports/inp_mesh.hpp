#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fem/sector_mesh.hpp"

namespace dovetail::geometry {

/// Nodes, elements and named sets of a sector as text of an input deck, mm (see inp.hpp). With `with_gap`, blade nodes
/// of the flanks stand back from the disk by the initial gap.
[[nodiscard]] std::string inp_mesh(const fem::SectorMesh& sector, bool with_gap);

/// [nodes] whether a node belongs to the deck: nodes in the middle of rectangular faces of 18-node wedges do not.
[[nodiscard]] std::vector<bool> inp_nodes(const fem::Mesh& mesh);

/// Name of a set: capitals, digits and underscores.
[[nodiscard]] std::string inp_name(std::string_view name);
/// "BLADE", "DISK".
[[nodiscard]] std::string inp_body_name(int body);
/// "FLANK_LEFT_BLADE"; side 0 is the blade's, 1 the disk's.
[[nodiscard]] std::string inp_flank_name(const fem::Flank& flank, int side);

}  // namespace dovetail::geometry
