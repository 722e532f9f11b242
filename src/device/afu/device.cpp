#include "device/afu/device.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <mutex>
#include <new>
#include <optional>
#include <utility>
#include <vector>

#include "device/afu/chunks.hpp"
#include "device/validate.hpp"

namespace harpoon::afu {
namespace {

namespace c = contract;

// Workspaces live at addresses of their own, far from zero and from each other.
constexpr std::uint64_t kFirstAddress = std::uint64_t{1} << 40;
constexpr std::uint64_t kAddressStep = std::uint64_t{1} << 32;
constexpr std::uint32_t kNumberMask = 0x7fff'ffff;

Error error(Errc code, std::string message) {
  return Error{code, std::move(message), 0};
}

void pad_line(std::byte* from, std::uint64_t bytes) noexcept {
  const std::uint64_t tail = bytes % c::kLineBytes;
  if (tail != 0) std::memset(from + bytes, 0, c::kLineBytes - tail);
}

/// One batch as a sequence of transactions.
class Job {
 public:
  virtual ~Job() = default;
  /// The layout of the next transaction, or nothing when the batch is through.
  virtual std::optional<Layout> next() = 0;
  /// Writes the data of the transaction that `next` announced last.
  virtual void fill(const Transaction& transaction) = 0;
  /// Takes the results of the oldest transaction that was not collected.
  /// False when they make no sense (a pair number that was never sent, fewer records than hits).
  virtual bool collect(std::span<const std::byte> results, std::uint64_t hits) = 0;
  [[nodiscard]] virtual Result<Outcome> outcome() const = 0;
};

/// PairBatch in the direct format: results are the caller's records as they are.
class DirectJob final : public Job {
 public:
  DirectJob(const PairBatch<float>& batch, std::uint64_t limit)
      : batch_(batch), cutter_(batch.pairs.size(), limit) {}

  std::optional<Layout> next() override {
    if (!cutter_.more()) return std::nullopt;
    chunks_[asked_++ % 2] = cutter_.next();
    const std::uint64_t pairs = chunks_[(asked_ - 1) % 2].size();
    return Layout{c::Format::direct, pairs, 0, false, pairs};
  }
  void fill(const Transaction& transaction) override {
    const Chunk& chunk = chunks_[(asked_ - 1) % 2];
    if (chunk.size() == 0) return;
    std::memcpy(transaction.source(), &batch_.pairs[chunk.begin], chunk.size() * c::kPairBytes);
    pad_line(transaction.source(), chunk.size() * c::kPairBytes);
  }
  bool collect(std::span<const std::byte> results, std::uint64_t hits) override {
    const Chunk& chunk = chunks_[collected_++ % 2];
    hits_ += hits;
    if (results.size() < chunk.size() * c::kContactBytes) return false;
    if (chunk.size() == 0) return true;
    std::memcpy(&batch_.contacts[chunk.begin], results.data(), chunk.size() * c::kContactBytes);
    return true;
  }
  [[nodiscard]] Result<Outcome> outcome() const override {
    return Outcome{batch_.pairs.size(), hits_, {}};
  }

 private:
  PairBatch<float> batch_;
  ChunkCutter cutter_;
  std::array<Chunk, 2> chunks_;
  std::size_t asked_ = 0, collected_ = 0;
  std::uint64_t hits_ = 0;
};

/// PairBatch in the hits-only format: what does not come back is fake.
class HitsJob final : public Job {
 public:
  HitsJob(const PairBatch<float>& batch, std::uint64_t limit)
      : batch_(batch), cutter_(batch.pairs.size(), limit) {}

  std::optional<Layout> next() override {
    if (!cutter_.more()) return std::nullopt;
    chunks_[asked_++ % 2] = cutter_.next();
    const std::uint64_t pairs = chunks_[(asked_ - 1) % 2].size();
    return Layout{c::Format::direct_hits, pairs, 0, false, pairs};
  }
  void fill(const Transaction& transaction) override {
    const Chunk& chunk = chunks_[(asked_ - 1) % 2];
    if (chunk.size() == 0) return;
    std::memcpy(transaction.source(), &batch_.pairs[chunk.begin], chunk.size() * c::kPairBytes);
    pad_line(transaction.source(), chunk.size() * c::kPairBytes);
  }
  bool collect(std::span<const std::byte> results, std::uint64_t hits) override {
    const Chunk& chunk = chunks_[collected_++ % 2];
    if (results.size() < hits * c::kContactBytes) return false;
    Contact apart{};
    apart.flow_word = c::kFlowFake;
    const std::span<Contact> out = batch_.contacts.subspan(chunk.begin, chunk.size());
    std::fill(out.begin(), out.end(), apart);
    for (std::uint64_t i = 0; i < hits; ++i) {
      Contact contact;
      std::memcpy(&contact, results.data() + i * c::kContactBytes, sizeof contact);
      const std::uint32_t word = contact.flow_word;
      contact.flow_word = (word >> c::kGrazingBit) != 0 ? c::kFlowGrazing : c::kFlowReal;
      if ((word & kNumberMask) >= out.size()) return false;
      out[word & kNumberMask] = contact;
    }
    hits_ += hits;
    return true;
  }
  [[nodiscard]] Result<Outcome> outcome() const override {
    return Outcome{batch_.pairs.size(), hits_, {}};
  }

 private:
  PairBatch<float> batch_;
  ChunkCutter cutter_;
  std::array<Chunk, 2> chunks_;
  std::size_t asked_ = 0, collected_ = 0;
  std::uint64_t hits_ = 0;
};

/// IndexedBatch: the spheres go to the table, all of them at once if they fit, else those that a
/// chunk of pairs names.
class IndexedJob final : public Job {
 public:
  IndexedJob(const IndexedBatch<float>& batch, std::uint64_t limit, std::uint32_t table)
      : batch_(batch), limit_(limit), resident_(batch.spheres.size() <= table) {
    if (!resident_) local_.emplace(batch.spheres.size(), table);
  }

  std::optional<Layout> next() override {
    if (asked_ != 0 && at_ >= batch_.pairs.size()) return std::nullopt;
    Chunk& chunk = chunks_[asked_ % 2];
    std::uint64_t spheres = batch_.spheres.size();
    if (resident_) {
      chunk = {at_, std::min<std::uint64_t>(batch_.pairs.size(), at_ + limit_)};
    } else {
      chunk = local_->cut(batch_.pairs, at_, limit_);
      spheres = local_->globals().size();
    }
    at_ = chunk.end;
    load_ = !resident_ || asked_ == 0;
    ++asked_;
    return Layout{c::Format::indexed_hits, chunk.size(), load_ ? spheres : 0, load_, chunk.size()};
  }

  void fill(const Transaction& transaction) override {
    if (load_) fill_spheres(transaction.spheres());
    const Chunk& chunk = chunks_[(asked_ - 1) % 2];
    std::byte* const source = transaction.source();
    for (std::uint64_t i = chunk.begin; i < chunk.end; ++i) {
      const IndexPair& pair = batch_.pairs[i];
      const std::uint32_t first = resident_ ? pair.g1 : local_->local(pair.g1);
      const std::uint32_t second = resident_ ? pair.g2 : local_->local(pair.g2);
      const std::uint32_t word = first | second << 16;
      std::memcpy(source + (i - chunk.begin) * sizeof word, &word, sizeof word);
    }
    pad_line(source, chunk.size() * 4);
  }

  bool collect(std::span<const std::byte> results, std::uint64_t hits) override {
    const Chunk& chunk = chunks_[collected_++ % 2];
    if (results.size() < hits * c::kContactBytes) return false;
    for (std::uint64_t i = 0; i < hits && hits_ + i < batch_.contacts.size(); ++i) {
      Contact contact;
      std::memcpy(&contact, results.data() + i * c::kContactBytes, sizeof contact);
      const std::uint32_t number = contact.flow_word & kNumberMask;
      if (number >= chunk.size()) return false;
      const IndexPair& pair = batch_.pairs[chunk.begin + number];
      BodyContact& out = batch_.contacts[hits_ + i];
      std::copy(std::begin(contact.pos), std::end(contact.pos), out.pos);
      std::copy(std::begin(contact.normal), std::end(contact.normal), out.normal);
      out.depth = contact.depth;
      out.g1 = pair.g1;
      out.g2 = pair.g2;
    }
    hits_ += hits;
    return true;
  }

  [[nodiscard]] Result<Outcome> outcome() const override {
    if (hits_ > batch_.contacts.size())
      return contacts_capacity_error(batch_.contacts.size(), hits_);
    return Outcome{batch_.pairs.size(), hits_, {}};
  }

 private:
  void fill_spheres(std::byte* to) const {
    if (resident_) {
      if (!batch_.spheres.empty())
        std::memcpy(to, batch_.spheres.data(), batch_.spheres.size_bytes());
      pad_line(to, batch_.spheres.size_bytes());
      return;
    }
    const std::span<const std::uint32_t> globals = local_->globals();
    for (std::size_t i = 0; i < globals.size(); ++i)
      std::memcpy(to + i * c::kSphereBytes, &batch_.spheres[globals[i]], c::kSphereBytes);
    pad_line(to, globals.size() * c::kSphereBytes);
  }

  IndexedBatch<float> batch_;
  std::uint64_t limit_;
  bool resident_, load_ = false;
  std::optional<LocalSpheres> local_;
  std::array<Chunk, 2> chunks_;
  std::uint64_t at_ = 0, hits_ = 0;
  std::size_t asked_ = 0, collected_ = 0;
};

void add(Counters& sum, const Counters& one) noexcept {
  sum.cycles += one.cycles;
  sum.lines_read += one.lines_read;
  sum.lines_written += one.lines_written;
  sum.hits += one.hits;
  sum.scpu_pairs += one.scpu_pairs;
  sum.first_line += one.first_line;
  sum.first_write += one.first_write;
  sum.read_stalls += one.read_stalls;
  sum.write_stalls += one.write_stalls;
  sum.spl2_cycles += one.spl2_cycles;
}

class Afu final : public AfuDevice {
 public:
  Afu(std::unique_ptr<AfuLink> link, const AfuOptions& options)
      : link_(std::move(link)), options_(options) {}

  std::optional<Error> open() {
    Result<std::unique_ptr<Service>> service =
        Service::open(*link_, options_.timeouts, options_.puc);
    if (!service) return service.error();
    service_ = std::move(*service);
    while (workspaces_.size() < Service::kSlots) {
      const std::size_t slot = workspaces_.size();
      Result<Workspace> workspace = Workspace::allocate(*link_, options_.workspace_bytes,
                                                        kFirstAddress + slot * kAddressStep);
      if (!workspace) return workspace.error();
      workspaces_.push_back(std::move(*workspace));
    }
    const AfuIdentity& id = service_->identity();
    const LinkInfo& info = link_->info();
    capabilities_.description = fmt::format("AFU with {} SCPUs at {} MHz, {} link: {}", id.scpus,
                                            info.clock_mhz, info.profile, info.description);
    capabilities_.f32 = true;
    capabilities_.pair_batches = true;
    capabilities_.indexed_batches = true;
    capabilities_.modelled = info.modelled;
    return std::nullopt;
  }

  [[nodiscard]] std::string_view name() const noexcept override { return "afu"; }
  [[nodiscard]] const Capabilities& capabilities() const noexcept override { return capabilities_; }
  [[nodiscard]] const AfuReport& last_run() const noexcept override { return report_; }

  [[nodiscard]] harpoon::Transaction submit(const Batch& batch) noexcept override {
    const std::scoped_lock lock(mutex_);
    try {
      return harpoon::Transaction(run_batch(batch));
    } catch (const std::bad_alloc&) {
      return harpoon::Transaction(Result<Outcome>(
          error(Errc::out_of_memory, "no memory for the AFU's host half; outputs are undefined")));
    }
  }

 private:
  Result<Outcome> run_batch(const Batch& batch);
  Result<Outcome> run_pairs(const PairBatch<float>& batch);
  Result<Outcome> run_indexed(const IndexedBatch<float>& batch);
  Result<Outcome> run_job(Job& job, c::Format format);
  std::optional<Error> transact(Job& job, AfuReport& report);
  std::optional<Error> conclude(Transaction& transaction, AfuReport& report, Counters& counters);
  [[nodiscard]] std::uint64_t limit(std::uint64_t bytes_per_pair, std::uint64_t fixed) const;
  std::uint32_t next_sequence() noexcept { return ++sequence_ == 0 ? ++sequence_ : sequence_; }

  std::unique_ptr<AfuLink> link_;
  AfuOptions options_;
  std::unique_ptr<Service> service_;
  std::vector<Workspace> workspaces_;
  Capabilities capabilities_;
  AfuReport report_;
  std::uint32_t sequence_ = 0;
  std::mutex mutex_;
};

std::uint64_t Afu::limit(std::uint64_t bytes_per_pair, std::uint64_t fixed) const {
  const std::uint64_t room = options_.workspace_bytes - std::min(options_.workspace_bytes, fixed);
  const std::uint64_t fits = std::max<std::uint64_t>(16, room / bytes_per_pair);
  return options_.transaction_pairs == 0 ? fits : std::min(fits, options_.transaction_pairs);
}

Result<Outcome> Afu::run_batch(const Batch& batch) {
  if (std::optional<Error> wrong = validate(batch)) return std::move(*wrong);
  if (!service_) {
    if (std::optional<Error> failure = open()) return std::move(*failure);
  }
  if (const auto* pairs = std::get_if<PairBatch<float>>(&batch)) return run_pairs(*pairs);
  if (const auto* indexed = std::get_if<IndexedBatch<float>>(&batch)) return run_indexed(*indexed);
  return error(Errc::unsupported,
               "the AFU takes float pairs and float indexed pairs; give other batches to the cpu");
}

Result<Outcome> Afu::run_pairs(const PairBatch<float>& batch) {
  const std::uint64_t most = limit(c::kPairBytes + c::kContactBytes, std::uint64_t{3} * 4096);
  if (options_.hits_only) {
    HitsJob job(batch, most);
    return run_job(job, c::Format::direct_hits);
  }
  DirectJob job(batch, most);
  return run_job(job, c::Format::direct);
}

Result<Outcome> Afu::run_indexed(const IndexedBatch<float>& batch) {
  for (std::size_t i = 0; i < batch.pairs.size(); ++i) {
    if (batch.pairs[i].g1 >= batch.spheres.size() || batch.pairs[i].g2 >= batch.spheres.size())
      return index_error(i, batch.pairs[i], batch.spheres.size());
  }
  const std::uint32_t table = service_->identity().table_spheres;
  const std::uint64_t fixed = std::uint64_t{3} * 4096 + std::uint64_t{table} * c::kSphereBytes;
  IndexedJob job(batch, limit(4 + c::kContactBytes, fixed), table);
  return run_job(job, c::Format::indexed_hits);
}

Result<Outcome> Afu::run_job(Job& job, c::Format format) {
  AfuReport report;
  report.link = link_->info();
  report.identity = service_->identity();
  report.format = format;
  const std::uint64_t begin = link_->now();
  if (std::optional<Error> failure = transact(job, report)) {
    if (options_.log) options_.log(LogLevel::error, "afu: " + failure->message);
    // Whatever state the device is in, a cold reset ends it; the next batch opens a new service.
    link_->reset();
    service_.reset();
    return std::move(*failure);
  }
  Result<Outcome> outcome = job.outcome();
  if (!outcome) return outcome;
  report.total_cycles = link_->now() - begin;
  report.pairs = outcome->pairs;
  report.hits = outcome->hits;
  const double busy = static_cast<double>(std::max<std::uint64_t>(1, report.counters.cycles));
  const double moved =
      static_cast<double>(report.counters.lines_read + report.counters.lines_written) *
      c::kLineBytes;
  const double capacity =
      report.link.bytes_per_cycle * (report.link.shared_bandwidth ? 1.0 : 2.0) * busy;
  report.link_occupancy = moved / capacity;
  report.scpu_occupancy =
      static_cast<double>(report.counters.scpu_pairs) / (busy * report.identity.scpus);
  report_ = report;
  outcome->modelled_ns = static_cast<double>(report.total_cycles) * 1000 / report.link.clock_mhz;
  if (!report.link.modelled) outcome->modelled_ns.reset();
  return outcome;
}

// Double buffered: while one transaction runs, the data of the next is written to the other
// workspace, and the results of the last are taken.
std::optional<Error> Afu::transact(Job& job, AfuReport& report) {
  std::optional<Transaction> running;
  std::size_t slot = 0;
  std::optional<Layout> layout = job.next();
  while (layout || running) {
    std::optional<Transaction> prepared;
    if (layout) {
      if (workspace_bytes(*layout) > workspaces_[slot].bytes()) {
        return error(Errc::invalid_argument,
                     fmt::format("a transaction needs {} bytes of workspace, there are {}; raise "
                                 "workspace_bytes",
                                 workspace_bytes(*layout), workspaces_[slot].bytes()));
      }
      prepared.emplace(*service_, slot, workspaces_[slot], *layout, options_.log);
      job.fill(*prepared);
    }
    Counters counters;
    if (running) {
      if (std::optional<Error> failure = conclude(*running, report, counters)) return failure;
    }
    if (prepared) prepared->start(next_sequence());
    if (running) {
      Result<std::span<const std::byte>> results = running->results();
      if (!results) return results.error();
      if (!job.collect(*results, counters.hits))
        return error(Errc::device_fault, "the AFU's results do not fit its counters");
      running->release();
      report.last_steps = running->steps();
    }
    running.reset();
    if (prepared) running.emplace(*prepared);
    slot = 1 - slot;
    layout = layout ? job.next() : std::nullopt;
  }
  return std::nullopt;
}

std::optional<Error> Afu::conclude(Transaction& transaction, AfuReport& report,
                                   Counters& counters) {
  Result<Counters> finished = transaction.finish();
  if (!finished) return finished.error();
  counters = *finished;
  add(report.counters, counters);
  ++report.transactions;
  return std::nullopt;
}

}  // namespace

Result<std::unique_ptr<AfuDevice>> make_afu_device(std::unique_ptr<AfuLink> link,
                                                   const AfuOptions& options) {
  if (!link) return error(Errc::invalid_argument, "make_afu_device needs a link, got null");
  auto device = std::make_unique<Afu>(std::move(link), options);
  if (std::optional<Error> failure = device->open()) return std::move(*failure);
  return std::unique_ptr<AfuDevice>(std::move(device));
}

std::string_view afu_absent_reason() noexcept {
  return "no AFU board on this machine; build with Verilator to simulate one (library "
         "harpoon_afu_sim)";
}

}  // namespace harpoon::afu
