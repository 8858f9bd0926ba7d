#include "studies/program/answers/version.hpp"

namespace dovetail::studies {

const char* version() {
  return DOVETAIL_VERSION;
}

}  // namespace dovetail::studies
