#include "geometry/exports/svg.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "core/replace_file.hpp"
#include "geometry/exports/millimetres.hpp"
#include "geometry/profile/measures.hpp"

namespace dovetail::geometry {

namespace {

/// Nanometres are finer than any drawing.
std::string number(double metres) {
  const double value = std::round(metres * kPerMillimetre * 1e6) / 1e6;
  return fmt::format("{}", value == 0 ? 0.0 : value);
}

/// y points down on the screen.
std::string point(const Eigen::Vector2d& at) {
  return number(at.x()) + " " + number(-at.y());
}

std::string path_data(const Chain& chain) {
  std::string data = "M " + point(chain.front().start);
  for (const Edge& e : chain) {
    if (e.is_arc())
      data += fmt::format(" A {0} {0} 0 {1} {2} {3}", number(e.radius), std::abs(e.sweep) > std::numbers::pi ? 1 : 0,
                          e.sweep > 0 ? 0 : 1, point(e.end));
    else
      data += " L " + point(e.end);
  }
  return data + " Z";
}

std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

}  // namespace

std::string svg(std::span<const Layer> layers, const std::optional<Eigen::AlignedBox2d>& window) {
  Eigen::AlignedBox2d box;
  for (const Layer& layer : layers) box.extend(bounding_box(layer.chain));
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(0.02 * box.sizes().maxCoeff());
  box = window.value_or(Eigen::AlignedBox2d(box.min() - margin, box.max() + margin));
  const Eigen::Vector2d size = box.sizes();

  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}mm\" height=\"{1}mm\" viewBox=\"{2} {3} {0} {1}\" "
      "role=\"img\">\n",
      number(size.x()), number(size.y()), number(box.min().x()), number(-box.max().y()));
  constexpr std::array kFill{"#9db8d6", "#d9d4c7", "#c9dcc3", "#e3c8c8"};
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const std::string name = lower_case(layers[i].name);
    text += fmt::format(
        "<path class=\"{0}\" d=\"{1}\" fill=\"{2}\" stroke=\"#333\" stroke-width=\"1\" "
        "vector-effect=\"non-scaling-stroke\"><title>{0}</title></path>\n",
        name, path_data(layers[i].chain), kFill[i % kFill.size()]);
  }
  return text + "</svg>\n";
}

void write_svg(const std::filesystem::path& file, std::span<const Layer> layers,
               const std::optional<Eigen::AlignedBox2d>& window) {
  replace_file(file, svg(layers, window));
}

}  // namespace dovetail::geometry
