#include "reduction/user_element.hpp"

#include <algorithm>
#include <cctype>
#include <limits>
#include <map>
#include <set>

#include "reduction/matrix_text.hpp"
#include "reduction/params.hpp"

namespace dovetail::reduction {

namespace {

std::string upper(std::string_view word) {
  std::string text(word);
  std::ranges::transform(text, text.begin(),
                         [](char c) { return static_cast<char>(std::toupper(static_cast<unsigned char>(c))); });
  return text;
}

/// Stars are blanks here: nodes stand in comments.
class ElementReader {
 public:
  ElementReader(const std::string& path, const std::string& text)
      : lines_(path, "user element", text, " ,=*\t\r\f\v", '\0') {}

  UserElement read() {
    while (lines_.next()) {
      const std::string first = upper(lines_.word(0)), second = lines_.count() > 1 ? upper(lines_.word(1)) : "";
      if (first == "USER" && second == "ELEMENT")
        begin();
      else if (first == "ELEMENT" && second == "NODES")
        part_ = Part::nodes;
      else if (first == "MATRIX")
        matrix();
      else if (std::isalpha(static_cast<unsigned char>(first[0])) == 0)
        numbers();
    }
    name_dofs();
    element_.stiffness = square(values_["STIFFNESS"]);
    element_.mass = square(values_["MASS"]);
    return std::move(element_);
  }

 private:
  enum class Part { other, nodes, matrix };
  static constexpr std::int64_t kMost = std::numeric_limits<int>::max();

  void begin() {
    if (count_ > 0) lines_.refuse(lines_.line(), "a second *USER ELEMENT", "must be the only one of its file");
    for (std::size_t i = 2; i + 1 < lines_.count(); ++i)
      if (upper(lines_.word(i)) == "NODES") count_ = lines_.whole(i + 1, 1, kMost, "the number of nodes");
    if (count_ == 0) lines_.refuse(lines_.line(), {}, "must say how many NODES there are");
  }

  void matrix() {
    part_ = Part::matrix;
    type_.clear();
    for (std::size_t i = 1; i + 1 < lines_.count(); ++i)
      if (upper(lines_.word(i)) == "TYPE") type_ = upper(lines_.word(i + 1));
  }

  void numbers() {
    if (part_ == Part::matrix) {
      for (std::size_t i = 0; i < lines_.count(); ++i) values_[type_].push_back(lines_.real(i));
    } else if (part_ == Part::nodes && static_cast<std::int64_t>(nodes_.size()) < count_) {
      for (std::size_t i = 0; i < lines_.count(); ++i) nodes_.push_back(lines_.whole(i, -kMost, kMost, "a node"));
    } else if (part_ == Part::nodes) {
      // The first node's directions; then from which node on there are others.
      const std::size_t first = directions_.empty() ? 0 : 1;
      std::vector<int>& list = directions_[first == 0 ? 1 : lines_.whole(0, 2, count_, "a place in the list of nodes")];
      for (std::size_t i = first; i < lines_.count(); ++i)
        list.push_back(static_cast<int>(lines_.whole(i, 1, 100, "a direction")));
    }
  }

  void name_dofs() {
    if (count_ == 0 || static_cast<std::int64_t>(nodes_.size()) != count_)
      lines_.refuse(0, std::to_string(nodes_.size()) + " nodes",
                    "must list as many under ** ELEMENT NODES as *USER ELEMENT says, " + std::to_string(count_));
    if (directions_.empty()) lines_.refuse(0, {}, "does not say which directions its nodes have");
    const std::vector<int>* list = &directions_.begin()->second;
    for (std::int64_t place = 1; place <= count_; ++place) {
      if (const auto other = directions_.find(place); other != directions_.end()) list = &other->second;
      for (const int direction : *list)
        element_.dofs.push_back({nodes_[static_cast<std::size_t>(place - 1)], direction});
    }
    if (std::set(element_.dofs.begin(), element_.dofs.end()).size() != element_.dofs.size())
      lines_.refuse(0, {}, "names a direction of a node twice");
    if (static_cast<std::int64_t>(element_.dofs.size()) > ModelFileParams{}.largest)
      lines_.refuse(0, std::to_string(element_.dofs.size()) + " degrees of freedom",
                    "must be at most " + std::to_string(ModelFileParams{}.largest));
  }

  [[nodiscard]] Eigen::MatrixXd square(const std::vector<double>& triangle) const {
    if (triangle.empty()) return {};
    const auto n = static_cast<Eigen::Index>(element_.dofs.size());
    if (static_cast<Eigen::Index>(triangle.size()) != n * (n + 1) / 2)
      lines_.refuse(0, std::to_string(triangle.size()) + " numbers",
                    "must be the triangle of " + std::to_string(n) + " rows, " + std::to_string(n * (n + 1) / 2));
    Eigen::MatrixXd matrix(n, n);
    auto value = triangle.begin();
    for (Eigen::Index row = 0; row < n; ++row)
      for (Eigen::Index column = 0; column <= row; ++column) matrix(row, column) = matrix(column, row) = *value++;
    return matrix;
  }

  MatrixText lines_;
  Part part_ = Part::other;
  std::int64_t count_ = 0;
  std::vector<std::int64_t> nodes_;
  std::map<std::int64_t, std::vector<int>> directions_;  ///< from that place on in the list of nodes
  std::string type_;
  std::map<std::string, std::vector<double>> values_;
  UserElement element_;
};

}  // namespace

bool is_user_element(const std::string& text) {
  MatrixText lines("", "", text, " ,=\t\r\f\v", '\0');
  while (lines.next() && lines.word(0).starts_with('*'))
    if (upper(lines.word(0)) == "*USER") return true;
  return false;
}

UserElement read_user_element(const std::string& path, const std::string& text) {
  return ElementReader(path, text).read();
}

}  // namespace dovetail::reduction
