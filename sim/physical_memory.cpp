#include "physical_memory.hpp"

#include <sys/mman.h>

#include <algorithm>

#include "device/afu/contract.hpp"

namespace harpoon::sim {
namespace {

constexpr std::uint64_t kPageBytes = afu::contract::kPageBytes;
constexpr std::uint64_t kPhysicalPages = std::uint64_t{1} << 25;  // 64 TB of addresses

}  // namespace

PhysicalMemory::~PhysicalMemory() {
  for (const afu::SharedMemory& memory : owned_) ::munmap(memory.data, memory.bytes);
}

Result<afu::SharedMemory> PhysicalMemory::allocate(std::uint64_t bytes) {
  const std::uint64_t pages = std::max<std::uint64_t>(1, (bytes + kPageBytes - 1) / kPageBytes);
  void* const data = ::mmap(nullptr, pages * kPageBytes, PROT_READ | PROT_WRITE,
                            MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (data == MAP_FAILED)
    return Error{Errc::out_of_memory, "no memory for a shared buffer; ask for less", 0};
  afu::SharedMemory memory{static_cast<std::byte*>(data), pages * kPageBytes, {}};
  while (memory.page_addresses.size() < pages) {
    const std::uint64_t page = 1 + random_() % (kPhysicalPages - 1);
    std::byte* const host = memory.data + memory.page_addresses.size() * kPageBytes;
    if (pages_.emplace(page, host).second) memory.page_addresses.push_back(page * kPageBytes);
  }
  owned_.push_back(memory);
  return memory;
}

void PhysicalMemory::release(const afu::SharedMemory& memory) noexcept {
  const auto mine = std::find_if(owned_.begin(), owned_.end(),
                                 [&](const auto& m) { return m.data == memory.data; });
  if (mine == owned_.end()) return;
  for (const std::uint64_t address : mine->page_addresses) pages_.erase(address / kPageBytes);
  ::munmap(mine->data, mine->bytes);
  owned_.erase(mine);
  recent_.fill({});
}

std::byte* PhysicalMemory::line(std::uint64_t address) noexcept {
  const std::uint64_t page = address / kPageBytes;
  Recent& recent = recent_[page % recent_.size()];
  if (page != recent.page) {
    const auto found = pages_.find(page);
    if (found == pages_.end()) return nullptr;
    recent = {page, found->second};
  }
  return recent.data + address % kPageBytes;
}

}  // namespace harpoon::sim
