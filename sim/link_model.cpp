#include "link_model.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

#include "device/afu/line.hpp"

namespace harpoon::sim {
namespace {

constexpr std::uint64_t kLineCost = std::uint64_t{64} << 10;  // bytes * 1024
constexpr std::size_t kWriteQueue = 16;                       // lines buffered before the link
constexpr std::uint32_t kOkay = 0, kSlaveError = 2, kDecodeError = 3;

std::uint64_t cycles(double ns, double clock_mhz) {
  return static_cast<std::uint64_t>(std::llround(ns * clock_mhz / 1000));
}

}  // namespace

std::string_view to_string(FaultKind kind) noexcept {
  static constexpr std::array<std::string_view, kFaultKinds> kNames = {
      "none",       "drop_read", "duplicate_read", "late_read",  "corrupt_read",  "error_read",
      "drop_write", "drop_ack",  "duplicate_ack",  "late_ack",   "corrupt_write", "error_write",
      "hang",       "reset",     "wrong_afu_id",   "torn_write", "page_fault"};
  return kNames[static_cast<std::size_t>(kind)];
}

LinkModel::LinkModel(const LinkProfile& profile, const LinkNoise& noise, PhysicalMemory& memory)
    : profile_(profile),
      noise_(noise),
      memory_(memory),
      random_(noise.seed),
      read_latency_(std::max<std::uint64_t>(1, cycles(profile.read_latency_ns, profile.clock_mhz))),
      write_latency_(
          std::max<std::uint64_t>(1, cycles(profile.write_latency_ns, profile.clock_mhz))),
      visible_after_(write_latency_ / 2),
      rate_(static_cast<std::uint64_t>(
          std::llround(profile.gigabytes_per_s * 1000 / profile.clock_mhz * 1024))) {}

void LinkModel::arm(const Fault& fault) noexcept {
  fault_ = fault;
  read_events_ = write_events_ = cycle_events_ = 0;
}

bool LinkModel::take_reset() noexcept {
  return std::exchange(reset_pending_, false);
}

void LinkModel::reset() {
  reads_ = {};
  acks_ = {};
  addresses_.clear();
  data_.clear();
  writes_.clear();
  visible_.clear();
  torn_.clear();
  read_out_.fill(false);
  write_out_.fill(false);
  reads_out_ = writes_out_ = 0;
  hung_ = false;
  last_ = {};
}

bool LinkModel::calm() {
  return noise_.back_pressure_percent == 0 || random_() % 100 >= noise_.back_pressure_percent;
}

std::uint64_t LinkModel::jitter() {
  return noise_.jitter_cycles == 0 ? 0 : random_() % (noise_.jitter_cycles + 1);
}

bool LinkModel::strikes(FaultKind kind, std::uint64_t& counter) noexcept {
  if (fault_.kind != kind || counter != fault_.nth) return false;
  fault_.kind = FaultKind::none;
  ++counters_.faults_injected;
  return true;
}

void LinkModel::corrupt(Line& line) {
  const int bits = 1 + static_cast<int>(random_() % 3);
  for (int i = 0; i < bits; ++i) {
    const std::uint64_t bit = random_() % 512;
    line[bit / 32] ^= 1u << (bit % 32);
  }
}

const AxiResponse& LinkModel::drive() {
  response_.ar_ready = response_.aw_ready = response_.w_ready = false;
  response_.r_valid = response_.b_valid = false;
  if (strikes(FaultKind::hang, cycle_events_)) hung_ = true;
  if (strikes(FaultKind::reset, cycle_events_)) reset_pending_ = true;
  ++cycle_events_;
  if (hung_) return response_;
  refill();
  response_.ar_ready = reads_out_ < profile_.lines_in_flight && calm();
  response_.aw_ready = writes_out_ < profile_.lines_in_flight && addresses_.size() < 4 && calm();
  response_.w_ready = writes_.size() + data_.size() < kWriteQueue && calm();
  // On a shared link reads and writes take turns; whoever has nothing to send cedes its turn.
  const bool write_first = write_turn_;
  if (write_first) transmit_write();
  deliver_read();
  if (!write_first) transmit_write();
  make_visible();
  acknowledge();
  return response_;
}

void LinkModel::refill() {
  const std::uint64_t full = kLineCost + rate_;
  read_tokens_ = std::min(read_tokens_ + rate_, full);
  write_tokens_ = std::min(write_tokens_ + rate_, full);
}

void LinkModel::deliver_read() {
  if (reads_.empty() || reads_.top().ready_at > now_ || read_tokens_ < kLineCost) return;
  const Read read = reads_.top();
  reads_.pop();
  write_turn_ = true;
  read_tokens_ -= kLineCost;
  if (profile_.shared_bandwidth) write_tokens_ = read_tokens_;
  response_.r_valid = true;
  response_.r_id = read.id;
  response_.r_resp = read.resp;
  if (const std::byte* const line = memory_.line(read.address); line != nullptr) {
    std::memcpy(response_.r_data.data(), line, sizeof(Line));
  } else {
    response_.r_data = {};
    if (read.resp == kOkay) response_.r_resp = kDecodeError;
  }
  if (read.struck) corrupt(response_.r_data);
  fake_line(read.address, response_.r_data);
  ++counters_.lines_read;
  if (!read.duplicate) {
    read_out_[read.id] = false;
    --reads_out_;
  }
}

void LinkModel::transmit_write() {
  if (writes_.empty() || write_tokens_ < kLineCost) return;
  Write write = writes_.front();
  writes_.pop_front();
  write_turn_ = false;
  write_tokens_ -= kLineCost;
  if (profile_.shared_bandwidth) read_tokens_ = write_tokens_;
  Ack ack{now_ + write_latency_ + jitter(), write.id, kOkay};
  Visible visible{now_ + visible_after_, write.address, write.data, true, true};
  bool performed = memory_.line(write.address) != nullptr;
  bool acknowledged = true;
  if (!performed) {
    ack.resp = kDecodeError;
    ++counters_.stray_writes;
  }
  fake_line(write.address, visible.data);
  if (strikes(FaultKind::drop_write, write_events_)) performed = false;
  if (strikes(FaultKind::drop_ack, write_events_)) acknowledged = false;
  if (strikes(FaultKind::late_ack, write_events_)) ack.ready_at += fault_.amount;
  if (strikes(FaultKind::corrupt_write, write_events_)) corrupt(visible.data);
  if (strikes(FaultKind::error_write, write_events_)) {
    ack.resp = kSlaveError;
    performed = false;
  }
  if (strikes(FaultKind::duplicate_ack, write_events_)) {
    Ack again = ack;
    again.ready_at += 1 + fault_.amount % 64;
    acks_.push(again);
  }
  if (performed && strikes(FaultKind::torn_write, write_events_)) {
    Visible late = visible;
    visible.high_half = false;
    late.low_half = false;
    late.at += fault_.amount;
    torn_.push_back(late);
  }
  if (performed) visible_.push_back(visible);
  if (acknowledged) acks_.push(ack);
  ++write_events_;
  ++counters_.lines_written;
}

void LinkModel::make_visible() {
  while (!visible_.empty() && visible_.front().at <= now_) {
    perform(visible_.front());
    visible_.pop_front();
  }
  if (torn_.empty()) return;
  std::erase_if(torn_, [this](const Visible& write) {
    if (write.at > now_) return false;
    perform(write);
    return true;
  });
}

void LinkModel::perform(const Visible& write) {
  std::byte* const line = memory_.line(write.address);
  if (line == nullptr) return;
  const auto* const data = reinterpret_cast<const std::byte*>(write.data.data());
  if (write.low_half) std::memcpy(line, data, 32);
  if (write.high_half) std::memcpy(line + 32, data + 32, 32);
}

void LinkModel::acknowledge() {
  if (acks_.empty() || acks_.top().ready_at > now_) return;
  const Ack ack = acks_.top();
  acks_.pop();
  response_.b_valid = true;
  response_.b_id = ack.id;
  response_.b_resp = ack.resp;
  if (write_out_[ack.id]) {
    write_out_[ack.id] = false;
    --writes_out_;
  }
}

void LinkModel::sample(const AxiRequest& request) {
  judge(request);
  if (request.ar_valid && response_.ar_ready) accept_read(request);
  accept_write(request);
  counters_.most_reads = std::max(counters_.most_reads, reads_out_);
  counters_.most_writes = std::max(counters_.most_writes, writes_out_);
  ++now_;
}

void LinkModel::accept_read(const AxiRequest& request) {
  if (read_out_[request.ar_id]) breach("two reads outstanding with one ID");
  read_out_[request.ar_id] = true;
  ++reads_out_;
  if (memory_.line(request.ar_address) == nullptr) ++counters_.stray_reads;
  Read read{
      now_ + read_latency_ + jitter(), request.ar_id, kOkay, request.ar_address, false, false};
  read.struck = strikes(FaultKind::corrupt_read, read_events_);
  if (strikes(FaultKind::late_read, read_events_)) read.ready_at += fault_.amount;
  if (strikes(FaultKind::error_read, read_events_)) read.resp = kSlaveError;
  if (strikes(FaultKind::duplicate_read, read_events_)) {
    Read again = read;
    again.ready_at += 1 + fault_.amount % 64;
    again.duplicate = true;
    reads_.push(again);
  }
  if (!strikes(FaultKind::drop_read, read_events_)) reads_.push(read);
  ++read_events_;
}

void LinkModel::accept_write(const AxiRequest& request) {
  if (request.aw_valid && response_.aw_ready) {
    if (write_out_[request.aw_id]) breach("two writes outstanding with one ID");
    write_out_[request.aw_id] = true;
    ++writes_out_;
    addresses_.emplace_back(request.aw_id, request.aw_address);
  }
  if (request.w_valid && response_.w_ready) {
    std::memcpy(data_.emplace_back().data(), request.w_data, sizeof(Line));
  }
  while (!addresses_.empty() && !data_.empty()) {
    writes_.push_back({addresses_.front().first, addresses_.front().second, data_.front()});
    addresses_.pop_front();
    data_.pop_front();
  }
}

void LinkModel::judge(const AxiRequest& request) {
  if ((request.ar_valid || request.aw_valid) && !request.single_beats)
    breach("a burst that is not a single 64-byte INCR beat");
  if (request.ar_valid && request.ar_address % 64 != 0) breach("unaligned read");
  if (request.aw_valid && request.aw_address % 64 != 0) breach("unaligned write");
  if (last_.ar_valid &&
      (!request.ar_valid || request.ar_address != last_.ar_address || request.ar_id != last_.ar_id))
    breach("AR changed before it was accepted");
  if (last_.aw_valid &&
      (!request.aw_valid || request.aw_address != last_.aw_address || request.aw_id != last_.aw_id))
    breach("AW changed before it was accepted");
  if (last_.w_valid &&
      (!request.w_valid || std::memcmp(request.w_data, last_data_.data(), sizeof(Line)) != 0))
    breach("W changed before it was accepted");
  last_ = request;
  last_.ar_valid = request.ar_valid && !response_.ar_ready;
  last_.aw_valid = request.aw_valid && !response_.aw_ready;
  last_.w_valid = request.w_valid && !response_.w_ready;
  if (last_.w_valid) std::memcpy(last_data_.data(), request.w_data, sizeof(Line));
}

void LinkModel::breach(const char* what) {
  if (breach_.empty()) breach_ = what;
}

// Lines with a good check word that lie: a page-table entry that is not valid, another AFU's ID.
void LinkModel::fake_line(std::uint64_t, Line& raw) {
  if (fault_.kind != FaultKind::page_fault && fault_.kind != FaultKind::wrong_afu_id) return;
  namespace contract = afu::contract;
  auto line = std::bit_cast<afu::Line>(raw);
  if (!line.check_matches()) return;
  if (fault_.kind == FaultKind::wrong_afu_id) {
    if (line.get(contract::dsm_id::kLow) != contract::kAfuIdLow ||
        line.get(contract::dsm_id::kHigh) != contract::kAfuIdHigh)
      return;
    line.put(contract::dsm_id::kHigh, contract::kAfuIdHigh + 1);
  } else {
    const bool entry = line.words[2] == 0 && line.words[3] == 0 && line.words[6] == 0 &&
                       line.words[1] < contract::kMaxPages && (line.words[0] & 1) != 0;
    if (!entry || line.words[1] < fault_.nth) return;
    line.put(contract::pte::kEntry, line.words[0] & ~std::uint64_t{1});
  }
  line.seal();
  raw = std::bit_cast<Line>(line);
  ++counters_.faults_injected;
}

}  // namespace harpoon::sim
