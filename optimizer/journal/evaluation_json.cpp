#include "optimizer/journal/evaluation_json.hpp"

#include <stdexcept>

#include "optimizer/journal/record_json.hpp"

namespace dovetail::optimizer {

using nlohmann::json;

std::string record_text(std::size_t index, const JournalRecord& record) {
  json object = json_value<json>(record.evaluation, NotFinite::text);
  object["index"] = index;
  object["x"] = json_value<json>(record.x, NotFinite::text);
  return object.dump(-1, ' ', false, json::error_handler_t::replace);
}

JournalRecord record_from_text(const std::string& text, std::size_t expected_index) {
  const json object = json::parse(text);
  const auto index = object.at("index").get<std::size_t>();
  if (index != expected_index)
    throw std::runtime_error("holds record " + std::to_string(index) + " where record " +
                             std::to_string(expected_index) + " belongs");
  JournalRecord record;
  read_json(object.at("x"), record.x);
  read_json(object, record.evaluation);
  return record;
}

}  // namespace dovetail::optimizer
