#include "studies/program/engine/stored_history.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "optimizer/journal/fingerprint.hpp"
#include "studies/program/engine/json_values.hpp"
#include "studies/program/engine/number_constants.hpp"
#include "studies/program/study_file/refusal.hpp"

namespace dovetail::studies {
namespace {

[[noreturn]] void cannot_resume(const std::string& file, const std::string& why) {
  refuse("--resume", why, file);
}

/// A list, a matrix or a record.
template <class T>
T value_of(const Json& json) {
  T value;
  optimizer::read_json(json, value);
  return value;
}

/// The bytes of a matrix, its shape first; both zeros alike.
void append(std::string& bytes, const Eigen::Ref<const Eigen::MatrixXd>& matrix) {
  bytes += std::to_string(matrix.rows()) + "x" + std::to_string(matrix.cols()) + ":";
  for (Eigen::Index j = 0; j < matrix.cols(); ++j)
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
      const double value = matrix(i, j) + 0.0;
      std::array<char, sizeof value> raw{};
      std::memcpy(raw.data(), &value, sizeof value);
      bytes.append(raw.data(), raw.size());
    }
}

/// The finished state, which is the last entry, becomes the final depth.
wear::History history_of(const Json& json, Eigen::Index nodes) {
  wear::History history;
  const auto ended = json.at("ended").get<std::string>();
  const std::optional<wear::HistoryEnd> end = named<wear::HistoryEnd>(ended);
  if (!end) throw std::out_of_range("ended = \"" + ended + "\" " + one_of(names_of<wear::HistoryEnd>()));
  history.end = *end;
  history.finished = json.at("finished").get<bool>();
  history.solves = json.at("solves").get<int>();
  history.final_depth = value_of<Eigen::VectorXd>(json.at("depth_m"));
  history.final_rate = value_of<Eigen::VectorXd>(json.at("final_wear_rate_m_per_cycle"));
  history.final_volume = json.at("final_worn_volume_m3").get<double>();
  const Json& memory = json.at("history").at("memory");
  history.memory = value_of<wear::StepMemory>(memory);
  history.steady.displacement = value_of<Eigen::MatrixXd>(memory.at("displacement_m"));

  // Displacements only spare iterations: ones of another shape are none.
  const Eigen::MatrixXd& last = history.steady.displacement;
  Eigen::MatrixXd& factored = history.memory.factored_displacement;
  const double harmonics = json.at("history").at("identity").at("harmonics").get<double>();
  if (last.rows() % nodes != 0 || static_cast<double>(last.cols()) != 2 * harmonics + 1)
    history.steady.displacement.resize(0, 0);
  if (factored.rows() != last.rows() || factored.cols() != last.cols() ||
      history.memory.factored_depth.size() != nodes || history.memory.factored_cycles.size() != nodes)
    factored.resize(0, 0);

  const auto cycles = value_of<Eigen::VectorXd>(json.at("cycles"));
  const auto volume = value_of<Eigen::VectorXd>(json.at("worn_volume_m3"));
  const auto amplitude = value_of<Eigen::VectorXd>(json.at("amplitude_m"));
  const auto hz = value_of<Eigen::VectorXd>(json.at("frequencies_hz"));
  const auto depth = value_of<Eigen::MatrixXd>(json.at("depths_m")),
             rate = value_of<Eigen::MatrixXd>(json.at("wear_rates_m_per_cycle"));
  const Eigen::Index entries = cycles.size();
  if (volume.size() != entries || amplitude.size() != entries || hz.size() != entries || depth.rows() != entries ||
      rate.rows() != entries || depth.cols() != nodes || rate.cols() != nodes)
    return {};
  const Eigen::Index states = entries - (history.finished ? 1 : 0);
  if (states <= 0) return {};
  history.cycles = cycles.head(states);
  history.worn_volume = volume.head(states);
  history.amplitude = amplitude.head(states);
  history.frequency = kTurn * hz.head(states);
  history.depth = depth.topRows(states);
  history.rate = rate.topRows(states);
  const bool known = history.cycles.allFinite() && history.depth.allFinite() && history.rate.allFinite() &&
                     history.frequency.allFinite() && history.worn_volume.allFinite();
  return known ? history : wear::History{};
}

std::string words(const IdentityEntry& entry) {
  const auto* text = std::get_if<std::string>(&entry.value);
  return text != nullptr ? *text : shortest(std::get<double>(entry.value));
}

}  // namespace

std::string checksum(const reduction::ReducedModel& model) {
  std::string bytes;
  for (const Eigen::MatrixXd* matrix :
       {&model.mass, &model.damping, &model.stiffness, &model.cosine_force, &model.sine_force, &model.output_vectors})
    append(bytes, *matrix);
  append(bytes, model.static_force);
  const reduction::ContactNodes& contact = model.contact;
  append(bytes, contact.normal.cast<double>());
  append(bytes, contact.tangential.cast<double>());
  for (const Eigen::VectorXd* values : {&contact.area, &contact.gap, &contact.friction, &contact.wear_coefficient})
    append(bytes, *values);
  // No threshold, and one of zero everywhere, are the same.
  append(bytes, contact.wear_threshold.isZero(0.0) ? Eigen::VectorXd() : contact.wear_threshold);
  if (contact.wear_law != reduction::ContactNodes().wear_law) bytes += contact.wear_law;
  const bool slip = contact.slip_origin.size() > 0 && !contact.slip_origin.isZero(0.0);
  if (slip) append(bytes, contact.slip_origin);
  return optimizer::hexadecimal(optimizer::fnv1a(bytes));
}

std::vector<IdentityEntry> history_identity(const WearOptions& options, const LoadedModel& loaded, double hz) {
  const steady::Options& steady = loaded.joint.options;
  const auto word = [](auto mode) { return std::string(to_string(mode)); };
  return {{"model", checksum(loaded.model)},
          {"integrator", word(options.integrator.value_or(wear::IntegratorKind::explicit_jumps))},
          {"follow", word(follow_of(options.follow.value_or(Drive::fixed)))},
          {"frequency_hz", hz},
          {"harmonics", static_cast<double>(steady.harmonics)},
          {"samples", static_cast<double>(steady.samples)},
          {"pseudo_penalty_normal_n_per_m", steady.normal_penalty},
          {"pseudo_penalty_tangential_n_per_m", steady.tangential_penalty},
          {"penalty_scale", steady.penalty_scale},
          {"slip_return", word(steady.slip_return)}};
}

StoredHistory read_history(const std::string& file, Eigen::Index nodes) {
  std::ifstream stream(file);
  if (!stream) cannot_resume(file, "cannot be read");
  const Json json = Json::parse(stream, nullptr, false);
  StoredHistory stored;
  try {
    if (!json.is_object() || named<WearMethod>(json.value("method", "")) != WearMethod::history)
      cannot_resume(file, "is no answer of dovetail wear --method history --json");
    const Json& choice = json.at("history");
    for (const auto& [key, value] : choice.at("identity").items()) {
      if (value.is_string())
        stored.identity.push_back({key, value.get<std::string>()});
      else
        stored.identity.push_back({key, value.get<double>()});
    }
    stored.frequency_hz = choice.at("identity").at("frequency_hz").get<double>();
    stored.tolerance = choice.at("tolerance").get<double>();
    stored.increment = choice.value("increment_m", 0.0);
    stored.depth_scale = choice.value("depth_scale_m", 0.0);
    stored.history = history_of(json, nodes);
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    cannot_resume(file, std::string("is incomplete or spoilt: ") + error.what());
  }
  if (stored.history.cycles.size() == 0) cannot_resume(file, "is a history of other contact nodes, or of none");
  return stored;
}

void check_identity(const StoredHistory& stored, const std::vector<IdentityEntry>& wanted, const std::string& file) {
  std::vector<Violation> found;
  for (const IdentityEntry& entry : wanted) {
    const auto same = std::ranges::find(stored.identity, entry.key, &IdentityEntry::key);
    if (same != stored.identity.end() && *same == entry) continue;
    const bool model = entry.key == "model";
    found.push_back({.file = file,
                     .key = "history.identity." + entry.key,
                     .value = same == stored.identity.end() ? "" : words(*same),
                     .allowed = "must be " + words(entry) +
                                (model ? ", the checksum of this model, to be resumed" : ", as here, to be resumed")});
  }
  refuse(std::move(found));
}

}  // namespace dovetail::studies
