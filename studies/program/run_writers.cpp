#include "studies/program/run_record.hpp"

namespace dovetail::studies {

RunWriters run_writers() {
  return {};
}

}  // namespace dovetail::studies
