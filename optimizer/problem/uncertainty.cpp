#include "optimizer/problem/uncertainty.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <bit>
#include <boost/math/distributions/normal.hpp>
#include <boost/random/sobol.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "core/errors.hpp"

namespace dovetail {

template <>
std::span<const Field<optimizer::RobustOptions>> option_table<optimizer::RobustOptions>() {
  using R = optimizer::RobustOptions;
  static const std::vector<Field<R>> fields{
      {.key = "rule",
       .member = &R::rule,
       .help = "Where uncertain numbers are looked at: at the corners of their ranges, on a Sobol sequence, by Gauss "
               "rules, or, nominal, nowhere but at the numbers that the file has."},
      {.key = "points",
       .member = &R::points,
       .range = {.lower = 0, .upper = 4096},
       .help = "Of the Sobol sequence, or of each Gauss rule (at most 20); 0: 16, or 3."},
      {.key = "quantile",
       .member = &R::quantile,
       .range = {.lower = 0, .upper = 1, .lower_open = true, .upper_open = true},
       .help = "Share of the samples that stays below where an objective or limit goes over the quantile."}};
  return fields;
}

}  // namespace dovetail

namespace dovetail::optimizer {

namespace {

/// Points of standard numbers - in [-1, 1], or of deviation 1 - and their weights.
struct Points {
  std::vector<std::vector<double>> at;
  std::vector<double> weight;
};

/// Nodes and weights of the Gauss rule of a distribution, by the eigenvalues of its Jacobi matrix [Golub, Welsch 1969].
void gauss(Distribution distribution, int points, std::vector<double>& nodes, std::vector<double>& weights) {
  Eigen::MatrixXd jacobi = Eigen::MatrixXd::Zero(points, points);
  for (int k = 1; k < points; ++k)
    jacobi(k, k - 1) = jacobi(k - 1, k) =
        distribution == Distribution::uniform ? k / std::sqrt(4.0 * k * k - 1) : std::sqrt(static_cast<double>(k));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> pairs(jacobi);
  for (int k = 0; k < points; ++k) {
    nodes.push_back(pairs.eigenvalues()(k));
    weights.push_back(std::pow(pairs.eigenvectors()(0, k), 2));
  }
}

/// Every combination of the nodes of each number.
Points product(const std::vector<std::vector<double>>& nodes, const std::vector<std::vector<double>>& weights) {
  Points all{.at = {{}}, .weight = {1}};
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    Points next;
    for (std::size_t i = 0; i < all.at.size(); ++i)
      for (std::size_t k = 0; k < nodes[n].size(); ++k) {
        next.at.push_back(all.at[i]);
        next.at.back().push_back(nodes[n][k]);
        next.weight.push_back(all.weight[i] * weights[n][k]);
      }
    all = std::move(next);
  }
  return all;
}

/// The first points of a Sobol sequence, from its corner on, each in the middle of its cell: so many points that are a
/// power of two have the mean of every number, and no number is at an end of its range.
std::vector<std::vector<double>> sobol_points(std::size_t numbers, int count) {
  const double cell = std::ldexp(1.0, -static_cast<int>(std::bit_width(static_cast<unsigned>(count - 1))));
  std::vector<std::vector<double>> points{std::vector<double>(numbers, cell / 2)};
  boost::random::sobol engine(numbers);
  while (points.size() < static_cast<std::size_t>(count)) {
    std::vector<double> point(numbers);
    for (double& unit : point)
      unit = std::ldexp(static_cast<double>(engine()), -std::numeric_limits<std::uint64_t>::digits);
    if (std::ranges::all_of(point, [](double unit) { return unit == 0; })) continue;  // some versions begin with it
    for (double& unit : point) unit += cell / 2;
    points.push_back(std::move(point));
  }
  return points;
}

Points points_of(const std::vector<Uncertain>& uncertain, const RobustOptions& options) {
  const std::size_t n = uncertain.size();
  std::vector<std::vector<double>> nodes(n), weights(n);
  if (options.rule == Rule::sobol) {
    Points sequence;
    const int count = options.points > 0 ? options.points : 16;
    const std::vector<std::vector<double>> units = sobol_points(n, count);
    for (const std::vector<double>& point : units) {
      std::vector<double> at;
      for (std::size_t i = 0; i < n; ++i)
        at.push_back(uncertain[i].distribution == Distribution::uniform
                         ? 2 * point[i] - 1
                         : boost::math::quantile(boost::math::normal(), point[i]));
      sequence.at.push_back(std::move(at));
      sequence.weight.push_back(1.0 / count);
    }
    return sequence;
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (options.rule == Rule::gauss) {
      gauss(uncertain[i].distribution, options.points > 0 ? options.points : 3, nodes[i], weights[i]);
    } else {
      const double end = uncertain[i].distribution == Distribution::uniform ? 1 : std::numbers::sqrt3;
      nodes[i] = {-end, end};
      weights[i] = {0.5, 0.5};
    }
  }
  Points all = product(nodes, weights);
  if (options.rule == Rule::corners) {
    // Together they weigh what the mean square of a number is of the square of its end, the same for both
    // distributions: the mean is then exact up to the third degree, the deviation of what is linear.
    constexpr double kCorners = 1.0 / 3;
    for (double& weight : all.weight) weight *= kCorners;
    all.at.insert(all.at.begin(), std::vector<double>(n, 0.0));
    all.weight.insert(all.weight.begin(), 1 - kCorners);
  }
  return all;
}

KeyChange change_at(const Uncertain& number, double standard) {
  const bool uniform = number.distribution == Distribution::uniform;
  const double middle = uniform ? (number.first + number.second) / 2 : number.first;
  const double half = uniform ? (number.second - number.first) / 2 : number.second;
  // The ends of a range are what the file says, to the last digit.
  const double value = uniform && standard == -1  ? number.first
                       : uniform && standard == 1 ? number.second
                                                  : middle + standard * half;
  if (number.of == Uncertain::Of::factor) return {.key = number.key, .value = 0, .times = value};
  return {.key = number.key, .value = value, .times = number.of == Uncertain::Of::offset ? 1.0 : 0.0};
}

}  // namespace

std::vector<LoadCase> sampled(const std::vector<LoadCase>& cases, const std::vector<Uncertain>& uncertain,
                              const RobustOptions& options, int most) {
  if (uncertain.empty()) return cases;
  const bool nominal = options.rule == Rule::nominal;
  const std::vector<LoadCase> alone{{.name = kSampleOfStudy, .changes = {}}};
  const std::vector<LoadCase>& of = cases.empty() ? alone : cases;
  double count = static_cast<double>(of.size());
  const double each = options.rule == Rule::gauss ? (options.points > 0 ? options.points : 3) : 2;
  if (options.rule == Rule::sobol)
    count *= options.points > 0 ? options.points : 16;
  else if (!nominal)
    count *= std::pow(each, static_cast<double>(uncertain.size())) + (options.rule == Rule::corners ? 1 : 0);
  if (count > most)
    throw InputError(Violation{.file = {},
                               .key = "robust.rule",
                               .value = std::string(to_string(options.rule)),
                               .allowed = "would make " + shortest(count) + " samples of each design; at most " +
                                          std::to_string(most) + " are computed"});
  const Points points = nominal ? Points{.at = {{}}, .weight = {1}} : points_of(uncertain, options);
  std::vector<LoadCase> samples;
  for (const LoadCase& load : of)
    for (std::size_t i = 0; i < points.at.size(); ++i) {
      LoadCase sample = load;
      sample.name = load.name + "/" + std::to_string(i + 1);
      sample.sample_of = load.name;
      sample.weight = load.weight * points.weight[i];
      sample.first_half = options.rule == Rule::sobol && i < points.at.size() / 2;
      for (std::size_t n = 0; n < points.at[i].size(); ++n) {
        const KeyChange change = change_at(uncertain[n], points.at[i][n]);
        // What a case sets itself is what is uncertain there.
        if (change.times == 0)
          std::erase_if(sample.changes, [&](const KeyChange& own) { return own.key == change.key; });
        sample.changes.push_back(change);
      }
      samples.push_back(std::move(sample));
    }
  return samples;
}

}  // namespace dovetail::optimizer
