#include "geometry/mesh/sector_topology.hpp"

#include <algorithm>
#include <cassert>
#include <map>
#include <string>
#include <utility>

#include "geometry/mesh/contact_grid.hpp"
#include "geometry/mesh/flank_fractions.hpp"
#include "geometry/mesh/index.hpp"
#include "geometry/profile/fillet_share.hpp"
#include "geometry/profile/flank_form.hpp"

namespace dovetail::geometry {
namespace {

using Eigen::Vector2d;

std::size_t position(const Chain& chain, const std::string& name) {
  const auto found = std::find_if(chain.begin(), chain.end(), [&](const Edge& e) { return e.name == name; });
  assert(found != chain.end());
  return static_cast<std::size_t>(found - chain.begin());
}

template <class T>
std::vector<T> reversed(std::vector<T> values) {
  std::reverse(values.begin(), values.end());
  return values;
}

}  // namespace

SectorTopology::SectorTopology(const CornerMesh& blade, const CornerMesh& disk, const Profile& profile) {
  sector_.mesh.regions = {
      {.name = "blade_root", .body = 0}, {.name = "aerofoil", .body = 0}, {.name = "disk", .body = 1}};
  blade_ = add_body(blade, profile.blade, 0);
  disk_ = add_body(disk, profile.disk, 2);
  flank_fractions_ = blade.fractions[position(profile.blade, "flank_left")];
  for (const FlankPlace& place : kFlanks) add_flank(place, profile);

  const std::vector<int> left = reversed(disk_.along[position(profile.disk, "cut_left")]);
  const std::vector<int>& right = disk_.along[position(profile.disk, "cut_right")];
  assert(left.size() == right.size());
  for (std::size_t k = 0; k < left.size(); ++k) sector_.cyclic_pairs.push_back({left[k], right[k]});
  sector_.bore_nodes = disk_.along[position(profile.disk, "bore")];
  sector_.tip_node = blade_.first + blade.far_middle();

  const std::vector<int>& left_fillet = blade_.along[position(profile.blade, "neck_fillet_left")];
  const std::vector<int>& right_fillet = blade_.along[position(profile.blade, "neck_fillet_right")];
  sector_.neck_nodes = {left_fillet.back(), right_fillet.front(), left_fillet.front(), right_fillet.back()};
  sector_.blade_fillet_nodes = left_fillet;
  sector_.blade_fillet_nodes.insert(sector_.blade_fillet_nodes.end(), right_fillet.begin(), right_fillet.end());
  sector_.disk_fillet_nodes = disk_.along[position(profile.disk, "slot_fillet_left")];
  const std::vector<int>& slot_right = disk_.along[position(profile.disk, "slot_fillet_right")];
  sector_.disk_fillet_nodes.insert(sector_.disk_fillet_nodes.end(), slot_right.begin(), slot_right.end());
}

SectorTopology::Body SectorTopology::add_body(const CornerMesh& corners, const Chain& chain, int regions_before) {
  Body body{.first = node_count_, .corners = static_cast<int>(corners.nodes.size()), .middles = {}, .along = {}};
  node_count_ += body.corners;

  std::map<std::pair<int, int>, int> middle_of;
  const auto middle = [&](int i, int j) {
    const auto [entry, is_new] = middle_of.try_emplace(std::minmax(i, j), node_count_);
    if (is_new) body.middles.push_back({.node = node_count_++, .from = body.first + i, .to = body.first + j});
    return entry->second;
  };
  for (std::size_t t = 0; t < corners.triangles.size(); ++t) {
    const auto& [i, j, k] = corners.triangles[t];
    for (int node : {body.first + i, body.first + j, body.first + k, middle(i, j), middle(j, k), middle(k, i)})
      sector_.mesh.connectivity.push_back(node);
    sector_.mesh.region.push_back(regions_before + corners.region[t]);
  }

  const int first_middle = body.first + body.corners;
  for (std::size_t e = 0; e < chain.size(); ++e) {
    const std::vector<int>& on = corners.edge_nodes[e];
    std::vector<int> nodes{body.first + on[0]};
    for (std::size_t k = 0; k + 1 < on.size(); ++k) {
      const int node = middle_of.at(std::minmax(on[k], on[k + 1]));
      MiddleNode& m = body.middles[index(node - first_middle)];
      m.edge = static_cast<int>(e);
      m.fraction = (corners.fractions[e][k] + corners.fractions[e][k + 1]) / 2;
      nodes.push_back(node);
      nodes.push_back(body.first + on[k + 1]);
    }
    body.along.push_back(std::move(nodes));
  }
  return body;
}

void SectorTopology::add_flank(const FlankPlace& place, const Profile& profile) {
  const std::string name = "flank_" + std::string(place.name);
  std::vector<int> blade = blade_.along[position(profile.blade, name)];
  std::vector<int> disk = disk_.along[position(profile.disk, name)];
  assert(blade.size() == disk.size());
  // With material on the left, the blade's left flank runs from neck to root; the other three follow from that.
  if (place.left)
    disk = reversed(std::move(disk));
  else
    blade = reversed(std::move(blade));
  fem::Flank flank;
  flank.name = place.name;
  for (std::size_t k = 0; k < blade.size(); ++k) flank.pairs.push_back({blade[k], disk[k]});
  sector_.flanks.push_back(std::move(flank));
}

Eigen::Matrix2Xd SectorTopology::positions(const Profile& profile, const Eigen::Matrix2Xd& blade_corners,
                                           const Eigen::Matrix2Xd& disk_corners) const {
  Eigen::Matrix2Xd nodes(2, node_count_);
  const auto fill = [&nodes](const Body& body, const Chain& chain, const Eigen::Matrix2Xd& corners) {
    nodes.middleCols(body.first, body.corners) = corners;
    for (const MiddleNode& m : body.middles) {
      if (m.edge >= 0)
        nodes.col(m.node) = chain[index(m.edge)].point(m.fraction);
      else
        nodes.col(m.node) = (nodes.col(m.from) + nodes.col(m.to)) / 2;
    }
  };
  fill(blade_, profile.blade, blade_corners);
  fill(disk_, profile.disk, disk_corners);
  // Travelled in opposite directions, the two lines of a flank round differently: make the pairs coincide to the last
  // bit.
  for (const fem::Flank& flank : sector_.flanks)
    for (const auto& [blade, disk] : flank.pairs) nodes.col(disk) = nodes.col(blade);
  return nodes;
}

void SectorTopology::share_fillets(const Profile& profile, fem::SectorMesh& sector) const {
  const auto shares = [&](const Body& body, const Chain& chain, const std::string& name, bool flank_at_start,
                          double straight) {
    const std::size_t at = position(chain, name);
    return fillet_shares(chain[at], flank_at_start, straight, sector.mesh.nodes(Eigen::all, body.along[at]));
  };
  const auto both = [](const Eigen::VectorXd& left, const Eigen::VectorXd& right) {
    Eigen::VectorXd all(left.size() + right.size());
    all << left, right;
    return all;
  };
  sector.blade_fillet_share = both(shares(blade_, profile.blade, "neck_fillet_left", false, 0),
                                   shares(blade_, profile.blade, "neck_fillet_right", true, 0));
  const auto runout = [&](const char* name) { return profile.disk[position(profile.disk, name)].length(); };
  sector.disk_fillet_share = both(shares(disk_, profile.disk, "slot_fillet_left", false, runout("runout_left")),
                                  shares(disk_, profile.disk, "slot_fillet_right", true, runout("runout_right")));
}

Eigen::VectorXd SectorTopology::blade_values(const Eigen::VectorXd& at_corners) const {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(node_count_);
  values.segment(blade_.first, blade_.corners) = at_corners;
  for (const MiddleNode& m : blade_.middles) values[m.node] = (values[m.from] + values[m.to]) / 2;
  return values;
}

fem::SectorMesh SectorTopology::place(const Profile& profile, const ProfileParameters& parameters,
                                      const Eigen::Matrix2Xd& blade_corners,
                                      const Eigen::Matrix2Xd& disk_corners) const {
  fem::SectorMesh sector = sector_;
  sector.sectors = parameters.sectors;
  sector.mesh.regions[0].thickness = parameters.slot_length;
  sector.mesh.regions[1].thickness = parameters.chord;
  sector.mesh.regions[2].thickness = parameters.slot_length;
  sector.mesh.nodes = positions(profile, blade_corners, disk_corners);
  share_fillets(profile, sector);

  const std::vector<double> pairs = with_middles(flank_fractions_);
  for (std::size_t f = 0; f < kFlanks.size(); ++f) {
    fem::Flank& flank = sector.flanks[f];
    const Vector2d along = sector.mesh.nodes.col(flank.pairs.back()[0]) - sector.mesh.nodes.col(flank.pairs.front()[0]);
    flank.tangents = along.normalized();
    flank.normal =
        kFlanks[f].left ? Vector2d(along.y(), -along.x()).normalized() : Vector2d(-along.y(), along.x()).normalized();
    flank.grid = {static_cast<int>(flank_fractions_.size()), 1};
    flank.interpolation = bilinear_interpolation(flank_fractions_, {0}, pairs, {0});
    const FlankForm form(parameters.flanks[f]);
    flank.position.resize(2, flank.contact_count());
    flank.gap.resize(flank.contact_count());
    for (std::size_t k = 0; k < flank_fractions_.size(); ++k) {
      const Eigen::Index contact = static_cast<Eigen::Index>(k);
      flank.position.col(contact) = sector.mesh.nodes.col(flank.pairs[2 * k][0]);
      flank.gap[contact] = form.gap(flank_fractions_[k]);
    }
    flank.pair_gap.resize(std::ssize(flank.pairs));
    for (std::size_t k = 0; k < pairs.size(); ++k) flank.pair_gap[static_cast<Eigen::Index>(k)] = form.gap(pairs[k]);
  }
  return sector;
}

}  // namespace dovetail::geometry
