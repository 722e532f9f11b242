#include "ode/statistics.hpp"

#include <fmt/format.h>

namespace harpoon::ode {

std::string to_line(const Statistics& s, std::string_view device, bool changes_are_reported) {
  std::string line = fmt::format(
      "{} spaces; dSpaceCollide: {} searched, {} updated, {} unchanged, {} recorded, {} left to "
      "libode; "
      "dSpaceCollide2: {} scanned, {} of two spaces; {} pairs; dCollide: {} from batches ({}), {} "
      "by libode; {:.3f} "
      "s "
      "inside, callbacks included",
      s.spaces.load(), s.searched.load(), s.updated.load(), s.unchanged.load(), s.recorded.load(),
      s.left_to_stock.load(), s.scanned.load(), s.scanned_spaces.load(), s.pairs.load(),
      s.batch_contacts.load(), device, s.stock_contacts.load(),
      static_cast<double>(s.inside_ns.load()) * 1e-9);
  if (s.missed_by_stock.load() != 0) {
    line += fmt::format("; {} pairs that a stock hash space misses", s.missed_by_stock.load());
  }
  if (s.handed_over.load() != 0) {
    line += fmt::format("; {} calls handed over to libode, for callbacks change what is collided",
                        s.handed_over.load());
  }
  if (s.verified_pairs.load() != 0) {
    line += fmt::format("; {} pairs verified", s.verified_pairs.load());
  }
  if (!changes_are_reported) {
    line += "; changes are not reported by this libode: all geoms read in every call";
  }
  return line;
}

}  // namespace harpoon::ode
