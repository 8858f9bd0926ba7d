#include "studies/program/study_file/best_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/studies/sample_study.hpp"

namespace dovetail::studies {
namespace {

using testing::HasSubstr;

// Values whose shortest texts have many digits, an exponent and no point.
const std::map<std::string, double> kValues{
    {"geometry.neck_width_mm", 8.1234567890123}, {"geometry.flank_mismatch_um", 1e-7}, {"geometry.flank_crown_um", 3}};

void expect_reads_back(const std::string& text) {
  const Study study = read_study(parse_document(text, "best.toml"));
  for (const auto& [key, value] : kValues) EXPECT_EQ(optimizer::parameter(study.scene, key), value) << key;
}

TEST(BestFile, OnlyTheValuesChange) {
  const std::string text = study_template("sample");
  const std::string best = with_values(parse_document(text, "s.toml"), kValues);
  expect_reads_back(best);
  std::string undone = replaced(best, "neck_width_mm = 8.1234567890123", "neck_width_mm = 8.5");
  undone = replaced(undone, "flank_mismatch_um = 1e-07", "flank_mismatch_um = 0");
  EXPECT_EQ(replaced(undone, "flank_crown_um = 3.0", "flank_crown_um = 0"), text);
}

TEST(BestFile, KeysLeftToTheirDefaultAreAdded) {
  const std::string text = without(study_template("sample"), "flank_crown_um");
  const std::string best = with_values(parse_document(text, "s.toml"), kValues);
  expect_reads_back(best);
  EXPECT_THAT(best, HasSubstr("[geometry]\nflank_crown_um = 3.0\n"));
}

TEST(BestFile, SectionsThatAreAbsentAreAppended) {
  std::string text =
      replaced(study_template("sample"), "key = \"geometry.flank_crown_um\"", "key = \"geometry.left.flank_crown_um\"");
  text = without(text, "flank_crown_um");
  const std::string best = with_values(parse_document(text, "s.toml"), {{"geometry.left.flank_crown_um", 2.5}});
  EXPECT_EQ(optimizer::parameter(read_study(parse_document(best, "b")).scene, "geometry.left.flank_crown_um"), 2.5);
}

// Several keys of a section that is absent, with all that people wrote kept.
TEST(BestFile, AnAbsentSectionIsAppendedOnce) {
  std::string text = study_template("sample");
  const std::size_t begin = text.find("\n[mesh]\n"), end = text.find("\n[", begin + 1);
  text.erase(begin, end - begin);
  const std::string best =
      with_values(parse_document(text, "s.toml"), {{"mesh.flank_elements", 30}, {"mesh.bulk_size_mm", 2.5}});
  EXPECT_EQ(best, text + "\n[mesh]\nbulk_size_mm = 2.5\nflank_elements = 30\n");
}

TEST(BestFile, ColumnsCountCodePoints) {
  const std::string text =
      replaced(study_template("sample"), "neck_width_mm = 8.5", "\"neck_width_mm\" = 8.5 # \xc3\xa4\xe2\x82\xac");
  expect_reads_back(with_values(parse_document(text, "s.toml"), kValues));
}

TEST(BestFile, InlineTablesAreWrittenAnew) {
  std::string text = study_template("sample");
  text = without(text, "[contact]");
  const optimizer::Scene scene;
  optimizer::visit_contact_tables(scene.contact, [&](std::string_view, const auto&, auto fields) {
    for (const auto& field : fields) text = without(text, std::string(field.key));
  });
  text = replaced(text, "title = \"sample\"\n", "title = \"sample\"\ncontact = { friction = 0.4 }\n");
  text += "[[variable]]\nkey = \"contact.wear_coefficient_per_pa\"\nlower = 1e-14\nupper = 1e-12\n";
  const std::string best =
      with_values(parse_document(text, "s.toml"), {{"contact.wear_coefficient_per_pa", 1.2345678901234567e-13}});
  const Study study = read_study(parse_document(best, "best.toml"));
  EXPECT_EQ(study.scene.contact.wear.at("archard").coefficient, 1.2345678901234567e-13);
  EXPECT_EQ(study.scene.contact.friction, 0.4);
}

}  // namespace
}  // namespace dovetail::studies
