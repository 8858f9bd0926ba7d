#include "reduction/model_file.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

#include "core/hdf5_file.hpp"
#include "reduction/validation.hpp"

namespace dovetail::reduction {

namespace {

/// What files hold for a matrix of real numbers or indices.
template <class Scalar>
using InFile = std::conditional_t<std::is_integral_v<Scalar>, std::int64_t, double>;
template <class Scalar>
using Rows = Eigen::Matrix<InFile<Scalar>, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

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

  /// A list or a table, of real numbers or of indices, as `target` is.
  template <class Target>
  void numbers(const std::string& name, Target& target) {
    using Scalar = typename Target::Scalar;
    constexpr bool kList = Target::ColsAtCompileTime == 1;
    attempt(name, kList ? 1 : 2, [&] {
      hdf5::Array<InFile<Scalar>> array;
      if constexpr (std::is_integral_v<Scalar>)
        array = file_.read_integers(name);
      else
        array = file_.read_reals(name);
      const std::size_t columns = kList ? 1 : array.shape[1];
      if constexpr (std::is_integral_v<Scalar>)
        if (!fits(name, array.values, columns)) return;
      target = Eigen::Map<const Rows<Scalar>>(array.values.data(), static_cast<Eigen::Index>(array.shape[0]),
                                              static_cast<Eigen::Index>(columns))
                   .template cast<Scalar>();
    });
  }
  void strings(const std::string& name, std::vector<std::string>& target) {
    attempt(name, 1, [&] { target = file_.read_strings(name).values; });
  }
  // A scalar, or a list of one.
  void one_string(const std::string& name, std::string& target) {
    const auto read = [&] {
      std::vector<std::string> values = file_.read_strings(name).values;
      if (values.size() == 1)
        target = std::move(values.front());
      else
        found_.push_back({.file = file_.path(),
                          .line = 0,
                          .key = name,
                          .value = std::to_string(values.size()) + " texts",
                          .allowed = "must be one text"});
    };
    attempt(name, 1, read, true);
  }

 private:
  template <class Read>
  void attempt(const std::string& name, std::size_t rank, const Read& read, bool or_scalar = false) {
    try {
      const std::vector<std::size_t> shape = file_.shape(name);
      if (shape.size() != rank && !(or_scalar && shape.empty())) {
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

template <class Matrix>
void write(hdf5::File& file, const std::string& name, const Matrix& matrix) {
  const Rows<typename Matrix::Scalar> rows = matrix.template cast<InFile<typename Matrix::Scalar>>();
  std::vector<std::size_t> shape{static_cast<std::size_t>(matrix.rows())};
  if (Matrix::ColsAtCompileTime != 1) shape.push_back(static_cast<std::size_t>(matrix.cols()));
  file.write(name, std::span(rows.data(), static_cast<std::size_t>(rows.size())), shape);
}

}  // namespace

ReducedModel read_model(const std::string& path) {
  const hdf5::File file = hdf5::File::open(path);
  check_header(file);
  std::vector<Violation> found;
  Reader read(file, found);
  ReducedModel model;
  read.numbers("/mass", model.mass);
  read.numbers("/damping", model.damping);
  read.numbers("/stiffness", model.stiffness);
  ContactNodes& contact = model.contact;
  read.numbers("/contact/normal", contact.normal);
  read.numbers("/contact/tangential", contact.tangential);
  read.numbers("/contact/area", contact.area);
  read.numbers("/contact/gap", contact.gap);
  read.numbers("/contact/friction", contact.friction);
  read.numbers("/contact/wear_coefficient", contact.wear_coefficient);
  if (file.exists("/contact/wear_threshold")) read.numbers("/contact/wear_threshold", contact.wear_threshold);
  if (file.exists("/contact/wear_law")) read.one_string("/contact/wear_law", contact.wear_law);
  Eigen::MatrixXd position(0, 3);
  if (file.exists("/contact/position")) read.numbers("/contact/position", position);
  if (file.exists("/contact/group")) read.numbers("/contact/group", contact.group);
  if (file.exists("/contact/slip_origin"))
    read.numbers("/contact/slip_origin", contact.slip_origin);
  else
    contact.slip_origin.setZero(contact.normal.size(), contact.tangential.cols());
  read.numbers("/force/static", model.static_force);
  read.numbers("/force/cosine", model.cosine_force);
  read.numbers("/force/sine", model.sine_force);
  read.numbers("/output/vectors", model.output_vectors);
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
  present("/contact/wear_threshold", contact.wear_threshold.size());
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
    write(file, "/mass", model.mass);
    write(file, "/damping", model.damping);
    write(file, "/stiffness", model.stiffness);
    const ContactNodes& contact = model.contact;
    write(file, "/contact/normal", contact.normal);
    write(file, "/contact/tangential", contact.tangential);
    write(file, "/contact/area", contact.area);
    write(file, "/contact/gap", contact.gap);
    write(file, "/contact/friction", contact.friction);
    write(file, "/contact/wear_coefficient", contact.wear_coefficient);
    if (contact.wear_threshold.size() > 0) write(file, "/contact/wear_threshold", contact.wear_threshold);
    if (contact.wear_law != ContactNodes().wear_law)
      file.write("/contact/wear_law", std::vector<std::string>{contact.wear_law});
    if (contact.position.rows() > 0) write(file, "/contact/position", contact.position);
    if (contact.group.size() > 0) write(file, "/contact/group", contact.group);
    if (contact.slip_origin.size() > 0) write(file, "/contact/slip_origin", contact.slip_origin);
    write(file, "/force/static", model.static_force);
    write(file, "/force/cosine", model.cosine_force);
    write(file, "/force/sine", model.sine_force);
    write(file, "/output/vectors", model.output_vectors);
    file.write("/output/names", model.output_names);
  });
}

}  // namespace dovetail::reduction
