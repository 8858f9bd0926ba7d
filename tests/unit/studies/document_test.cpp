#include "studies/program/study_file/document.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "studies/program/study_file/study.hpp"
#include "tests/unit/studies/sample_study.hpp"

namespace dovetail::studies {
namespace {

using testing::HasSubstr;

std::string refusal(const std::string& text) {
  try {
    (void)parse_document(text, "s.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

/// What the template says after --set with that assignment.
std::string after_set(const std::string& assignment) {
  try {
    Document document = parse_document(study_template("sample"), "s.toml");
    apply_overrides(document, std::vector{parse_override(assignment)});
    (void)read_study(document);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(Document, ValuesKnowTheirLine) {
  const Document document = parse_document("a = 1\n[b]\nc = \"x\"\n", "s.toml");
  EXPECT_EQ(document.root.find("b")->find("c")->begin.line, 3);
  EXPECT_EQ(document.root.find("a")->shown(), "1");
}

TEST(Document, WhatIsNotTomlIsOneSentenceWithItsLine) {
  for (const std::string text :
       {"a = \n", "[scene\n", "a = 1\na = 2\n", "a = \"unfinished\n", "\xff\xfe\x01 = 2\n", "a = 1 b = 2\n"}) {
    const std::string told = refusal(text);
    EXPECT_THAT(told, testing::MatchesRegex("s\\.toml:[0-9]+: not valid TOML: [^\n]+")) << text;
  }
  EXPECT_THAT(refusal(std::string("a = 1\0b", 7)), HasSubstr("contains binary data"));
}

TEST(Document, EveryTruncationIsRefusedOrReadsWithoutCrashing) {
  const std::string text = study_template("sample");
  for (std::size_t length = 0; length < text.size(); length += 7) (void)complaints(text.substr(0, length));
  EXPECT_NE(complaints(text.substr(0, text.size() / 3)), "");
}

TEST(Document, FilesThatCannotBeReadAreNamed) {
  for (const std::string file : {"/nonexistent/s.toml", "/"}) try {
      (void)load_document(file);
      ADD_FAILURE() << file;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(file + ": cannot be read: "));
    }
}

TEST(Override, ReplacesAndCreatesKeys) {
  Document document = parse_document("[a]\nb = 1\n", "s.toml");
  apply_overrides(document,
                  std::vector{parse_override("a.b=2.5"), parse_override("a.c = x y"), parse_override("d.e=true")});
  EXPECT_EQ(document.root.find("a")->find("b")->real, 2.5);
  EXPECT_EQ(document.root.find("a")->find("c")->text, "x y");
  EXPECT_TRUE(document.root.find("d")->find("e")->truth);
  EXPECT_EQ(after_set("geometry.left.flank_angle_deg=48"), "");
  EXPECT_EQ(after_set("solver.solver=newton"), "");
}

TEST(Override, MayLeaveTheBoundsOfAVariable) {
  Document document = parse_document(study_template("sample"), "s.toml");
  apply_overrides(document, std::vector{parse_override("geometry.neck_width_mm=20")});
  const Study study = read_study(document);
  EXPECT_DOUBLE_EQ(study.scene.geometry.neck_width, 0.020);
  EXPECT_EQ(study.problem.space.start().back(), 9.5);
}

TEST(Override, TheLastOneWins) {
  Document document = parse_document("", "s.toml");
  apply_overrides(document, std::vector{parse_override("a=1"), parse_override("a=2")});
  EXPECT_EQ(document.root.find("a")->whole, 2);
}

TEST(Override, ErrorsNameWhatWasTyped) {
  EXPECT_EQ(after_set("geometry.neck_width_mm=-3"), "s.toml: --set geometry.neck_width_mm=-3: must be > 0 and <= 1000");
  EXPECT_THAT(after_set("geometry.nek_width_mm=3"), HasSubstr("did you mean geometry.neck_width_mm?"));
  EXPECT_THAT(after_set("contact.friction=nan"), HasSubstr("--set contact.friction=nan: must be a number"));
  EXPECT_THAT(after_set("contact.friction=high"), HasSubstr("must be a number"));
  EXPECT_THAT(after_set("contact.friction.mu=1"), HasSubstr("contact.friction is not a section"));
  EXPECT_THAT(after_set("variable.lower=1"), HasSubstr("variable is not a section; change it in the file"));
  EXPECT_THAT(after_set("geometri.neck_width_mm=3"), HasSubstr("unknown section; did you mean geometry?"));
  for (const std::string wrong : {"geometry", "=3", "geometry.neck_width_mm="})
    EXPECT_THAT(after_set(wrong), HasSubstr("must be KEY=VALUE"));
}

}  // namespace
}  // namespace dovetail::studies
