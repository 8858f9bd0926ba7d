#include "reduction/model_file.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/hdf5_file.hpp"
#include "reduction/validation.hpp"

namespace dovetail::reduction {

namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using RowMajorIndices = Eigen::Matrix<std::int64_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr const char* kFormat = "dovetail-reduced-model";
constexpr std::int64_t kVersion = 1;

std::string phrase(const std::vector<std::size_t>& shape) {
  std::string text = "shape [";
  for (std::size_t k = 0; k < shape.size(); ++k) text += (k ? "," : "") + std::to_string(shape[k]);
  return text + "]";
}

// Reads data sets one by one and keeps what is wrong with each, so that all is reported at once.
class Reader {
 public:
  Reader(const hdf5::File& file, std::vector<Violation>& found) : file_(file), found_(found) {}

  void matrix(const std::string& name, Eigen::MatrixXd& target) {
    attempt(name, 2, [&] {
      const hdf5::Array<double> array = file_.read_reals(name);
      target = Eigen::Map<const RowMajor>(array.values.data(), rows(array.shape), columns(array.shape));
    });
  }
  void vector(const std::string& name, Eigen::VectorXd& target) {
    attempt(name, 1, [&] {
      const hdf5::Array<double> array = file_.read_reals(name);
      target = Eigen::Map<const Eigen::VectorXd>(array.values.data(), rows(array.shape));
    });
  }
  void indices(const std::string& name, Eigen::VectorXi& target) {
    attempt(name, 1, [&] {
      const hdf5::Array<std::int64_t> array = file_.read_integers(name);
      if (!fits(name, array.values, 1)) return;
      target = Eigen::Map<const RowMajorIndices>(array.values.data(), rows(array.shape), 1).cast<int>();
    });
  }
  void indices(const std::string& name, Eigen::MatrixXi& target) {
    attempt(name, 2, [&] {
      const hdf5::Array<std::int64_t> array = file_.read_integers(name);
      if (!fits(name, array.values, array.shape[1])) return;
      target =
          Eigen::Map<const RowMajorIndices>(array.values.data(), rows(array.shape), columns(array.shape)).cast<int>();
    });
  }
  void strings(const std::string& name, std::vector<std::string>& target) {
    attempt(name, 1, [&] { target = file_.read_strings(name).values; });
  }

 private:
  static Eigen::Index rows(const std::vector<std::size_t>& shape) { return static_cast<Eigen::Index>(shape[0]); }
  static Eigen::Index columns(const std::vector<std::size_t>& shape) { return static_cast<Eigen::Index>(shape[1]); }

  template <class Read>
  void attempt(const std::string& name, std::size_t rank, const Read& read) {
    try {
      const std::vector<std::size_t> shape = file_.shape(name);
      if (shape.size() != rank) {
        found_.push_back(
            {.file = file_.path(),
             .line = 0,
             .key = name,
             .value = phrase(shape),
             .allowed = rank == 1 ? "must be a list (one dimension)" : "must be a table (two dimensions)"});
        return;
      }
      read();
    } catch (const InputError& error) {
      found_.insert(found_.end(), error.violations().begin(), error.violations().end());
    }
  }

  // Indices are int in memory; anything beyond is out of range of every model.
  bool fits(const std::string& name, const std::vector<std::int64_t>& values, std::size_t row_length) {
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (values[k] >= std::numeric_limits<int>::min() && values[k] <= std::numeric_limits<int>::max()) continue;
      const std::string place = row_length == 1
                                    ? "[" + std::to_string(k) + "]"
                                    : "[" + std::to_string(k / row_length) + "," + std::to_string(k % row_length) + "]";
      found_.push_back({.file = file_.path(),
                        .line = 0,
                        .key = name + place,
                        .value = std::to_string(values[k]),
                        .allowed = "must be the index of a dof"});
      return false;
    }
    return true;
  }

  const hdf5::File& file_;
  std::vector<Violation>& found_;
};

void check_header(const hdf5::File& file) {
  const auto refuse = [&](const std::string& key, const std::string& value, const std::string& allowed) {
    throw InputError({.file = file.path(), .line = 0, .key = key, .value = value, .allowed = allowed});
  };
  if (!file.has_attribute("/", "format"))
    refuse("attribute format of /", {}, std::string("is missing: a reduced model says ") + kFormat);
  const std::string format = file.string_attribute("/", "format");
  if (format != kFormat) refuse("attribute format of /", format, std::string("must be ") + kFormat);
  const std::int64_t version = file.integer_attribute("/", "version");
  if (version > kVersion)
    refuse("attribute version of /", std::to_string(version),
           "the file is newer than this program, which reads version " + std::to_string(kVersion));
  if (version != kVersion)
    refuse("attribute version of /", std::to_string(version), "must be " + std::to_string(kVersion));
}

[[noreturn]] void refuse_all(const std::string& path, std::vector<Violation> found) {
  for (Violation& violation : found) violation.file = path;
  throw InputError(std::move(found));
}

void write(hdf5::File& file, const std::string& name, const RowMajor& matrix) {
  const std::size_t shape[] = {static_cast<std::size_t>(matrix.rows()), static_cast<std::size_t>(matrix.cols())};
  file.write(name, std::span(matrix.data(), static_cast<std::size_t>(matrix.size())), shape);
}

void write(hdf5::File& file, const std::string& name, const Eigen::VectorXd& vector) {
  file.write(name, std::span(vector.data(), static_cast<std::size_t>(vector.size())));
}

void write(hdf5::File& file, const std::string& name, const Eigen::VectorXi& vector) {
  const std::vector<std::int64_t> values(vector.begin(), vector.end());
  file.write(name, values);
}

}  // namespace

ReducedModel read_model(const std::string& path) {
  const hdf5::File file = hdf5::File::open(path);
  check_header(file);
  std::vector<Violation> found;
  Reader read(file, found);
  ReducedModel model;
  read.matrix("/mass", model.mass);
  read.matrix("/damping", model.damping);
  read.matrix("/stiffness", model.stiffness);
  ContactNodes& contact = model.contact;
  read.indices("/contact/normal", contact.normal);
  read.indices("/contact/tangential", contact.tangential);
  read.vector("/contact/area", contact.area);
  read.vector("/contact/gap", contact.gap);
  read.vector("/contact/friction", contact.friction);
  read.vector("/contact/wear_coefficient", contact.wear_coefficient);
  if (file.exists("/contact/wear_threshold")) read.vector("/contact/wear_threshold", contact.wear_threshold);
  if (std::vector<std::string> law; file.exists("/contact/wear_law")) {
    read.strings("/contact/wear_law", law);
    if (law.size() == 1) contact.wear_law = law.front();
  }
  Eigen::MatrixXd position(0, 3);
  if (file.exists("/contact/position")) read.matrix("/contact/position", position);
  if (file.exists("/contact/group")) read.indices("/contact/group", contact.group);
  if (file.exists("/contact/slip_origin"))
    read.matrix("/contact/slip_origin", contact.slip_origin);
  else
    contact.slip_origin.setZero(contact.normal.size(), contact.tangential.cols());
  read.vector("/force/static", model.static_force);
  read.matrix("/force/cosine", model.cosine_force);
  read.matrix("/force/sine", model.sine_force);
  read.matrix("/output/vectors", model.output_vectors);
  read.strings("/output/names", model.output_names);
  // Optional data sets that are there must be complete: an empty one means "none" in memory only.
  const auto present = [&](const std::string& name, Eigen::Index rows) {
    if (file.exists(name) && rows != contact.normal.size())
      found.push_back({.file = path,
                       .line = 0,
                       .key = name,
                       .value = std::to_string(rows) + " rows",
                       .allowed = "must have one row per contact node, " + std::to_string(contact.normal.size())});
  };
  if (position.cols() != 3)
    found.push_back({.file = path,
                     .line = 0,
                     .key = "/contact/position",
                     .value = std::to_string(position.cols()) + " columns",
                     .allowed = "must have 3 columns, x y z"});
  if (!found.empty()) refuse_all(path, std::move(found));
  contact.position = position;
  present("/contact/position", contact.position.rows());
  present("/contact/group", contact.group.size());
  present("/contact/slip_origin", contact.slip_origin.rows());
  if (found.empty()) found = violations(model);
  if (!found.empty()) refuse_all(path, std::move(found));
  return model;
}

void write_model(const std::string& path, const ReducedModel& model) {
  if (std::vector<Violation> found = violations(model); !found.empty()) refuse_all(path, std::move(found));
  hdf5::write_and_rename(path, [&](hdf5::File& file) {
    file.write_attribute("/", "format", std::string(kFormat));
    file.write_attribute("/", "version", kVersion);
    write(file, "/mass", RowMajor(model.mass));
    write(file, "/damping", RowMajor(model.damping));
    write(file, "/stiffness", RowMajor(model.stiffness));
    const ContactNodes& contact = model.contact;
    write(file, "/contact/normal", contact.normal);
    const RowMajorIndices tangential = contact.tangential.cast<std::int64_t>();
    const std::size_t shape[] = {static_cast<std::size_t>(tangential.rows()),
                                 static_cast<std::size_t>(tangential.cols())};
    file.write("/contact/tangential", std::span(tangential.data(), static_cast<std::size_t>(tangential.size())), shape);
    write(file, "/contact/area", contact.area);
    write(file, "/contact/gap", contact.gap);
    write(file, "/contact/friction", contact.friction);
    write(file, "/contact/wear_coefficient", contact.wear_coefficient);
    if (contact.wear_threshold.size() > 0) write(file, "/contact/wear_threshold", contact.wear_threshold);
    if (contact.wear_law != ContactNodes().wear_law)
      file.write("/contact/wear_law", std::vector<std::string>{contact.wear_law});
    if (contact.position.rows() > 0) write(file, "/contact/position", RowMajor(contact.position));
    if (contact.group.size() > 0) write(file, "/contact/group", contact.group);
    if (contact.slip_origin.size() > 0) write(file, "/contact/slip_origin", RowMajor(contact.slip_origin));
    write(file, "/force/static", model.static_force);
    write(file, "/force/cosine", RowMajor(model.cosine_force));
    write(file, "/force/sine", RowMajor(model.sine_force));
    write(file, "/output/vectors", RowMajor(model.output_vectors));
    file.write("/output/names", model.output_names);
  });
}

}  // namespace dovetail::reduction
