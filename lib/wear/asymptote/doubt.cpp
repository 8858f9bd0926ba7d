#include "wear/asymptote/doubt.hpp"

#include <array>
#include <cstddef>

namespace dovetail::wear {

namespace {

constexpr std::array kDoubts{
    DoubtEntry{Doubt::none, "", "there is none", true},
    DoubtEntry{Doubt::nothing_holds, "nothing_holds", "every loaded node slips, and nothing else takes the load over",
               false},
    DoubtEntry{Doubt::pass_failed, "pass_failed", "release of the slipping nodes came to no end", false},
    DoubtEntry{Doubt::certificate, "certificate", "with contact everywhere it goes on wearing", false},
    DoubtEntry{Doubt::threshold, "threshold", "the wear law lets worn nodes come to rest in slip", false},
    DoubtEntry{Doubt::gross_sliding, "gross_sliding", "hardly anything bears any more", false},
    DoubtEntry{Doubt::reload, "reload", "a node worn off on the way did not need to be", true},
    DoubtEntry{Doubt::lift_off, "lift_off", "a worn node touched at times only", true},
    DoubtEntry{Doubt::worst_first, "worst_first", "releasing the fastest nodes first ends elsewhere", true},
    DoubtEntry{Doubt::on_the_way, "on_the_way", "a node that does not wear slips on the way there", true},
    DoubtEntry{Doubt::near_slip, "near_slip", "a node that sticks has hardly any friction to spare", true},
    DoubtEntry{Doubt::always, "always", "asked for", true},
    DoubtEntry{Doubt::finer_settings, "finer_settings", "with more harmonics and samples it goes on wearing", true},
    DoubtEntry{Doubt::unfinished, "unfinished", "the closer look came to no end", true},
};

}  // namespace

const DoubtEntry& entry(Doubt doubt) {
  static_assert(
      [] {
        for (std::size_t i = 0; i < kDoubts.size(); ++i)
          if (static_cast<std::size_t>(kDoubts[i].doubt) != i) return false;
        return true;
      }(),
      "one entry for each doubt, in their order");
  return kDoubts[static_cast<std::size_t>(doubt)];
}

std::string_view to_string(Doubt doubt) {
  return entry(doubt).name;
}

}  // namespace dovetail::wear
