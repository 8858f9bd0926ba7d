#pragma once

#include <string>

/// JSON Schemas (draft 2020-12), for editors and for programs that write studies or read answers.
namespace dovetail::studies {

/// Of a study file, TOML read as JSON: made of the tables that read it.
[[nodiscard]] std::string study_schema();

/// Of what `evaluate --json` answers: made of the table that writes it.
[[nodiscard]] std::string evaluation_schema();

/// Of what `runs --json` and `materials --json` answer.
[[nodiscard]] std::string runs_schema();
[[nodiscard]] std::string materials_schema();

}  // namespace dovetail::studies
