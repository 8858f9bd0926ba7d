#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "studies/program/study_file/study.hpp"

namespace dovetail::python {

/// A study file and the values that were set besides, as --set has them.
class StudyFile {
 public:
  /// Of the directory of a run its best design. Throws InputError for a file that is not valid.
  explicit StudyFile(const std::string& path);

  /// Throws InputError, and then the study is as before.
  void set(const std::string& key, const pybind11::handle& value);

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] const std::vector<std::string>& assignments() const { return set_; }  ///< KEY=VALUE
  [[nodiscard]] studies::Study read() const;
  /// With the values that were set in its text, so that the files of a run have them.
  [[nodiscard]] studies::Study rewritten() const;

 private:
  std::string path_;
  std::vector<std::string> set_;
};

void bind_study(pybind11::module_& module);

}  // namespace dovetail::python
