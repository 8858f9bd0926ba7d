// Prints the table verdict_labels.inc, in some minutes; with the name of a family only its lines.
//   label_verdicts [FAMILY] > verdict_labels.inc
#include <cstdio>
#include <string>

#include "verdict_labels.hpp"

namespace dovetail::wear::scenes {
namespace {

void print(Family family, unsigned members) {
  for (unsigned number = 0; number < members; ++number) {
    const auto model = std::make_shared<const dynamics::CondensedModel>(verdict_model(family, number));
    const Label label = explicit_label(model, 1.0, kVerdictSettings);
    std::printf("%s{Family::%s, %u, Label::%s},\n", label == Label::open ? "// " : "",
                std::string(to_string(family)).c_str(), number, std::string(to_string(label)).c_str());
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace dovetail::wear::scenes

int main(int count, char** arguments) {
  using namespace dovetail::wear::scenes;
  const std::string only = count > 1 ? arguments[1] : "";
  for (const Family family : {Family::crowned, Family::coupled, Family::breathing, Family::sliding, Family::sprung})
    if (only.empty() || only == to_string(family)) print(family, 16);
  for (const Family family :
       {Family::punch, Family::interference, Family::hopping, Family::space, Family::space_sprung})
    if (only.empty() || only == to_string(family)) print(family, 8);
}
