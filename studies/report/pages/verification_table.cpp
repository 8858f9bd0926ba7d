// The best designs by the full wear history, beside the direct method.
#include <algorithm>
#include <cmath>

#include "studies/report/pages/report_tables.hpp"
#include "studies/report/words/table.hpp"
#include "studies/report/words/units.hpp"

namespace dovetail::report {

std::string verification_table(const RunRecord& record) {
  double most = 0, deepest = 0;
  for (const VerificationRecord& v : record.verifications) {
    most = std::max({most, v.search_volume_m3, v.direct_volume_m3, v.history_volume_m3});
    deepest = std::max({deepest, v.search_depth_m, v.history_depth_m});
  }
  const Unit volume = readable_unit("m^3", most), depth = readable_unit("m", deepest);
  const Unit bare{.symbol = "", .si = volume.si};  // the unit stands in the head
  Table table{.columns = {{"#"},
                          {"status", true},
                          {"search (" + volume.symbol + ")"},
                          {"finer (" + volume.symbol + ")"},
                          {"history (" + volume.symbol + ")"},
                          {"change"},
                          {"depth, search (" + depth.symbol + ")"},
                          {"history (" + depth.symbol + ")"},
                          {"profiles differ by"}},
              .rows = {}};
  for (const VerificationRecord& v : record.verifications) {
    const auto where_compared = [&](const std::string& value) { return v.history_known() ? value : "not known"; };
    table.rows.push_back(
        {{std::to_string(v.evaluation + 1) + (v.load_case.empty() ? "" : ", " + v.load_case), v.agreement(),
          with_error(v.search_volume_m3, v.search_bar_m3, bare),
          v.finer_known() ? significant(v.direct_volume_m3 / volume.si, 4) : "not known",
          where_compared(with_error(v.history_volume_m3, v.history_bar_m3, bare)),
          where_compared(per_cent(v.history_volume_m3, v.search_volume_m3)),
          significant(v.search_depth_m / depth.si, 4), where_compared(significant(v.history_depth_m / depth.si, 4)),
          where_compared(significant(100 * v.profile_difference, 2) + "\u00a0%")}});
  }
  return table_html(table);
}

}  // namespace dovetail::report
