#pragma once

// What an engine has done: counters that any thread adds to, and their one line of text.

#include <atomic>
#include <cstdint>
#include <string>
#include <string_view>

namespace harpoon::ode {

struct Statistics {
  using Counter = std::atomic<std::uint64_t>;

  Counter spaces{0};           ///< that Harpoon came to know
  Counter searched{0};         ///< dSpaceCollide calls whose pairs were found by Harpoon
  Counter updated{0};          ///< those of the call before, brought up to date for what moved
  Counter unchanged{0};        ///< answered from the call before: nothing had changed
  Counter recorded{0};         ///< run by libode while its pairs were noted down
  Counter scanned{0};          ///< dSpaceCollide2 calls answered by Harpoon
  Counter scanned_spaces{0};   ///< those of them whose arguments were two spaces
  Counter left_to_stock{0};    ///< small, nested, unknown: libode's own
  Counter handed_over{0};      ///< to libode in the middle of a call, which callbacks change
  Counter pairs{0};            ///< near callbacks
  Counter batch_contacts{0};   ///< dCollide calls answered from a batch
  Counter stock_contacts{0};   ///< other dCollide calls while a space was replayed
  Counter missed_by_stock{0};  ///< pairs that a stock hash space misses
  Counter verified_pairs{0};
  Counter inside_ns{0};  ///< in dSpaceCollide and dSpaceCollide2, callbacks included

  static void add(Counter& counter, std::uint64_t amount) {
    counter.fetch_add(amount, std::memory_order_relaxed);
  }
};

/// One line without newline. `device` serves contacts; where changes are not reported that is said.
std::string to_line(const Statistics& statistics, std::string_view device,
                    bool changes_are_reported);

}  // namespace harpoon::ode
