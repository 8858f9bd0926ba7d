#include "tests/verification/calculix/calculix.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace dovetail::calculix {

namespace {

namespace fs = std::filesystem;

constexpr double kMetre = 1e-3;  // per mm
constexpr double kPascal = 1e6;  // per MPa

/// A folder that goes when it is no longer needed.
class Folder {
 public:
  Folder() {
    static int count = 0;
    path_ =
        fs::temp_directory_path() / ("dovetail_calculix_" + std::to_string(getpid()) + "_" + std::to_string(count++));
    fs::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

std::string content(const fs::path& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::vector<double> numbers(const std::string& line) {
  std::vector<double> result;
  const char* at = line.c_str();
  while (true) {
    char* end = nullptr;
    const double value = std::strtod(at, &end);
    if (end == at) return result;
    result.push_back(value);
    at = end;
  }
}

/// Reads the tables of a .dat file one after another; later ones of a kind replace earlier ones, but those of natural
/// frequencies, which are of different nodal diameters, and of contact pairs, which come together.
class TableReader {
 public:
  explicit TableReader(Answer& answer) : answer_(answer) {}

  void read(const std::string& line) {
    if (line.find_first_not_of(" \r") == std::string::npos) return;
    if (is_header(line)) return;
    const std::vector<double> row = numbers(line);
    if (table_ == Table::displacements && row.size() == 4)
      answer_.displacement[static_cast<int>(row[0]) - 1] = kMetre * Eigen::Vector3d(row[1], row[2], row[3]);
    else if (table_ == Table::stresses && row.size() == 8)
      add_stress(row);
    else if (table_ == Table::positions && row.size() == 5)
      answer_.stress.at(point_++).position = kMetre * Eigen::Vector3d(row[2], row[3], row[4]);
    else if (table_ == Table::forces && row.size() == 3)
      add_force(row);
    else if (table_ == Table::frequencies)
      add_frequency(row);
  }

 private:
  enum class Table { other, displacements, stresses, positions, forces, frequencies };

  bool is_header(const std::string& line) {
    const auto starts = [&](Table table, const char* text) {
      if (line.find(text) == std::string::npos) return false;
      table_ = table;
      return true;
    };
    if (starts(Table::stresses, "stresses (elem"))
      answer_.stress.clear();
    else if (starts(Table::positions, "global coordinates"))
      point_ = 0;
    else if (starts(Table::forces, "normal force (+ = tension)"))
      return true;
    else if (starts(Table::displacements, "displacements (vx"))
      return true;
    else if (starts(Table::frequencies, "E I G E N V A L U E   O U T P U T"))
      in_rows_ = 0;
    else if (line.find_first_of("()") != std::string::npos && table_ != Table::frequencies)
      table_ = Table::other;
    else if (line.find("P A R T I C I P A T I O N") != std::string::npos)
      table_ = Table::other;
    else
      return false;
    return true;
  }

  void add_stress(const std::vector<double>& row) {
    PointStress point{.element = static_cast<int>(row[0]) - 1, .position = Eigen::Vector3d::Zero(), .stress = {}};
    for (int c = 0; c < 6; ++c) point.stress[c] = kPascal * row[static_cast<std::size_t>(2 + c)];
    answer_.stress.push_back(point);
  }

  void add_force(const std::vector<double>& row) {
    answer_.normal_force.push_back(-row[1]);
    answer_.shear_force.push_back(row[2]);
  }

  /// Rows of five columns belong to a model without cyclic symmetry; of six, to one with it, where the nodal diameter
  /// comes first and every mode is there twice.
  void add_frequency(const std::vector<double>& row) {
    if (row.size() == 5)
      answer_.frequencies[0].push_back(row[3]);
    else if (row.size() == 6 && in_rows_++ % 2 == 0)
      answer_.frequencies[static_cast<int>(row[0])].push_back(row[4]);
  }

  Answer& answer_;
  Table table_ = Table::other;
  std::size_t point_ = 0;
  int in_rows_ = 0;
};

/// Contact pressures at nodes from the results for post-processing: fixed columns of 12 after the node.
void read_pressure(const fs::path& file, Answer& answer) {
  std::ifstream in(file);
  std::string line;
  bool in_contact = false;
  while (std::getline(in, line)) {
    if (line.rfind(" -4", 0) == 0) in_contact = line.find("CONTACT") != std::string::npos;
    if (line.rfind(" -3", 0) == 0) in_contact = false;
    if (in_contact && line.rfind(" -1", 0) == 0 && line.size() >= 13 + 4 * 12)
      answer.pressure[std::stoi(line.substr(3, 10)) - 1] = kPascal * std::stod(line.substr(13 + 3 * 12, 12));
  }
}

}  // namespace

bool is_installed() {
  return std::system("command -v ccx >/dev/null 2>&1") == 0;  // NOLINT(cert-env33-c): a test of this machine
}

void run_in(const fs::path& folder, const std::string& deck) {
  std::ofstream(folder / "deck.inp") << deck;
  const std::string command =
      "cd '" + folder.string() + "' && OMP_NUM_THREADS=1 ccx deck >log 2>&1 && grep -q 'Job finished' log";
  if (std::system(command.c_str()) == 0) return;  // NOLINT(cert-env33-c)
  const std::string log = content(folder / "log");
  throw std::runtime_error("ccx did not finish: " + log.substr(log.size() - std::min<std::size_t>(log.size(), 2000)));
}

Answer run(const std::string& deck) {
  const Folder folder;
  run_in(folder.path(), deck);
  Answer answer;
  TableReader reader(answer);
  std::ifstream tables(folder.path() / "deck.dat");
  std::string line;
  while (std::getline(tables, line)) reader.read(line);
  read_pressure(folder.path() / "deck.frd", answer);
  return answer;
}

}  // namespace dovetail::calculix
