#include "geometry/exports/dxf_owners.hpp"

#include <algorithm>
#include <map>
#include <span>
#include <sstream>
#include <vector>

namespace dovetail::geometry {
namespace {

/// A DXF file is a list of these, a line each.
struct Group {
  std::string code, value;
  [[nodiscard]] bool is(int number) const { return std::stoi(code) == number; }
};

std::vector<Group> groups_of(const std::string& dxf) {
  std::vector<Group> groups;
  std::istringstream lines(dxf);
  for (Group group; std::getline(lines, group.code) && std::getline(lines, group.value);) groups.push_back(group);
  return groups;
}

}  // namespace

std::string with_owners(const std::string& dxf) {
  const std::vector<Group> groups = groups_of(dxf);
  const auto objects = std::ranges::find_if(groups, [](const Group& g) { return g.is(2) && g.value == "OBJECTS"; });
  std::map<std::string, std::string> owners;
  std::string handle;
  for (const Group& group : std::span(objects, groups.end())) {
    if (group.is(5)) handle = group.value;
    if (group.is(350)) owners[group.value] = handle;  // an entry of a dictionary
  }
  std::string text;
  bool in_objects = false;
  for (const Group& group : groups) {
    text += group.code + "\n" + group.value + "\n";
    in_objects = in_objects || &group == &*objects;
    if (!in_objects || !group.is(5)) continue;
    const auto owner = owners.find(group.value);
    text += "330\n" + (owner == owners.end() ? "0" : owner->second) + "\n";
  }
  return text;
}

}  // namespace dovetail::geometry
