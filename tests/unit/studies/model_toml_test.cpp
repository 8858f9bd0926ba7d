#include "studies/program/engine/model_toml.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "core/errors.hpp"
#include "reduction/validation.hpp"

namespace dovetail::studies {
namespace {

using testing::HasSubstr;

class ModelToml : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("dovetail_model_toml_" + std::to_string(getpid()) + "_" +
                                                        testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
    put("k.mtx", "%%MatrixMarket matrix coordinate real symmetric\n3 3 4\n1 1 3\n2 2 1\n3 1 -1\n3 3 2\n");
    put("zero.mtx", "%%MatrixMarket matrix coordinate real symmetric\n3 3 0\n");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void put(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }

  [[nodiscard]] reduction::ReducedModel reading(const std::string& text) const {
    return read_model_document(parse_document(text, path("model.toml")));
  }
  /// What is said about the valid file with `found` replaced by `put`.
  [[nodiscard]] std::string refusal(const std::string& found, const std::string& put) const {
    std::string text = kByHand;
    const std::size_t at = text.find(found);
    EXPECT_NE(at, std::string::npos) << found;
    text.replace(at, found.size(), put);
    try {
      (void)reading(text);
      return {};
    } catch (const InputError& error) {
      return error.what();
    }
  }

  static constexpr const char* kByHand = R"(format = "dovetail-reduced-model"
version = 1
mass = "zero.mtx"
damping = "zero.mtx"
stiffness = "k.mtx"
[contact]
normal = [1]
tangential = [2]
area = 1e-6
gap = [-1e-3]
friction = 0.5
wear_coefficient = 1e-13
[[force]]
dof = 1
harmonic = 0
cosine = 20
[[force]]
dof = 0
harmonic = 2
sine = -0.5
[[output]]
name = "tip"
dofs = [0]
[[output]]
name = "twist"
dofs = [0, 2]
factors = [1, -1]
)";

  std::filesystem::path folder_;
};

TEST_F(ModelToml, ReadsAFileWrittenByHand) {
  const reduction::ReducedModel model = reading(kByHand);
  EXPECT_TRUE(reduction::violations(model).empty());
  EXPECT_EQ(model.stiffness, (Eigen::MatrixXd(3, 3) << 3, 0, -1, 0, 1, 0, -1, 0, 2).finished());
  EXPECT_EQ(model.contact.count(), 1);
  EXPECT_EQ(model.contact.tangential(0, 0), 2);
  EXPECT_EQ(model.contact.area(0), 1e-6);
  EXPECT_EQ(model.contact.gap(0), -1e-3);
  EXPECT_EQ(model.contact.slip_origin, Eigen::MatrixXd::Zero(1, 1));
  EXPECT_EQ(model.static_force, Eigen::Vector3d(0, 20, 0));
  EXPECT_EQ(model.cosine_force, Eigen::MatrixXd::Zero(2, 3));
  EXPECT_EQ(model.sine_force, (Eigen::MatrixXd(2, 3) << 0, 0, 0, -0.5, 0, 0).finished());
  EXPECT_EQ(model.output_names, (std::vector<std::string>{"tip", "twist"}));
  EXPECT_EQ(model.output_vectors, (Eigen::MatrixXd(2, 3) << 1, 0, 0, 1, 0, -1).finished());
}

TEST_F(ModelToml, IsKnownByItsFormat) {
  EXPECT_TRUE(is_model_document(parse_document(kByHand, "model.toml")));
  EXPECT_FALSE(is_model_document(parse_document("[scene]\ntype = \"section\"\n", "study.toml")));
}

TEST_F(ModelToml, ReturnsWhatWasWrittenToTheLastBit) {
  reduction::ReducedModel model;
  const Eigen::MatrixXd half = Eigen::MatrixXd::Random(8, 8);
  model.stiffness = half + half.transpose();
  model.mass = Eigen::MatrixXd::Identity(8, 8) / 3;
  model.damping = 1e-7 * model.stiffness;
  model.damping(0, 1) *= 1 + 1e-12;  // within what counts as symmetric
  reduction::ContactNodes& contact = model.contact;
  contact.normal = Eigen::VectorXi::LinSpaced(2, 2, 5);
  contact.tangential = (Eigen::MatrixXi(2, 2) << 3, 4, 6, 7).finished();
  contact.area = Eigen::Vector2d(1.0 / 3, 1e-300);
  contact.gap = Eigen::Vector2d(-0.0, -1.0 / 7);
  contact.friction = Eigen::Vector2d(0, 0.3);
  contact.wear_coefficient = Eigen::Vector2d(0, 1e-13);
  contact.position = Eigen::MatrixX3d::Random(2, 3);
  contact.group = Eigen::VectorXi::LinSpaced(2, 1, 0);
  contact.slip_origin = 1e-6 * Eigen::MatrixXd::Random(2, 2);
  model.static_force = Eigen::VectorXd::Random(8);
  model.cosine_force = Eigen::MatrixXd::Zero(4, 8);  // rows of zeros at the end are kept
  model.cosine_force(1, 3) = 0.1;
  model.sine_force = Eigen::MatrixXd::Zero(4, 8);
  model.sine_force(0, 2) = -1.0 / 3;
  model.output_vectors = Eigen::MatrixXd::Random(2, 8);
  model.output_names = {"tip \"quoted\"\t\\", "Spitze \xc3\xa4"};
  write_model_document(path("written.toml"), model, "a test");
  const reduction::ReducedModel read = read_model_document(load_document(path("written.toml")));
  EXPECT_EQ(read.mass, model.mass);
  EXPECT_EQ(read.damping, model.damping);
  EXPECT_EQ(read.stiffness, model.stiffness);
  EXPECT_EQ(read.contact.normal, contact.normal);
  EXPECT_EQ(read.contact.tangential, contact.tangential);
  EXPECT_EQ(read.contact.area, contact.area);
  EXPECT_EQ(read.contact.gap, contact.gap);
  EXPECT_TRUE(std::signbit(read.contact.gap(0)));
  EXPECT_EQ(read.contact.friction, contact.friction);
  EXPECT_EQ(read.contact.wear_coefficient, contact.wear_coefficient);
  EXPECT_EQ(read.contact.position, contact.position);
  EXPECT_EQ(read.contact.group, contact.group);
  EXPECT_EQ(read.contact.slip_origin, contact.slip_origin);
  EXPECT_EQ(read.static_force, model.static_force);
  EXPECT_EQ(read.cosine_force, model.cosine_force);
  EXPECT_EQ(read.sine_force, model.sine_force);
  EXPECT_EQ(read.output_vectors, model.output_vectors);
  EXPECT_EQ(read.output_names, model.output_names);
}

TEST_F(ModelToml, RefusesEachFlawWithItsLine) {
  EXPECT_THAT(refusal("version = 1", "version = 2"), HasSubstr(":2: version = 2: the file is newer"));
  EXPECT_THAT(refusal("version = 1\n", ""), HasSubstr("version: is missing; it must be 1"));
  EXPECT_THAT(refusal("mass = \"zero.mtx\"\n", ""), HasSubstr("mass: is missing; it must name a Matrix Market file"));
  EXPECT_THAT(refusal("\"k.mtx\"", "\"nowhere.mtx\""), HasSubstr("nowhere.mtx: cannot be read"));
  EXPECT_THAT(refusal("\"k.mtx\"", "[1]"), HasSubstr(":5: stiffness = [...]: must be the name of a Matrix Market"));
  EXPECT_THAT(refusal("normal = [1]", "normal = 1"), HasSubstr("contact.normal = 1: must be a list"));
  EXPECT_THAT(refusal("normal = [1]", "normal = [-1]"),
              HasSubstr("contact.normal[0] = -1: must be the index of a dof"));
  EXPECT_THAT(refusal("normal = [1]", "normal = [7]"),
              HasSubstr("contact.normal[0] = 7: must be an index from 0 to 2"));
  EXPECT_THAT(refusal("normal = [1]", "normal = [2]"), HasSubstr("must be a dof of its own"));
  EXPECT_THAT(refusal("tangential = [2]", "tangential = [2, 0]"),
              HasSubstr(":8: contact.tangential: has 2 entries, but contact.normal has 1"));
  EXPECT_THAT(refusal("tangential = [2]", "tangential = [[2, 0, 1]]"), HasSubstr("must be a list of 2"));
  EXPECT_THAT(refusal("tangential = [2]\n", ""), HasSubstr("contact.tangential: is missing"));
  EXPECT_THAT(refusal("area = 1e-6", "area = 0"), HasSubstr("contact.area[0] = 0: must be > 0"));
  EXPECT_THAT(refusal("area = 1e-6", "area = \"small\""), HasSubstr("contact.area = \"small\": must be a list"));
  EXPECT_THAT(refusal("gap = [-1e-3]", "gap = [nan]"), HasSubstr("contact.gap[0] = nan: must be a finite number"));
  EXPECT_THAT(refusal("friction = 0.5", "friction = [true]"),
              HasSubstr("contact.friction[0] = true: must be a number"));
  EXPECT_THAT(refusal("friction = 0.5", "frction = 0.5"), HasSubstr("did you mean contact.friction?"));
  EXPECT_THAT(refusal("friction = 0.5", "friction = 0.5\nwear_law = \"gravity\""),
              HasSubstr("contact.wear_law = \"gravity\": must be one of archard, energy"));
  EXPECT_THAT(refusal("friction = 0.5", "friction = 0.5\nwear_threshold = 3"),
              HasSubstr("contact.wear_threshold: has no meaning unless wear_law = \"energy\""));
  EXPECT_THAT(refusal("dof = 1\n", "dof = 3\n"), HasSubstr(":14: force[0].dof = 3: must be a dof from 0 to 2"));
  EXPECT_THAT(refusal("harmonic = 0\n", ""), HasSubstr("force[0].harmonic: is missing"));
  EXPECT_THAT(refusal("harmonic = 0\ncosine", "harmonic = 0\nsine"), HasSubstr("has no sine; give cosine"));
  EXPECT_THAT(refusal("cosine = 20\n", ""), HasSubstr("force[0]: needs cosine or sine"));
  EXPECT_THAT(refusal("dof = 0\nharmonic = 2", "dof = 1\nharmonic = 0"), HasSubstr("is given twice"));
  EXPECT_THAT(refusal("name = \"tip\"\n", ""), HasSubstr("output[0].name: is missing"));
  EXPECT_THAT(refusal("name = \"twist\"", "name = \"tip\""),
              HasSubstr("output.names[1] = tip: must be a name no other"));
  EXPECT_THAT(refusal("factors = [1, -1]", "factors = [1]"),
              HasSubstr("output[1].factors: must be as many as dofs, 2"));
  EXPECT_THAT(refusal("dofs = [0, 2]", "dofs = [0, 0]"), HasSubstr("must not name a dof twice"));
  EXPECT_THAT(refusal("[contact]", "[contacts]"), HasSubstr("contact.normal: is missing"));
}

TEST_F(ModelToml, SaysTheUnitsOfItsWearLaw) {
  reduction::ReducedModel model = reading(kByHand);
  const auto units = [&] {
    write_model_document(path("units.toml"), model, "");
    const std::string text = load_document(path("units.toml")).text, start = "Dofs count from 0; ";
    const std::size_t begin = text.find(start) + start.size();
    return text.substr(begin, text.find('\n', begin) - begin);
  };
  EXPECT_EQ(units(), "m, m^2, 1/Pa.");
  model.contact.wear_law = "energy";
  EXPECT_EQ(units(), "m, m^2, m^3/J, J/m^2.");
}

TEST_F(ModelToml, IsWrittenOnlyWhereItsMatricesCanStandBesideIt) {
  const reduction::ReducedModel model = reading(kByHand);
  EXPECT_THROW(write_model_document(path("model.h5"), model, ""), InputError);
  EXPECT_THROW(write_model_document(path("missing/model.toml"), model, ""), InputError);
  reduction::ReducedModel wrong = model;
  wrong.contact.area(0) = 0;
  EXPECT_THROW(write_model_document(path("wrong.toml"), wrong, ""), InputError);
  EXPECT_FALSE(std::filesystem::exists(path("wrong.toml")));
}

}  // namespace
}  // namespace dovetail::studies
