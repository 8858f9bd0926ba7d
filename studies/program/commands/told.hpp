#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "studies/program/answers/teller.hpp"
#include "studies/program/commands/commands.hpp"

namespace dovetail::studies {

/// How the program ends where a command throws.
struct Failure {
  int status = kNotConverged;
  std::string words;  ///< of people, lines without the end of the last
};

/// Of the exception that is being handled.
[[nodiscard]] Failure failure();

/// A command that tells what it does.
struct ToldCommand {
  std::string name = {};
  bool plain = false;  ///< its progress is told where nobody sees a terminal, too
  nlohmann::ordered_json fields =
      nlohmann::ordered_json::object();  ///< what its log begins with besides program and command
};

/// Runs it. Its log begins and ends with events of these names, the last with the exit status also where it throws; a
/// log without end is that of a program that was killed, or goes on.
int told(const ToldCommand& command, const TellChoice& choice, const Streams& streams,
         const std::function<int(Teller&)>& work);

}  // namespace dovetail::studies
