#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "optimizer/problem/evaluation.hpp"

namespace dovetail::optimizer {

/// One evaluated candidate as the journal keeps it.
struct JournalRecord {
  std::vector<double> x;  ///< design-space order, file units
  Evaluation evaluation;
};

/// What a journal file holds.
struct JournalContents {
  std::string fingerprint;
  std::vector<JournalRecord> records;
  std::string note;             ///< not empty when a torn last line was left out: a sentence for people
  std::size_t valid_bytes = 0;  ///< length of the intact part
};

/// Reads a journal without changing it. A last line that is cut short or does not match its checksum (a crash while
/// writing) is left out and said in `note`; any other damage, a newer version or a file that is no journal is an
/// InputError naming file and line.
[[nodiscard]] JournalContents read_journal(const std::filesystem::path& file);

/// Append-only record of every evaluation: one JSON object per line,
/// `{"checksum":"16 hex digits","record":{...}}`, the checksum over the text of the record (FNV-1a, 64 bit); the first
/// line is the header with format, version and fingerprint. Doubles read back bit by bit; NaN and infinities are the
/// strings "nan", "inf", "-inf". Each append reaches the disk (fdatasync) before it returns. One writer at a time.
class Journal {
 public:
  /// Starts a new journal; an existing file is an InputError.
  [[nodiscard]] static Journal create(const std::filesystem::path& file, const std::string& fingerprint);
  /// Opens a journal to continue it, or starts one when the file does not exist or is empty. A torn last line is cut
  /// off. InputError when it belongs to another study (fingerprint), is damaged or is in use by another process.
  [[nodiscard]] static Journal resume(const std::filesystem::path& file, const std::string& fingerprint);

  /// The same, but begins anew where what is there belongs to another question or is damaged.
  [[nodiscard]] static Journal renew(const std::filesystem::path& file, const std::string& fingerprint);

  Journal(Journal&& other) noexcept;
  Journal& operator=(Journal&& other) noexcept;
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;
  ~Journal();

  /// Records found when it was opened, but for those that were lost with a process: they are asked again.
  [[nodiscard]] const std::vector<JournalRecord>& records() const { return records_; }
  [[nodiscard]] const std::string& note() const { return note_; }
  [[nodiscard]] std::size_t size() const { return size_; }

  /// Throws std::system_error when the disk refuses.
  void append(std::span<const double> x, const Evaluation& evaluation);

 private:
  Journal() = default;
  enum class Old { refused, resumed, replaced };
  static Journal open(const std::filesystem::path& file, const std::string& fingerprint, Old old);
  void write_line(const std::string& record);

  int descriptor_ = -1;
  std::filesystem::path file_;
  std::vector<JournalRecord> records_;
  std::string note_;
  std::size_t size_ = 0;
};

/// Writes a journal with the records of several of one study, each point once, the first to have it first, and none
/// that was lost with its process. InputError when they are of different studies, or as for read_journal.
/// @return how many records it has
std::size_t merge_journals(std::span<const std::filesystem::path> from, const std::filesystem::path& to);

}  // namespace dovetail::optimizer
