#include "device/afu/runtime.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace harpoon::afu {
namespace {

namespace c = contract;

// The system page: SPL2 DSM, AFU DSM, then per slot an SPL2_CNTXT and a page table.
constexpr std::uint64_t kSplDsmAt = 0;
constexpr std::uint64_t kAfuDsmAt = c::kDsmBytes;
constexpr std::uint64_t kContextAt = 2 * std::uint64_t{c::kDsmBytes};
constexpr std::uint64_t kTableBytes = std::uint64_t{c::kMaxPages} * c::kLineBytes;
constexpr std::uint64_t kTableAt = kTableBytes;
static_assert(kTableAt + Service::kSlots * kTableBytes <= c::kPageBytes);
static_assert(kContextAt + Service::kSlots * c::kLineBytes <= kTableAt);

Error error(Errc code, std::string message) {
  return Error{code, std::move(message), 0};
}

std::string_view describe(c::Spl2Fault fault) noexcept {
  switch (fault) {
    case c::Spl2Fault::none:
      return "none";
    case c::Spl2Fault::pte_load_error:
      return "context or page table not valid";
    case c::Spl2Fault::access_violation:
      return "address outside the mapped pages";
    case c::Spl2Fault::bus_error:
      return "error response from memory";
    case c::Spl2Fault::unexpected_response:
      return "response without a request";
  }
  return "unknown";
}

}  // namespace

std::string describe_fault(std::uint32_t fault, std::uint32_t request, std::uint64_t address) {
  return fmt::format("SPL2 fault {} ({}) on a {} at {:#x}", fault,
                     describe(static_cast<c::Spl2Fault>(fault)),
                     request == c::kRequestWrite ? "write" : "read", address);
}

std::string_view describe(c::AfuError error) noexcept {
  switch (error) {
    case c::AfuError::none:
      return "no error";
    case c::AfuError::bad_context:
      return "VAFU2_CNTXT does not match its check word";
    case c::AfuError::bad_control:
      return "the control line does not match its check word";
    case c::AfuError::bad_format:
      return "unknown format";
    case c::AfuError::source_too_short:
      return "n_col needs more lines than Src has";
    case c::AfuError::too_many_spheres:
      return "more spheres than the table holds";
    case c::AfuError::index_out_of_range:
      return "an index pair names a sphere that is not loaded";
  }
  return "unknown error";
}

// ---- Workspace ---------------------------------------------------------------------------------

Workspace::Workspace(AfuLink& link, SharedMemory memory, std::uint64_t address) noexcept
    : link_(&link), memory_(std::move(memory)), address_(address) {}

Workspace::Workspace(Workspace&& other) noexcept
    : link_(std::exchange(other.link_, nullptr)),
      memory_(std::move(other.memory_)),
      address_(other.address_) {}

Workspace& Workspace::operator=(Workspace&& other) noexcept {
  std::swap(link_, other.link_);
  std::swap(memory_, other.memory_);
  std::swap(address_, other.address_);
  return *this;
}

Workspace::~Workspace() {
  if (link_ != nullptr) link_->release(memory_);
}

Result<Workspace> Workspace::allocate(AfuLink& link, std::uint64_t bytes, std::uint64_t address) {
  if (bytes == 0 || bytes > c::kMaxWorkspaceBytes) {
    return error(Errc::invalid_argument,
                 fmt::format("a workspace of {} bytes; SPL2 maps 1 to {} bytes (1024 pages of "
                             "2 MB). Cut the batch.",
                             bytes, c::kMaxWorkspaceBytes));
  }
  Result<SharedMemory> memory = link.allocate(bytes);
  if (!memory) return memory.error();
  return Workspace(link, std::move(*memory), address);
}

// ---- Service -----------------------------------------------------------------------------------

std::optional<Error> check(const Timeouts& timeouts) {
  const std::pair<const char*, double> limits[] = {{"identify_us", timeouts.identify_us},
                                                   {"transaction_us", timeouts.transaction_us},
                                                   {"per_pair_us", timeouts.per_pair_us}};
  for (const auto& [name, limit] : limits) {
    if (limit >= 0 && limit <= kMostTimeoutUs) continue;
    return error(Errc::invalid_argument,
                 fmt::format("the time limit {} is {} microseconds; give 0 to {}", name, limit,
                             kMostTimeoutUs));
  }
  return std::nullopt;
}

Service::Service(AfuLink& link, const Timeouts& timeouts, const PucSettings& settings,
                 SharedMemory system) noexcept
    : link_(link), timeouts_(timeouts), settings_(settings), system_(std::move(system)) {}

Service::~Service() {
  link_.release(system_);
}

std::uint64_t Service::cycles(double microseconds) const noexcept {
  constexpr double kMostCycles = 1e18;  // no clock comes there
  return static_cast<std::uint64_t>(
      std::min(kMostCycles, std::ceil(microseconds * link_.info().clock_mhz)));
}

std::uint32_t Service::lines_in_flight() const noexcept {
  return settings_.lines_in_flight != 0 ? settings_.lines_in_flight : link_.info().lines_in_flight;
}

std::uint64_t Service::batches(std::uint64_t pairs) const noexcept {
  return settings_.batch_barrier ? pairs / std::max(1U, identity_.scpus) + 1 : 0;
}

std::uint64_t Service::link_cycles(std::uint64_t lines, std::uint64_t batches) const noexcept {
  // Contexts, page tables, control, DSM and status, one after the other.
  constexpr std::uint64_t kExchanges = 8;
  // What the AFU itself takes from end to end, however slow its clock: latencies, lines,
  // and the emptying of its pipelines at a barrier.
  constexpr std::uint64_t kPipelineCycles = 2048;
  constexpr std::uint64_t kCyclesPerLine = 4;
  constexpr std::uint64_t kCyclesPerBatch = 512;
  constexpr double kUsPerNs = 1e-3;
  constexpr double kSlack = 2;
  const LinkInfo& info = link_.info();
  const std::uint64_t trips = kExchanges + batches + lines / std::max(1U, lines_in_flight());
  const double moving_cycles =
      info.bytes_per_cycle > 0 ? static_cast<double>(lines) * c::kLineBytes / info.bytes_per_cycle
                               : 0;
  return kPipelineCycles + kCyclesPerLine * lines + kCyclesPerBatch * batches +
         cycles(kSlack * (static_cast<double>(trips) * info.round_trip_ns * kUsPerNs +
                          moving_cycles / info.clock_mhz));
}

std::uint64_t Service::physical(std::uint64_t offset) const noexcept {
  return system_.page_addresses.front() + offset;
}

void Service::write_address(std::uint32_t offset, std::uint64_t address) {
  link_.write_register(offset + 4, static_cast<std::uint32_t>(address >> 32));
  link_.write_register(offset, static_cast<std::uint32_t>(address));
}

Line Service::afu_dsm(std::uint32_t line) const noexcept {
  return load_line(system_.data + kAfuDsmAt + std::uint64_t{line} * c::kLineBytes);
}

Line Service::spl_dsm(std::uint32_t line) const noexcept {
  return load_line(system_.data + kSplDsmAt + std::uint64_t{line} * c::kLineBytes);
}

Result<std::unique_ptr<Service>> Service::open(AfuLink& link, const Timeouts& timeouts,
                                               const PucSettings& settings) {
  if (std::optional<Error> wrong = check(timeouts)) return std::move(*wrong);
  Result<SharedMemory> system = link.allocate(c::kPageBytes);
  if (!system) return system.error();
  std::unique_ptr<Service> service(new Service(link, timeouts, settings, std::move(*system)));
  link.reset();
  if (std::optional<Error> failure = service->identify()) return std::move(*failure);
  return service;
}

std::optional<Error> Service::identify() {
  link_.write_register(c::kRegInFlight, lines_in_flight());
  link_.write_register(c::kRegPucMode, settings_.batch_barrier ? c::kModeBatchBarrier : 0);
  const std::uint64_t deadline = link_.now() + cycles(timeouts_.identify_us) + link_cycles(0, 0);
  write_address(c::kRegSplDsmBase, physical(kSplDsmAt));
  while (spl_dsm(c::kSplDsmIdLine).words[0] != c::kSplId ||
         !spl_dsm(c::kSplDsmIdLine).check_matches()) {
    if (link_.now() > deadline) return silence("SPL2 did not write its ID");
    link_.advance(1);
  }
  write_address(c::kRegAfuDsmBase, physical(kAfuDsmAt));
  Line line = afu_dsm(c::kDsmIdLine);
  while (line.words[0] == 0 || !line.check_matches()) {
    if (link_.now() > deadline) return silence("the AFU did not write its ID");
    link_.advance(1);
    line = afu_dsm(c::kDsmIdLine);
  }
  const std::uint32_t config = line.get32(c::dsm_id::kConfig);
  identity_ = {
      line.get(c::dsm_id::kLow), line.get(c::dsm_id::kHigh), config & 0xff,
      config >> 8 & 0xff,        config >> 16 & 0xff,        line.get32(c::dsm_id::kTableSpheres)};
  if (identity_.id_low != c::kAfuIdLow || identity_.id_high != c::kAfuIdHigh) {
    return error(
        Errc::device_fault,
        fmt::format("another AFU answers: ID {:016x}{:016x}, expected {:016x}{:016x}. Load "
                    "Harpoon's AFU.",
                    identity_.id_high, identity_.id_low, c::kAfuIdHigh, c::kAfuIdLow));
  }
  return std::nullopt;
}

void Service::map(std::size_t slot, const Workspace& workspace, std::uint64_t bytes) noexcept {
  const std::uint64_t table = kTableAt + slot * kTableBytes;
  const std::span<const std::uint64_t> pages(workspace.memory().page_addresses.data(),
                                             (bytes + c::kPageBytes - 1) / c::kPageBytes);
  for (std::size_t i = 0; i < pages.size(); ++i) {
    Line entry;
    entry.put(c::pte::kEntry, pages[i] | 1);
    entry.put(c::pte::kIndex, i);
    entry.seal();
    store_line(system_.data + table + i * c::kLineBytes, entry);
  }
  Line context;
  context.put(c::spl2_cntxt::kPageTable, physical(table));
  context.put(c::spl2_cntxt::kAfuContext, workspace.address());
  context.put(c::spl2_cntxt::kPageSize, 1);
  context.put(c::spl2_cntxt::kPageCount, pages.size());
  context.put(c::spl2_cntxt::kControl, 1);
  context.put(c::spl2_cntxt::kHandle, slot);
  context.put(c::spl2_cntxt::kAfuDsm, physical(kAfuDsmAt));
  context.seal();
  store_line(system_.data + kContextAt + slot * c::kLineBytes, context);
}

void Service::enable(std::size_t slot, const Workspace& workspace) {
  write_address(c::kRegSpl2CntxtBase, physical(kContextAt + slot * c::kLineBytes));
  write_address(c::kRegAfuCntxtBase, workspace.address());
  link_.write_register(c::kRegSpl2ChCtrl, c::kChEnable);
}

std::optional<Error> Service::reported_fault() const {
  const Line line = spl_dsm(c::kSplDsmFaultLine);
  if (line.get(c::spl_fault::kValid) == 0 || !line.check_matches()) return std::nullopt;
  return error(Errc::device_fault,
               describe_fault(line.get32(c::spl_fault::kStatus), line.get32(c::spl_fault::kRequest),
                              line.get(c::spl_fault::kAddress)) +
                   ". The device was reset.");
}

Error Service::silence(std::string_view what) {
  const std::uint32_t fault = link_.read_register(c::kRegSpl2Fault);
  if ((fault & 1) != 0) {
    const std::uint64_t address = link_.read_register(c::kRegFaultAddressLow) |
                                  std::uint64_t{link_.read_register(c::kRegFaultAddressHigh)} << 32;
    return error(Errc::device_fault,
                 fmt::format("{}; {}. The device was reset.", what,
                             describe_fault(fault >> 4 & 0xf, fault >> 8 & 0xf, address)));
  }
  const std::uint32_t state = link_.read_register(c::kRegState);
  return error(
      Errc::device_timeout,
      fmt::format("{} in time; PUC state {}, SPL2 state {}, {} reads and {} writes "
                  "outstanding. The device was reset.",
                  what, state & 0xf, state >> 4 & 0xf, state >> 8 & 0xff, state >> 16 & 0xff));
}

}  // namespace harpoon::afu
