#pragma once

// Brings what is known of a space up to date before a call is answered from it: takes note of what
// was reported, reads all geoms or the few that moved, finds the pairs or adapts those of the call
// before. Used by one thread at a time for each record; answers nothing itself.

#include <string>

#include "harpoon/device.hpp"
#include "ode/libode.hpp"
#include "ode/options.hpp"
#include "ode/space_record.hpp"
#include "ode/statistics.hpp"

namespace harpoon::ode {

template <class Real>
struct Refresher {
  using Record = SpaceRecord<Real>;

  const GeomReader<Real>& reader;
  const Options& options;
  const LogCallback& log;
  Statistics& statistics;

  /// Takes note of what was reported, or of everything where nothing is. To be followed by one of
  /// the others, for geoms that moved stay in `record.moved` until the mirror follows them.
  void note_changes(Record& record) const;
  /// Makes the mirror valid. `in_collide`: the call is dSpaceCollide, for which pairs are wanted.
  /// Throws std::bad_alloc.
  void refresh_mirror(Record& record, bool in_collide) const;
  /// Makes the mirror and the pairs of a simple, hash or SAP space valid. False when the call is
  /// libode's after all. Throws std::bad_alloc.
  [[nodiscard]] bool refresh_pairs(Record& record) const;

 private:
  void follow_moved(Record& record, bool in_collide) const;
  [[nodiscard]] bool update_pairs(Record& record) const;
  Result<typename PairSearch<Real>::Found> find_pairs(Record& record) const;
  [[nodiscard]] bool is_worth_a_look(Record& record) const;
  [[nodiscard]] bool takes_over_sap(Record& record) const;
  void name_strays(Record& record) const;
  void warn(const std::string& line) const {
    if (log) log(LogLevel::warning, line);
  }
};

}  // namespace harpoon::ode
