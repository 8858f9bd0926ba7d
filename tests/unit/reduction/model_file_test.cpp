#include "reduction/model_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <Eigen/Dense>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <string>

#include "core/hdf5_file.hpp"
#include "reduction/massless_boundary.hpp"
#include "reduction/validation.hpp"
#include "tests/unit/reduction/truss_model.hpp"

namespace dovetail::reduction {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class ModelFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("dovetail_model_file_" + std::to_string(getpid()) + "_" +
                                                        testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
    path_ = (folder_ / "model.h5").string();
    model_ = reduce(truss_model({.speed = 5}), {.modes = 4}).model;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  // The sentence with which reading is refused; empty when the file is accepted.
  std::string refusal() const {
    try {
      (void)read_model(path_);
      return {};
    } catch (const InputError& error) {
      return error.what();
    }
  }

  // Writes the valid model except `left_out`, then whatever `add` puts there.
  void write_with(const std::string& left_out, const std::function<void(hdf5::File&)>& add) const {
    const auto size = [](Eigen::Index n) { return static_cast<std::size_t>(n); };
    hdf5::File file = hdf5::File::create(path_);
    if (left_out != "format") file.write_attribute("/", "format", std::string("dovetail-reduced-model"));
    if (left_out != "version") file.write_attribute("/", "version", std::int64_t{1});
    const auto real = [&](const std::string& name, const Eigen::MatrixXd& m) {
      if (name == left_out) return;
      const Eigen::MatrixXd by_rows = m.transpose();
      const std::size_t shape[] = {size(m.rows()), size(m.cols())};
      file.write(name, std::span<const double>(by_rows.data(), size(m.size())), shape);
    };
    const auto list = [&](const std::string& name, const Eigen::VectorXd& v) {
      if (name != left_out) file.write(name, std::span<const double>(v.data(), size(v.size())));
    };
    real("/mass", model_.mass);
    real("/damping", model_.damping);
    real("/stiffness", model_.stiffness);
    const std::vector<std::int64_t> normal(model_.contact.normal.begin(), model_.contact.normal.end());
    const std::vector<std::int64_t> tangential(model_.contact.tangential.data(), model_.contact.tangential.data() + 4);
    const std::size_t column[] = {4, 1};
    if (left_out != "/contact/normal") file.write("/contact/normal", std::span<const std::int64_t>(normal));
    if (left_out != "/contact/tangential") file.write("/contact/tangential", tangential, column);
    list("/contact/area", model_.contact.area);
    list("/contact/gap", model_.contact.gap);
    list("/contact/friction", model_.contact.friction);
    list("/contact/wear_coefficient", model_.contact.wear_coefficient);
    list("/force/static", model_.static_force);
    real("/force/cosine", model_.cosine_force);
    real("/force/sine", model_.sine_force);
    real("/output/vectors", model_.output_vectors);
    if (left_out != "/output/names") file.write("/output/names", std::span<const std::string>(model_.output_names));
    if (add) add(file);
    file.close();
  }

  std::string refusal_of(const std::function<void(ReducedModel&)>& spoil) {
    ReducedModel spoiled = model_;
    spoil(spoiled);
    const ReducedModel kept = model_;
    model_ = spoiled;
    write_with({}, {});
    model_ = kept;
    return refusal();
  }

  std::filesystem::path folder_;
  std::string path_;
  ReducedModel model_;
};

TEST_F(ModelFile, ReturnsWhatWasWrittenToTheLastBit) {
  model_.contact.position = Eigen::MatrixX3d::Random(4, 3);
  model_.contact.group = Eigen::VectorXi::LinSpaced(4, 0, 3);
  model_.contact.slip_origin = 1e-6 * Eigen::MatrixXd::Random(4, 1);
  model_.contact.gap(2) = -1.0 / 3.0;
  model_.output_names = {"tip", "Spitze \xc3\xa4"};
  write_model(path_, model_);
  const ReducedModel read = read_model(path_);
  EXPECT_EQ(read.mass, model_.mass);
  EXPECT_EQ(read.damping, model_.damping);
  EXPECT_EQ(read.stiffness, model_.stiffness);
  EXPECT_EQ(read.contact.normal, model_.contact.normal);
  EXPECT_EQ(read.contact.tangential, model_.contact.tangential);
  EXPECT_EQ(read.contact.area, model_.contact.area);
  EXPECT_EQ(read.contact.gap, model_.contact.gap);
  EXPECT_EQ(read.contact.friction, model_.contact.friction);
  EXPECT_EQ(read.contact.wear_coefficient, model_.contact.wear_coefficient);
  EXPECT_EQ(read.contact.position, model_.contact.position);
  EXPECT_EQ(read.contact.group, model_.contact.group);
  EXPECT_EQ(read.contact.slip_origin, model_.contact.slip_origin);
  EXPECT_EQ(read.static_force, model_.static_force);
  EXPECT_EQ(read.cosine_force, model_.cosine_force);
  EXPECT_EQ(read.sine_force, model_.sine_force);
  EXPECT_EQ(read.output_vectors, model_.output_vectors);
  EXPECT_EQ(read.output_names, model_.output_names);
}

TEST_F(ModelFile, LeavesOnlyTheFileAskedFor) {
  write_model(path_, model_);
  write_model(path_, model_);
  const auto entries = std::filesystem::directory_iterator(folder_);
  EXPECT_EQ(std::distance(begin(entries), end(entries)), 1);
}

TEST_F(ModelFile, KeepsTheOldFileWhenTheNewModelIsInvalid) {
  write_model(path_, model_);
  ReducedModel spoiled = model_;
  spoiled.contact.area(0) = -1;
  EXPECT_THROW(write_model(path_, spoiled), InputError);
  EXPECT_EQ(refusal(), "");
}

TEST_F(ModelFile, ReadsDefaultsOfOptionalDataSets) {
  write_with({}, {});
  const ReducedModel read = read_model(path_);
  EXPECT_EQ(read.contact.position.rows(), 0);
  EXPECT_EQ(read.contact.group.size(), 0);
  EXPECT_EQ(read.contact.slip_origin, Eigen::MatrixXd::Zero(4, 1));
}

TEST_F(ModelFile, RefusesAMissingFile) {
  EXPECT_THAT(refusal(), AllOf(HasSubstr("model.h5"), HasSubstr("does not exist")));
}

TEST_F(ModelFile, RefusesAFileThatIsNotHdf5) {
  std::ofstream(path_) << "not a model";
  EXPECT_THAT(refusal(), HasSubstr("must be an HDF5 file"));
}

TEST_F(ModelFile, RefusesEveryTruncation) {
  write_model(path_, model_);
  const std::uintmax_t size = std::filesystem::file_size(path_);
  for (std::uintmax_t part = 1; part < 20; ++part) {
    write_model(path_, model_);
    std::filesystem::resize_file(path_, size * part / 20);
    EXPECT_THAT(refusal(), HasSubstr("model.h5")) << part;
  }
}

TEST_F(ModelFile, SurvivesAnyDamagedByte) {
  write_model(path_, model_);
  const auto size = static_cast<std::int64_t>(std::filesystem::file_size(path_));
  for (std::int64_t place = 0; place < size; place += 97) {
    write_model(path_, model_);
    std::fstream file(path_, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(place);
    file.put('\xff');
    file.close();
    (void)refusal();  // accepted or refused with InputError: nothing else may escape
  }
}

TEST_F(ModelFile, RefusesAnotherFormat) {
  write_with("format", {});
  EXPECT_THAT(refusal(), AllOf(HasSubstr("attribute format"), HasSubstr("missing")));
  write_with("format", [](hdf5::File& f) { f.write_attribute("/", "format", std::string("nastran")); });
  EXPECT_THAT(refusal(), HasSubstr("= nastran: must be dovetail-reduced-model"));
  write_with("format", [](hdf5::File& f) { f.write_attribute("/", "format", std::int64_t{3}); });
  EXPECT_THAT(refusal(), HasSubstr("must be one string"));
}

TEST_F(ModelFile, RefusesOtherVersions) {
  write_with("version", {});
  EXPECT_THAT(refusal(), AllOf(HasSubstr("attribute version"), HasSubstr("missing")));
  write_with("version", [](hdf5::File& f) { f.write_attribute("/", "version", std::int64_t{2}); });
  EXPECT_THAT(refusal(), HasSubstr("= 2: the file is newer than this program, which reads version 1"));
  write_with("version", [](hdf5::File& f) { f.write_attribute("/", "version", std::int64_t{0}); });
  EXPECT_THAT(refusal(), HasSubstr("must be 1"));
  write_with("version", [](hdf5::File& f) { f.write_attribute("/", "version", std::string("1")); });
  EXPECT_THAT(refusal(), HasSubstr("must be one integer"));
}

TEST_F(ModelFile, NamesEachMissingDataSet) {
  for (const char* name : {"/mass", "/damping", "/stiffness", "/contact/normal", "/contact/tangential", "/contact/area",
                           "/contact/gap", "/contact/friction", "/contact/wear_coefficient", "/force/static",
                           "/force/cosine", "/force/sine", "/output/vectors", "/output/names"}) {
    write_with(name, {});
    EXPECT_EQ(refusal(), path_ + ": " + name + ": the data set is missing");
  }
}

TEST_F(ModelFile, ReportsEverythingWrongAtOnce) {
  write_with("/mass", [](hdf5::File& f) { f.write("/contact/group", std::vector<double>(4, 0.0)); });
  EXPECT_THAT(refusal(), AllOf(HasSubstr("/mass"), HasSubstr("/contact/group"), HasSubstr("\n")));
}

TEST_F(ModelFile, RefusesWrongTypes) {
  write_with("/contact/normal", [](hdf5::File& f) { f.write("/contact/normal", std::vector<double>{0, 2, 4, 6}); });
  EXPECT_THAT(refusal(), HasSubstr("/contact/normal = floating point: must be an array of 64-bit integers"));
  write_with("/contact/area", [](hdf5::File& f) {
    f.write("/contact/area", std::vector<std::string>{"a", "b", "c", "d"});
  });
  EXPECT_THAT(refusal(), HasSubstr("/contact/area = string: must be an array of 64-bit floating-point numbers"));
  write_with("/output/names", [](hdf5::File& f) { f.write("/output/names", std::vector<double>{1, 2}); });
  EXPECT_THAT(refusal(), HasSubstr("/output/names = floating point: must be an array of strings"));
  write_with("/mass", [](hdf5::File& f) { f.make_group("/mass"); });
  EXPECT_THAT(refusal(), HasSubstr("/mass: must be a data set, not a group"));
}

TEST_F(ModelFile, RefusesWrongShapes) {
  write_with("/mass", [](hdf5::File& f) { f.write("/mass", std::vector<double>(9, 0.0)); });
  EXPECT_THAT(refusal(), HasSubstr("/mass = shape [9]: must be a table"));
  write_with("/contact/gap", [](hdf5::File& f) { f.write("/contact/gap", std::vector<double>(3, 0.0)); });
  EXPECT_THAT(refusal(), HasSubstr("/contact/gap = shape [3]: must have shape [4]"));
  write_with({}, [](hdf5::File& f) { f.write("/contact/group", std::vector<std::int64_t>{}); });
  EXPECT_THAT(refusal(), HasSubstr("/contact/group = 0 rows"));
  const auto widen = [](ReducedModel& m) { m.sine_force.setZero(2, m.size()); };
  EXPECT_THAT(refusal_of(widen), HasSubstr("/force/sine = shape [2,"));
  EXPECT_THAT(refusal_of([](ReducedModel& m) { m.stiffness.conservativeResize(m.size(), m.size() + 1); }),
              HasSubstr("/stiffness = shape"));
  write_with({}, [](hdf5::File& f) {
    const std::size_t shape[] = {4, 2};
    f.write("/contact/position", std::vector<double>(8, 0.0), shape);
  });
  EXPECT_THAT(refusal(), HasSubstr("/contact/position = 2 columns"));
}

TEST_F(ModelFile, RefusesWrongValues) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal_of([&](ReducedModel& m) { m.stiffness(1, 2) = nan; }),
              HasSubstr("/stiffness[1,2] = nan: must be a finite number"));
  EXPECT_THAT(refusal_of([](ReducedModel& m) { m.static_force(3) = kInfinity; }), HasSubstr("/force/static[3] = inf"));
  EXPECT_THAT(refusal_of([](ReducedModel& m) { m.stiffness(9, 8) += 1e6; }),
              AllOf(HasSubstr("/stiffness["), HasSubstr("must be symmetric")));
  EXPECT_THAT(refusal_of([](ReducedModel& m) { m.mass(0, 0) = -1; }), HasSubstr("must be >= 0"));
  EXPECT_THAT(refusal_of([](ReducedModel& m) { m.contact.area(1) = 0; }),
              HasSubstr("/contact/area[1] = 0: must be > 0"));
  EXPECT_THAT(refusal_of([](ReducedModel& m) { m.contact.friction(2) = -0.1; }),
              HasSubstr("/contact/friction[2] = -0.1: must be >= 0"));
  EXPECT_THAT(refusal_of([&](ReducedModel& m) { m.contact.wear_coefficient(0) = nan; }),
              HasSubstr("/contact/wear_coefficient[0] = nan"));
  EXPECT_THAT(refusal_of([](ReducedModel& m) { m.contact.normal(3) = 99; }),
              HasSubstr("/contact/normal[3] = 99: must be an index from 0 to"));
  EXPECT_THAT(refusal_of([](ReducedModel& m) { m.contact.tangential(0, 0) = m.contact.normal(2); }),
              HasSubstr("/contact/tangential[0,0] = 4: must be a dof of its own, but /contact/normal[2] is the same"));
  EXPECT_THAT(refusal_of([](ReducedModel& m) {
                m.output_names = {"tip", "tip"};
              }),
              HasSubstr("/output/names[1] = tip"));
  write_with("/contact/normal", [](hdf5::File& f) {
    f.write("/contact/normal", std::vector<std::int64_t>{0, 2, 4, std::int64_t{1} << 40});
  });
  EXPECT_THAT(refusal(), HasSubstr("/contact/normal[3] = 1099511627776"));
}

TEST_F(ModelFile, KeepsTheWearLaw) {
  for (const contact::WearLaw* law : contact::wear_laws()) {
    SCOPED_TRACE(law->name);
    model_.contact.wear_law = law->name;
    const bool threshold = law->parameter(&contact::WearNumbers::threshold);
    model_.contact.wear_threshold = Eigen::VectorXd::LinSpaced(threshold ? 4 : 0, 1.0 / 3, 7);
    write_model(path_, model_);
    const ReducedModel read = read_model(path_);
    EXPECT_EQ(read.contact.wear_law, law->name);
    EXPECT_EQ(read.contact.wear_threshold, model_.contact.wear_threshold);
  }
}

TEST_F(ModelFile, RefusesAThresholdThatTheLawDoesNotHave) {
  const auto threshold = [](hdf5::File& f) { f.write("/contact/wear_threshold", std::vector<double>(4, 3.0)); };
  write_with({}, threshold);
  const std::string refused = ": /contact/wear_threshold: has no meaning unless wear_law = \"energy\"";
  EXPECT_EQ(refusal(), path_ + refused);
  write_with({}, [&](hdf5::File& f) {
    threshold(f);
    f.write("/contact/wear_law", std::vector<std::string>{"archard"});
  });
  EXPECT_EQ(refusal(), path_ + refused);
  write_with({}, [&](hdf5::File& f) {
    threshold(f);
    f.write("/contact/wear_law", std::vector<std::string>{"energy"});
  });
  EXPECT_EQ(refusal(), "");
  model_.contact.wear_threshold = Eigen::VectorXd::Zero(4);
  EXPECT_THROW(write_model(path_, model_), InputError);
}

TEST_F(ModelFile, RefusesAWearLawThatThereIsNot) {
  const auto law = [&](const std::vector<std::string>& names) {
    write_with({}, [&](hdf5::File& f) { f.write("/contact/wear_law", names); });
    return refusal();
  };
  EXPECT_THAT(law({"gravity"}), HasSubstr("model.h5: /contact/wear_law = gravity: must be one of archard, energy"));
  EXPECT_EQ(law({"archard", "energy"}), path_ + ": /contact/wear_law = 2 texts: must be one text");
}

TEST_F(ModelFile, RefusesAPathThatCannotBeWritten) {
  EXPECT_THROW(write_model((folder_ / "absent" / "model.h5").string(), model_), InputError);
  EXPECT_THROW(write_model(folder_.string(), model_), InputError);
}

TEST_F(ModelFile, Hdf5FileKeepsAttributesGroupsAndArraysOfAnyRank) {
  {
    hdf5::File file = hdf5::File::create(path_);
    const std::size_t cube[] = {2, 1, 3};
    file.write("/a/b/cube", std::vector<double>{1, 2, 3, 4, 5, 6}, cube);
    file.write("/a/scalar", std::vector<std::int64_t>{-7}, {});
    file.write_attribute("/a/b/cube", "unit", std::string("m"));
    file.write_attribute("/a", "ratio", 0.1);
    file.write_attribute("/a", "ratio", 0.2);
    EXPECT_THROW(file.write("/a/scalar", std::vector<double>{1}), InputError);
    file.close();
  }
  const hdf5::File file = hdf5::File::open(path_);
  const hdf5::Array<double> cube = file.read_reals("/a/b/cube");
  EXPECT_EQ(cube.shape, (std::vector<std::size_t>{2, 1, 3}));
  EXPECT_EQ(cube.values, (std::vector<double>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(file.read_integers("/a/scalar").values, (std::vector<std::int64_t>{-7}));
  EXPECT_EQ(file.read_integers("/a/scalar").rank(), 0U);
  EXPECT_EQ(file.string_attribute("/a/b/cube", "unit"), "m");
  EXPECT_EQ(file.real_attribute("/a", "ratio"), 0.2);
  EXPECT_EQ(file.members("/a"), (std::vector<std::string>{"b", "scalar"}));
  EXPECT_TRUE(file.is_group("/a/b"));
  EXPECT_FALSE(file.exists("/a/c/d"));
  EXPECT_THROW((void)file.members("/a/scalar"), InputError);
}

}  // namespace
}  // namespace dovetail::reduction
