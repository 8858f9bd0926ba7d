#include "studies/program/commands/version.hpp"

namespace dovetail::studies {

const char* version() {
  return DOVETAIL_VERSION;
}

}  // namespace dovetail::studies
