#include "optimizer/journal/journal.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/errors.hpp"
#include "optimizer/journal/evaluation_json.hpp"
#include "optimizer/journal/fingerprint.hpp"

namespace dovetail::optimizer {

namespace {

constexpr int kVersion = 1;
constexpr std::string_view kBefore = R"({"checksum":")";
constexpr std::string_view kBetween = R"(","record":)";

std::string line_of(const std::string& record) {
  return std::string(kBefore) + hexadecimal(fnv1a(record)) + std::string(kBetween) + record + "}\n";
}

/// The record of a line without its newline, when the line is whole and its checksum is right.
std::optional<std::string> record_of(std::string_view line) {
  const std::size_t start = kBefore.size() + 16 + kBetween.size();
  if (line.size() <= start || !line.starts_with(kBefore) || line.back() != '}') return std::nullopt;
  if (line.substr(kBefore.size() + 16, kBetween.size()) != kBetween) return std::nullopt;
  const std::string_view record = line.substr(start, line.size() - start - 1);
  if (line.substr(kBefore.size(), 16) != hexadecimal(fnv1a(record))) return std::nullopt;
  return std::string(record);
}

std::string header_text(const std::string& fingerprint) {
  return nlohmann::json{{"format", "dovetail-journal"}, {"version", kVersion}, {"fingerprint", fingerprint}}.dump();
}

[[noreturn]] void refuse(const std::filesystem::path& file, int line, std::string value, std::string allowed) {
  throw InputError(Violation{
      .file = file.string(), .line = line, .key = "journal", .value = std::move(value), .allowed = std::move(allowed)});
}

[[noreturn]] void system_failure(const std::filesystem::path& file, const std::string& what) {
  throw std::system_error(errno, std::generic_category(), file.string() + ": " + what);
}

std::string fingerprint_of_header(const std::filesystem::path& file, const std::string& record) {
  const nlohmann::json header = nlohmann::json::parse(record, nullptr, false);
  if (!header.is_object() || header.value("format", "") != "dovetail-journal")
    refuse(file, 1, "another kind of file", "must be a dovetail journal");
  if (const int version = header.value("version", 0); version != kVersion)
    refuse(file, 1, "version " + std::to_string(version), "must be version " + std::to_string(kVersion));
  return header.value("fingerprint", "");
}

/// What is asked again.
bool is_lost(const JournalRecord& record) {
  return lost_with_its_process(record.evaluation.status);
}

/// What is there, unless it is of no use.
JournalContents known_or_empty(const std::filesystem::path& file, const std::string& fingerprint) {
  try {
    JournalContents contents = read_journal(file);
    return contents.fingerprint == fingerprint ? contents : JournalContents();
  } catch (const InputError&) {
    return {};
  }
}

}  // namespace

JournalContents read_journal(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) refuse(file, 0, "unreadable", "must be a readable file");
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  JournalContents contents;
  int line_number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    ++line_number;
    const std::size_t newline = text.find('\n', begin);
    const bool whole = newline != std::string::npos;
    const std::size_t end = whole ? newline : text.size();
    const bool last = !whole || newline + 1 == text.size();
    const std::string_view line = std::string_view(text).substr(begin, end - begin);
    const std::optional<std::string> record = whole ? record_of(line) : std::nullopt;
    if (!record) {
      // A crash can tear only the line being written; a torn header still begins like one.
      const bool torn_header = line_number == 1 && line_of(header_text("")).starts_with(line.substr(0, kBefore.size()));
      // Nor can it join two lines: then the newline between them was damaged.
      const bool joined = line.find(kBefore, 1) != std::string_view::npos;
      if (!last || joined || (line_number == 1 && !torn_header))
        refuse(
            file, line_number, line_number == 1 ? "no journal header" : "damaged record",
            line_number == 1 ? "must be a dovetail journal" : "must match its checksum; restore the file or remove it");
      contents.note = file.string() + ": line " + std::to_string(line_number) +
                      " was cut short (the program ended while writing it); it is computed again";
      break;
    }
    if (line_number == 1) {
      contents.fingerprint = fingerprint_of_header(file, *record);
    } else {
      try {
        contents.records.push_back(record_from_text(*record, contents.records.size()));
      } catch (const std::exception& error) {
        refuse(file, line_number, error.what(), "must be the next record of this journal");
      }
    }
    begin = end + 1;
    contents.valid_bytes = begin;
  }
  return contents;
}

Journal Journal::create(const std::filesystem::path& file, const std::string& fingerprint) {
  return open(file, fingerprint, Old::refused);
}

Journal Journal::resume(const std::filesystem::path& file, const std::string& fingerprint) {
  return open(file, fingerprint, Old::resumed);
}

Journal Journal::renew(const std::filesystem::path& file, const std::string& fingerprint) {
  return open(file, fingerprint, Old::replaced);
}

Journal Journal::open(const std::filesystem::path& file, const std::string& fingerprint, Old old) {
  Journal journal;
  journal.file_ = file;
  journal.descriptor_ =
      ::open(file.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC | (old == Old::refused ? O_EXCL : 0), 0644);
  if (journal.descriptor_ < 0) {
    if (errno == EEXIST) refuse(file, 0, "exists", "must not exist for a new run; resume it or choose another place");
    system_failure(file, "cannot be opened for writing");
  }
  if (::flock(journal.descriptor_, LOCK_EX | LOCK_NB) != 0)
    refuse(file, 0, "in use", "must not be written by another run at the same time");
  JournalContents contents = old == Old::replaced ? known_or_empty(file, fingerprint) : read_journal(file);
  if (contents.valid_bytes > 0 && contents.fingerprint != fingerprint)
    refuse(
        file, 1, contents.fingerprint,
        "must belong to the study at hand (" + fingerprint +
            "); its variables, limits or physics have changed: choose another folder for this run or move the old one");
  if (::ftruncate(journal.descriptor_, static_cast<off_t>(contents.valid_bytes)) != 0)
    system_failure(file, "cannot cut off the torn last line");
  journal.note_ = std::move(contents.note);
  journal.records_ = std::move(contents.records);
  journal.size_ = journal.records_.size();
  std::erase_if(journal.records_, is_lost);
  if (contents.valid_bytes == 0) {
    journal.write_line(header_text(fingerprint));
    // The name of a new file is on disk only once its folder is.
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
    if (const int handle = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); handle >= 0) {
      ::fsync(handle);
      ::close(handle);
    }
  }
  return journal;
}

Journal::Journal(Journal&& other) noexcept {
  *this = std::move(other);
}

Journal& Journal::operator=(Journal&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  std::swap(file_, other.file_);
  std::swap(records_, other.records_);
  std::swap(note_, other.note_);
  std::swap(size_, other.size_);
  return *this;
}

Journal::~Journal() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::size_t merge_journals(std::span<const std::filesystem::path> from, const std::filesystem::path& to) {
  std::vector<JournalContents> contents;
  for (const std::filesystem::path& file : from) {
    contents.push_back(read_journal(file));
    if (contents.back().fingerprint != contents.front().fingerprint)
      refuse(file, 1, contents.back().fingerprint,
             "must belong to the same study as " + from.front().string() + " (" + contents.front().fingerprint + ")");
  }
  Journal journal = Journal::create(to, contents.front().fingerprint);
  std::set<std::vector<double>> known;
  for (const JournalContents& each : contents)
    for (const JournalRecord& record : each.records)
      if (!is_lost(record) && known.insert(record.x).second) journal.append(record.x, record.evaluation);
  return journal.size();
}

void Journal::append(std::span<const double> x, const Evaluation& evaluation) {
  write_line(record_text(size_, {.x = {x.begin(), x.end()}, .evaluation = evaluation}));
  ++size_;
}

void Journal::write_line(const std::string& record) {
  const std::string line = line_of(record);
  const off_t before = ::lseek(descriptor_, 0, SEEK_END);
  for (std::size_t done = 0; done < line.size();) {
    const ssize_t written = ::write(descriptor_, line.data() + done, line.size() - done);
    if (written < 0 && errno != EINTR) {
      const int reason = errno;
      // Half a line in the middle of the file could never be told from damage.
      [[maybe_unused]] const int cut = ::ftruncate(descriptor_, before);
      errno = reason;
      system_failure(file_, "cannot be written");
    }
    if (written > 0) done += static_cast<std::size_t>(written);
  }
  if (::fdatasync(descriptor_) != 0) system_failure(file_, "cannot be flushed to disk");
}

}  // namespace dovetail::optimizer
