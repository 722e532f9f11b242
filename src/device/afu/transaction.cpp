#include "device/afu/transaction.hpp"

#include <fmt/format.h>

#include <atomic>

namespace harpoon::afu {
namespace {

namespace c = contract;

constexpr std::uint64_t kDataAt = 4096;  // Src begins after the context's page

std::uint64_t lines(std::uint64_t bytes) noexcept {
  return (bytes + c::kLineBytes - 1) / c::kLineBytes;
}

std::uint64_t whole_lines(std::uint64_t bytes) noexcept {
  return lines(bytes) * c::kLineBytes;
}

std::uint64_t source_bytes(const Layout& layout) noexcept {
  const bool indexed = layout.format == c::Format::indexed_hits;
  return whole_lines(layout.pairs * (indexed ? 4 : c::kPairBytes));
}

Error fault(std::string message) {
  return Error{Errc::device_fault, std::move(message), 0};
}

}  // namespace

std::uint64_t workspace_bytes(const Layout& layout) noexcept {
  return kDataAt + whole_lines(layout.spheres * c::kSphereBytes) + source_bytes(layout) +
         whole_lines(layout.dest_records * c::kContactBytes);
}

Transaction::Transaction(Service& service, std::size_t slot, Workspace& workspace,
                         const Layout& layout, const Log& log)
    : service_(service), slot_(slot), workspace_(workspace), layout_(layout), log_(log) {
  spheres_at_ = kDataAt;
  sphere_bytes_ = whole_lines(layout.spheres * c::kSphereBytes);
  source_at_ = spheres_at_ + sphere_bytes_;
  source_bytes_ = source_bytes(layout);
  dest_at_ = source_at_ + source_bytes_;
  dest_bytes_ = whole_lines(layout.dest_records * c::kContactBytes);
  step(1, "pointers to Src, Dst and the AFU context");
}

std::byte* Transaction::spheres() const noexcept {
  return workspace_.at(spheres_at_);
}

std::byte* Transaction::source() const noexcept {
  return workspace_.at(source_at_);
}

void Transaction::step(int number, std::string_view what) {
  const std::uint64_t now = service_.link().now();
  steps_[static_cast<std::size_t>(number - 1)] = now;
  if (log_) log_(LogLevel::info, fmt::format("afu: cycle {}: step {}: {}", now, number, what));
}

void Transaction::start(std::uint32_t sequence) {
  sequence_ = sequence;
  Digest digest;
  if (layout_.load_table) digest.add(spheres(), sphere_bytes_);
  digest.add(source(), source_bytes_);
  source_digest_ = digest.value();

  Line context;
  context.put(c::vafu2_cntxt::kSource, workspace_.address() + source_at_);
  context.put(c::vafu2_cntxt::kDest, workspace_.address() + dest_at_);
  context.put(c::vafu2_cntxt::kSourceLines, lines(source_bytes_));
  context.put(c::vafu2_cntxt::kDestLines, lines(dest_bytes_));
  context.put(c::vafu2_cntxt::kSpheres, workspace_.address() + spheres_at_);
  context.put(c::vafu2_cntxt::kSphereCount, layout_.spheres);
  context.seal();
  store_line(workspace_.at(0), context);
  store_line(workspace_.at(c::vafu2_cntxt::kStatusOffset), Line{});
  store_line(workspace_.at(c::vafu2_cntxt::kControlOffset), Line{});
  service_.map(slot_, workspace_, dest_at_ + dest_bytes_);
  const std::uint64_t begin = service_.link().now();
  service_.enable(slot_, workspace_);
  step(2, "data is in Src, SPL started");

  Line control;
  control.put(c::control::kStart, c::control::kGo);
  control.put(c::control::kPairCount, layout_.pairs);
  control.put(c::control::kFormat, static_cast<std::uint32_t>(layout_.format));
  control.put(c::control::kSequence, sequence);
  control.put(c::control::kLoadTable, layout_.load_table ? 1 : 0);
  control.seal();
  // The start byte is written last: first the line without it, then the word that holds it.
  Line quiet = control;
  quiet.put(c::control::kStart, 0);
  std::byte* const place = workspace_.at(c::vafu2_cntxt::kControlOffset);
  store_line(place, quiet);
  std::atomic_thread_fence(std::memory_order_release);
  store_line(place, control);
  step(3, fmt::format("start signal, n_col = {}", layout_.pairs));
  const Timeouts& limits = service_.timeouts();
  deadline_ = begin +
              service_.cycles(limits.transaction_us +
                              limits.per_pair_us * static_cast<double>(layout_.pairs)) +
              service_.link_cycles(lines(sphere_bytes_ + source_bytes_ + dest_bytes_),
                                   service_.batches(layout_.pairs));
}

/// Polls until `ready` or a fault or the deadline.
template <class Ready>
std::optional<Error> Transaction::wait(const Ready& ready, std::string_view silence) {
  while (!ready()) {
    if (std::optional<Error> reported = service_.reported_fault()) return reported;
    if (service_.link().now() > deadline_) return service_.silence(silence);
    service_.link().advance(1);
  }
  return std::nullopt;
}

std::optional<Error> Transaction::wait_for_id() {
  bool stranger = false;
  const auto running = [&] {
    const Line id = service_.afu_dsm(c::kDsmIdLine);
    if (id.get32(c::dsm_id::kSequence) == sequence_ && id.check_matches()) {
      stranger =
          id.get(c::dsm_id::kLow) != c::kAfuIdLow || id.get(c::dsm_id::kHigh) != c::kAfuIdHigh;
      return true;
    }
    // A transaction that the AFU refuses ends without the ID.
    const Line status = load_line(workspace_.at(c::vafu2_cntxt::kStatusOffset));
    return status.get32(c::status::kSequence) == sequence_ && status.check_matches();
  };
  if (std::optional<Error> error = wait(running, "the AFU did not write its ID")) return error;
  if (stranger) return fault("another AFU answers in the DSM. The device was reset.");
  step(4, "the AFU ID is in the DSM");
  return std::nullopt;
}

std::optional<Error> Transaction::wait_for_done() {
  Line status;
  const auto done = [&] {
    const Line line = load_line(workspace_.at(c::vafu2_cntxt::kStatusOffset));
    if ((line.words[0] & c::status::kDone) == 0) return false;
    status = line;
    return line.get32(c::status::kSequence) == sequence_ && line.check_matches();
  };
  if (std::optional<Error> error = wait(done, "the AFU did not finish")) return error;
  if ((status.get32(c::status::kStatus) & c::status::kFailed) != 0) {
    const std::uint32_t code = status.get32(c::status::kError);
    return fault(fmt::format("the AFU reports error {}: {}. The device was reset.", code,
                             describe(static_cast<c::AfuError>(code))));
  }
  step(5, "the AFU is done");
  return std::nullopt;
}

Result<Counters> Transaction::read_counters() {
  // Acknowledged before Status, so they are there; only a torn or lost line makes us wait.
  Line performance, latency;
  const auto there = [&] {
    performance = service_.afu_dsm(c::kDsmPerformanceLine);
    latency = service_.afu_dsm(c::kDsmLatencyLine);
    return performance.get32(c::dsm_performance::kSequence) == sequence_ &&
           performance.check_matches() && latency.get32(c::dsm_latency::kSequence) == sequence_ &&
           latency.check_matches();
  };
  if (std::optional<Error> error = wait(there, "the AFU's counters did not appear"))
    return std::move(*error);
  namespace p = c::dsm_performance;
  namespace l = c::dsm_latency;
  if (performance.get(p::kSourceDigest) != source_digest_) {
    return fault(
        "what the AFU read from Src is not what was sent (digests differ). The device was reset.");
  }
  dest_digest_ = performance.get(p::kDestDigest);
  lines_written_ = performance.get32(p::kLinesWritten);
  return Counters{performance.get32(p::kCycles),
                  performance.get32(p::kLinesRead),
                  lines_written_,
                  performance.get32(p::kHits),
                  performance.get32(p::kScpuPairs),
                  latency.get32(l::kFirstLine),
                  latency.get32(l::kFirstWrite),
                  latency.get32(l::kReadStalls),
                  latency.get32(l::kWriteStalls),
                  latency.get32(l::kSpl2Cycles)};
}

Result<Counters> Transaction::finish() {
  if (std::optional<Error> error = wait_for_id()) return std::move(*error);
  if (std::optional<Error> error = wait_for_done()) return std::move(*error);
  return read_counters();
}

Result<std::span<const std::byte>> Transaction::results() {
  const std::span<const std::byte> data{workspace_.at(dest_at_), lines_written_ * c::kLineBytes};
  Digest digest;
  if (data.size() <= dest_bytes_) digest.add(data.data(), data.size());
  if (data.size() > dest_bytes_ || digest.value() != dest_digest_) {
    return fault(
        "what is in Dst is not what the AFU wrote (digests differ). The device was reset.");
  }
  step(6, "results retrieved from Dst");
  return data;
}

void Transaction::release() {
  step(7, "transaction ended, workspace free");
}

}  // namespace harpoon::afu
