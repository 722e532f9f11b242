#pragma once

// The far side of the AFU's AXI master: memory, and the link to it with its latency, bandwidth,
// ordering and faults. Cycle by cycle, deterministic for a seed. Also judges the master: it keeps
// the first breach of the AXI rules that it sees. Knows nothing of the AFU's inside.

#include <array>
#include <cstdint>
#include <deque>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "faults.hpp"
#include "physical_memory.hpp"
#include "profile.hpp"

namespace harpoon::sim {

using Line = std::array<std::uint32_t, 16>;

/// What the master drives in a cycle.
struct AxiRequest {
  bool ar_valid, aw_valid, w_valid;
  std::uint32_t ar_id, aw_id;
  std::uint64_t ar_address, aw_address;
  const std::uint32_t* w_data;  ///< 16 words
  bool single_beats;            ///< len 0, size 64 bytes, INCR, all strobes, last
};

/// What the link drives in a cycle.
struct AxiResponse {
  bool ar_ready = false, aw_ready = false, w_ready = false;
  bool r_valid = false, b_valid = false;
  std::uint32_t r_id = 0, b_id = 0, r_resp = 0, b_resp = 0;
  Line r_data{};
};

/// How unruly the link is; all zero is a calm one.
struct LinkNoise {
  std::uint64_t seed = 0;
  std::uint32_t jitter_cycles = 0;          ///< extra latency, up to this, per response: any order
  std::uint32_t back_pressure_percent = 0;  ///< cycles in which a ready is withheld
};

struct LinkCounters {
  std::uint64_t lines_read = 0, lines_written = 0;
  std::uint64_t stray_reads = 0, stray_writes = 0;  ///< at addresses where nothing is mapped
  std::uint32_t most_reads = 0, most_writes = 0;    ///< outstanding at once
  std::uint64_t faults_injected = 0;
};

class LinkModel {
 public:
  LinkModel(const LinkProfile& profile, const LinkNoise& noise, PhysicalMemory& memory);

  /// What the link drives in the coming cycle.
  const AxiResponse& drive();
  /// What the master drove in that cycle; ends the cycle.
  void sample(const AxiRequest& request);

  void arm(const Fault& fault) noexcept;
  /// True once, when a `reset` fault strikes.
  [[nodiscard]] bool take_reset() noexcept;
  /// Forgets all that is under way, and any hang.
  void reset();

  [[nodiscard]] const LinkCounters& counters() const noexcept { return counters_; }
  /// The first breach of the AXI rules by the master, or empty.
  [[nodiscard]] const std::string& breach() const noexcept { return breach_; }

 private:
  struct Read {
    std::uint64_t ready_at;
    std::uint32_t id, resp;
    std::uint64_t address;
    bool struck, duplicate;
  };
  struct Write {
    std::uint32_t id;
    std::uint64_t address;
    Line data;
  };
  struct Visible {
    std::uint64_t at;
    std::uint64_t address;
    Line data;
    bool low_half, high_half;
  };
  struct Ack {
    std::uint64_t ready_at;
    std::uint32_t id, resp;
  };
  /// A queue that leaves in the order of `ready_at`, of equals the first pushed: nearly as pushed.
  template <class T>
  class Soonest {
   public:
    [[nodiscard]] bool empty() const { return items_.empty(); }
    [[nodiscard]] const T& top() const { return items_.front(); }
    void pop() { items_.pop_front(); }
    void push(const T& item) {
      auto at = items_.end();
      while (at != items_.begin() && std::prev(at)->ready_at > item.ready_at) --at;
      items_.insert(at, item);
    }

   private:
    std::deque<T> items_;
  };

  void refill();
  void deliver_read();
  void transmit_write();
  void make_visible();
  void perform(const Visible& write);
  void acknowledge();
  void accept_read(const AxiRequest& request);
  void accept_write(const AxiRequest& request);
  void judge(const AxiRequest& request);
  void breach(const char* what);
  bool strikes(FaultKind kind, std::uint64_t& counter) noexcept;
  void corrupt(Line& line);
  void fake_line(std::uint64_t address, Line& line);
  [[nodiscard]] bool calm();
  [[nodiscard]] std::uint64_t jitter();

  LinkProfile profile_;
  LinkNoise noise_;
  PhysicalMemory& memory_;
  std::mt19937_64 random_;
  std::uint64_t read_latency_, write_latency_, visible_after_;
  std::uint64_t rate_, read_tokens_ = 0, write_tokens_ = 0;  // bytes * 1024 a cycle
  std::uint64_t now_ = 0;

  Soonest<Read> reads_;
  Soonest<Ack> acks_;
  std::deque<std::pair<std::uint32_t, std::uint64_t>> addresses_;  // AW waiting for its W
  std::deque<Line> data_;                                          // W waiting for its AW
  std::deque<Write> writes_;                                       // waiting for the link
  std::deque<Visible> visible_;                                    // in time order
  std::vector<Visible> torn_;                                      // second halves, any order
  std::array<bool, 256> read_out_{}, write_out_{};
  std::uint32_t reads_out_ = 0, writes_out_ = 0;
  bool write_turn_ = false;

  Fault fault_;
  std::uint64_t read_events_ = 0, write_events_ = 0, cycle_events_ = 0;
  bool hung_ = false, reset_pending_ = false;

  AxiResponse response_;
  AxiRequest last_{};
  Line last_data_{};
  LinkCounters counters_;
  std::string breach_;
};

}  // namespace harpoon::sim
