#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "studies/program/study_file/section_reader.hpp"

namespace dovetail::studies {

[[nodiscard]] inline std::string item(const std::string& path, std::size_t index) {
  return path + "[" + std::to_string(index) + "]";
}

/// Lists of numbers; what is wrong is reported at its place and read as nothing.
class Lists {
 public:
  /// - `counted`: the key whose list says how many contact nodes there are
  explicit Lists(Problems& problems, std::string counted = "contact.normal")
      : problems_(problems), counted_(std::move(counted)) {}

  std::optional<double> number(const Node& node, const std::string& path) {
    if (node.is_number()) return node.real;
    problems_.add(node, path, "must be a number");
    return std::nullopt;
  }
  std::optional<int> index(const Node& node, const std::string& path, const char* what = "the index of a dof, from 0") {
    if (node.kind == Node::Kind::whole && node.whole >= 0 && node.whole <= std::numeric_limits<int>::max())
      return static_cast<int>(node.whole);
    problems_.add(node, path, std::string("must be ") + what);
    return std::nullopt;
  }
  bool is_list(const Node& node, const std::string& path, const std::string& of) {
    if (node.kind == Node::Kind::list) return true;
    problems_.add(node, path, "must be a list of " + of);
    return false;
  }
  /// The numbers of a list, or one number for all `count`.
  Eigen::VectorXd numbers(const Node& node, const std::string& path, Eigen::Index count) {
    if (node.is_number()) return Eigen::VectorXd::Constant(count, node.real);
    Eigen::VectorXd values = Eigen::VectorXd::Zero(count);
    if (!is_list(node, path, "numbers, one for each contact node, or one number for all") || !fits(node, path, count))
      return values;
    for (std::size_t i = 0; i < node.items.size(); ++i)
      values[static_cast<Eigen::Index>(i)] = number(node.items[i], item(path, i)).value_or(0);
    return values;
  }
  Eigen::VectorXi indices(const Node& node, const std::string& path, const char* what = "the index of a dof, from 0") {
    if (!is_list(node, path, "whole numbers")) return {};
    Eigen::VectorXi values(static_cast<Eigen::Index>(node.items.size()));
    for (std::size_t i = 0; i < node.items.size(); ++i)
      values[static_cast<Eigen::Index>(i)] = index(node.items[i], item(path, i), what).value_or(0);
    return values;
  }
  /// A row for each contact node: lists of `columns` entries, or plain entries when that is 1.
  template <class Read>
  void rows(const Node& node, const std::string& path, Eigen::Index count, Eigen::Index columns, const Read& read) {
    if (!is_list(node, path, "one entry for each contact node") || !fits(node, path, count)) return;
    for (std::size_t i = 0; i < node.items.size(); ++i) {
      const Node& row = node.items[i];
      const std::string place = item(path, i);
      if (columns == 1 && row.kind != Node::Kind::list) {
        read(row, place, static_cast<Eigen::Index>(i), 0);
        continue;
      }
      if (row.kind != Node::Kind::list || static_cast<Eigen::Index>(row.items.size()) != columns) {
        problems_.add(row, place, "must be a list of " + std::to_string(columns));
        continue;
      }
      for (std::size_t k = 0; k < row.items.size(); ++k)
        read(row.items[k], item(place, k), static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
    }
  }

 private:
  bool fits(const Node& node, const std::string& path, Eigen::Index count) {
    if (static_cast<Eigen::Index>(node.items.size()) == count) return true;
    problems_.missing(&node, path,
                      "has " + std::to_string(node.items.size()) + " entries, but " + counted_ + " has " +
                          std::to_string(count) + ": must be one for each contact node");
    return false;
  }
  Problems& problems_;
  std::string counted_;
};

}  // namespace dovetail::studies
