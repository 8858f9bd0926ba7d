#include "studies/program/study_file/case_reader.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "core/errors.hpp"
#include "optimizer/cases.hpp"
#include "optimizer/problem/uncertainty.hpp"
#include "studies/program/study_file/scene_keys.hpp"

namespace dovetail::studies {

namespace {

using optimizer::DesignVariable;
using optimizer::LoadCase;
using optimizer::Parameter;

/// What belongs to a case itself.
constexpr std::array<std::string_view, 2> kOwn{"name", "weight"};

struct Given {
  std::string key;
  const Node* value;
};

/// All values below a table by their dotted paths.
void collect(const Node& table, const std::string& before, std::vector<Given>& found) {
  for (const Member& member : table.members) {
    const std::string key = before + member.key;
    if (member.value.kind == Node::Kind::table)
      collect(member.value, key + ".", found);
    else if (std::ranges::find(kOwn, key) == kOwn.end())
      found.push_back({.key = key, .value = &member.value});
  }
}

/// Why that key may not differ between cases; empty where it may.
std::string fixed(const Parameter& parameter, const optimizer::Scene& scene,
                  const std::vector<DesignVariable>& variables) {
  const std::string& key = parameter.key;
  for (const char* section : {"mesh.", "solver.", "limits."})
    if (key.starts_with(section)) return "is the same for all cases: give it once, outside of them";
  if (parameter.kind != Parameter::Kind::real && parameter.kind != Parameter::Kind::whole)
    return "cannot differ between cases: it is no number";
  for (const DesignVariable& variable : variables)
    if (overlap(variable.key, key) ||
        std::ranges::any_of(variable.also, [&](const std::string& also) { return overlap(also, key); }))
      return "is a design variable and cannot differ between cases";
  return parameter.left_aside(scene) ? "belongs to another wear law than the one in use" : "";
}

void read_change(const Given& given, const std::string& path, const optimizer::Scene& scene,
                 const std::vector<DesignVariable>& variables, Problems& problems, LoadCase& load) {
  const Node& value = *given.value;
  const Parameter* parameter = scene_key(given.key, value, path, problems);
  if (parameter == nullptr) return;
  if (const std::string why = fixed(*parameter, scene, variables); !why.empty()) return problems.add(value, path, why);
  const bool whole = parameter->kind == Parameter::Kind::whole;
  if (!value.is_number() || (whole && value.kind != Node::Kind::whole))
    return problems.add(value, path, whole ? "must be a whole number" : "must be a number");
  if (!parameter->range.contains(value.real)) return problems.add(value, path, parameter->range.phrase());
  for (const optimizer::KeyChange& before : load.changes)
    if (overlap(before.key, given.key)) return problems.add(value, path, "sets the same number as " + before.key);
  load.changes.push_back({.key = given.key, .value = value.real});
}

/// Where a study says nothing of the disk's material it is the blade's, in every case and sample.
void let_the_disk_follow(const Node* root, LoadCase& load) {
  constexpr std::string_view kBlade = "material.blade.", kDisk = "material.disk.";
  const std::vector<optimizer::KeyChange> changes = load.changes;
  for (const auto& [key, value, times] : changes) {
    if (!key.starts_with(kBlade)) continue;
    const std::string disk = std::string(kDisk) + key.substr(kBlade.size());
    const bool own = std::ranges::find(changes, disk, &optimizer::KeyChange::key) != changes.end();
    const bool given = root && (root->at(disk) || root->at(std::string(kDisk) + "grade"));
    if (!own && !given) load.changes.push_back({.key = disk, .value = value, .times = times});
  }
}

/// What numbers of a case contradict that those of the file do not.
void refuse_contradictions(const std::vector<Given>& given, const std::string& path, const optimizer::Scene& scene,
                           const LoadCase& load, Problems& problems) {
  for (const Violation& found : optimizer::contradictions(optimizer::in_case(scene, load))) {
    const auto changed = std::ranges::find(given, found.key, &Given::key);
    if (changed != given.end()) problems.add(*changed->value, path + "." + found.key, found.allowed);
  }
}

/// A name is part of names of responses, and of options that list cases.
bool is_case_name(const std::string& name) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) || c == '-' || c == '_' || c == '.'; };
  return !name.empty() && std::ranges::all_of(name, plain);
}

}  // namespace

std::vector<LoadCase> read_cases(SectionReader& root, const optimizer::Scene& scene,
                                 const std::vector<DesignVariable>& variables, Problems& problems) {
  std::vector<LoadCase> cases;
  for (const auto& [node, path] : entries(root, "case", problems)) {
    SectionReader section(node, path, problems);
    LoadCase load;
    load.name = section.text("name", {}, true).value_or("");
    load.weight = section.number("weight", kPositive).value_or(1);
    if (const Node* name = node->find("name"); name && name->kind == Node::Kind::text) {
      if (!is_case_name(load.name))
        problems.add(*name, section.path("name"), "must be letters, digits, '-', '_' and '.'");
      else if (named<optimizer::Over>(load.name))
        problems.add(*name, section.path("name"), "says how cases count; choose another name");
      else if (std::ranges::find(cases, load.name, &LoadCase::name) != cases.end())
        problems.add(*name, section.path("name"), "is the name of another case");
    }
    std::vector<Given> given;
    collect(*node, "", given);
    for (const Given& change : given) read_change(change, section.path(change.key), scene, variables, problems, load);
    if (problems.empty()) refuse_contradictions(given, path, scene, load, problems);
    cases.push_back(std::move(load));
  }
  return cases;
}

namespace {

using optimizer::Uncertain;

/// Whether that key follows from the variables, wherever uncertain numbers are looked at.
bool is_linked(const Node* root, const std::string& key) {
  const Node* list = root ? root->find("linked") : nullptr;
  return list != nullptr && std::ranges::any_of(list->items, [&](const Node& item) {
           const Node* linked = item.find("key");
           return linked != nullptr && linked->kind == Node::Kind::text && overlap(linked->text, key);
         });
}

/// A range, or mean and deviation, of an uncertain number: itself, what is added to it, or what it is multiplied by.
bool read_distribution(SectionReader& section, const Parameter& parameter, bool varied, Problems& problems,
                       Uncertain& number) {
  const Node& node = *section.node();
  const auto distribution = section.text("distribution", names_of<optimizer::Distribution>());
  const bool normal = distribution == to_string(optimizer::Distribution::normal);
  number.distribution = normal ? optimizer::Distribution::normal : optimizer::Distribution::uniform;
  const std::optional<double> lower = section.number("lower", parameter.range);
  const std::optional<double> upper = section.number("upper", parameter.range);
  const std::optional<double> plus_minus = section.number("plus_minus", kPositive);
  const std::optional<double> relative = section.number("relative", {.lower = 0, .upper = 1, .lower_open = true});
  const std::optional<double> mean = section.number("mean", parameter.range);
  const bool range = lower || upper;
  if (static_cast<int>(range) + static_cast<int>(plus_minus.has_value()) + static_cast<int>(relative.has_value()) !=
      1) {
    problems.missing(&node, section.path("key"),
                     "needs one of: lower and upper, plus_minus (in the unit of the key), relative (a share of it)");
    return false;
  }
  if (range && normal) {
    problems.add(node, section.path("distribution"), "of a normal one give plus_minus or relative, its deviation");
    return false;
  }
  if (range && varied) {
    problems.missing(&node, section.path("lower"),
                     "is of a design variable, or follows from some: give plus_minus or relative");
    return false;
  }
  if (range) {
    if (!lower || !upper || !(*lower < *upper)) {
      problems.missing(&node, section.path("upper"), "needs lower < upper");
      return false;
    }
    number.first = *lower;
    number.second = *upper;
    return true;
  }
  if (mean && (varied || relative)) {
    problems.add(*node.find("mean"), section.path("mean"),
                 "only has a meaning with plus_minus, of what is no variable");
    return false;
  }
  const double half = plus_minus.value_or(relative.value_or(0));
  const double middle = relative ? 1 : mean.value_or(0);
  number.of = relative ? Uncertain::Of::factor : mean ? Uncertain::Of::itself : Uncertain::Of::offset;
  number.first = normal ? middle : middle - half;
  number.second = normal ? half : middle + half;
  return true;
}

/// The name of the first case that sets a number whose range is the same for all; empty: none does.
std::string case_with(const std::vector<LoadCase>& cases, const Uncertain& number) {
  if (number.of != Uncertain::Of::itself) return {};
  for (const LoadCase& load : cases)
    if (std::ranges::any_of(load.changes, [&](const auto& change) { return overlap(change.key, number.key); }))
      return load.name;
  return {};
}

/// Samples that leave the range of their key, each key once.
void refuse_samples(SectionReader& root, const optimizer::Scene& scene, const std::vector<LoadCase>& samples,
                    Problems& problems) {
  std::vector<std::string> refused;
  for (const LoadCase& sample : samples)
    for (const Violation& wrong : optimizer::violations(optimizer::in_case(scene, sample)))
      for (const auto& [node, path] : entries(root, "uncertain", problems)) {
        const Node& key = *node->find("key");
        if (!overlap(key.text, wrong.key) || std::ranges::find(refused, key.text) != refused.end()) continue;
        refused.push_back(key.text);
        problems.add(key, path + ".key",
                     "becomes " + wrong.value + " in " + sample.name + " of its samples: " + wrong.allowed);
      }
}

}  // namespace

std::vector<LoadCase> read_samples(SectionReader& root, const optimizer::Scene& scene,
                                   const std::vector<DesignVariable>& variables, std::vector<LoadCase> cases,
                                   double& quantile, Problems& problems) {
  std::vector<Uncertain> uncertain;
  for (const auto& [node, path] : entries(root, "uncertain", problems)) {
    SectionReader section(node, path, problems);
    const std::optional<std::string> key = section.text("key", {}, true);
    const Node* at = node->find("key");
    const Parameter* parameter = key ? scene_key(*key, *at, section.path("key"), problems) : nullptr;
    if (parameter == nullptr) continue;
    const std::string why = fixed(*parameter, scene, {});
    const auto is_varied = [&](const DesignVariable& variable) {
      return overlap(variable.key, *key) ||
             std::ranges::any_of(variable.also, [&](const std::string& also) { return overlap(also, *key); });
    };
    const bool varied = std::ranges::any_of(variables, is_varied) || is_linked(root.node(), *key);
    Uncertain number{.key = *key};
    const bool known = read_distribution(section, *parameter, varied, problems, number);
    section.finish();
    if (!why.empty())
      problems.add(*at, section.path("key"), why);
    else if (parameter->kind != Parameter::Kind::real)
      problems.add(*at, section.path("key"), "is a whole number: give it a case for each value");
    else if (std::ranges::any_of(uncertain, [&](const Uncertain& other) { return overlap(other.key, *key); }))
      problems.add(*at, section.path("key"), "is uncertain already");
    else if (const std::string own = known ? case_with(cases, number) : ""; !own.empty())
      problems.add(*at, section.path("key"),
                   "has a number of its own in case " + own +
                       ", which a range would take the place of: give plus_minus or relative, about that of each case");
    else if (known)
      uncertain.push_back(std::move(number));
  }
  optimizer::RobustOptions options;
  SectionReader robust(root.take("robust"), "robust", problems);
  robust.fields(options, option_table<optimizer::RobustOptions>());
  robust.finish();
  quantile = options.quantile;
  if (options.rule == optimizer::Rule::gauss && options.points > 20)
    problems.add(*robust.node()->find("points"), "robust.points", "must be <= 20 of a Gauss rule");
  if (robust.node() && options.rule == optimizer::Rule::corners)
    if (const Node* points = robust.node()->find("points"))
      problems.add(*points, "robust.points", "is of the rules sobol and gauss: corners are what they are");
  if (!problems.empty()) return cases;
  try {
    std::vector<LoadCase> samples = optimizer::sampled(cases, uncertain, options);
    for (LoadCase& sample : samples) let_the_disk_follow(root.node(), sample);
    refuse_samples(root, scene, samples, problems);
    return samples;
  } catch (const InputError& error) {
    problems.missing(robust.node(), "robust.rule", error.violations().front().allowed);
  }
  return cases;
}

}  // namespace dovetail::studies
