#include "studies/program/study_file/scene_keys.hpp"

#include <algorithm>

namespace dovetail::studies {

const optimizer::Parameter* scene_key(const std::string& key, const Node& value, const std::string& path,
                                      Problems& problems) {
  if (const optimizer::Parameter* parameter = optimizer::find_parameter(key)) return parameter;
  std::vector<std::string> keys;
  for (const optimizer::Parameter& p : optimizer::scene_parameters()) keys.push_back(p.key);
  std::string near;
  for (const std::string& known : keys)
    if (known.ends_with("." + key)) near = near.empty() ? known : near;
  if (near.empty()) near = nearest(key, keys);
  problems.add(value, path, "is not a key of the scene" + (near.empty() ? "" : "; did you mean \"" + near + "\"?"));
  return nullptr;
}

bool overlap(const std::string& a, const std::string& b) {
  if (a == b) return true;
  const auto is_one_of = [](const std::string& one, const std::vector<std::string>& keys) {
    return std::ranges::find(keys, one) != keys.end();
  };
  return is_one_of(b, optimizer::flank_keys(a)) || is_one_of(a, optimizer::flank_keys(b));
}

}  // namespace dovetail::studies
