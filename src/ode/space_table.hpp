#pragma once

// From spaces to their records, for any number of threads. A look-up that repeats one of the
// thread's last takes no lock.

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <unordered_map>

#include "ode/types.hpp"

namespace harpoon::ode {

template <class Record>
class SpaceTable {
 public:
  SpaceTable() { renew(); }

  [[nodiscard]] bool empty() const { return size_.load(std::memory_order_relaxed) == 0; }

  [[nodiscard]] std::size_t size() const { return size_.load(std::memory_order_relaxed); }

  /// The record of a space or null. It lives until the space is erased, or longer for those who
  /// hold it by `hold`.
  Record* find(dxSpace* space) {
    static thread_local Cache cache;
    Entry& entry = cache.entries[hash(space)];
    const std::uint64_t now = generation_.load(std::memory_order_acquire);
    if (entry.generation != now || entry.space != space) {
      const std::lock_guard lock(mutex_);
      const auto found = records_.find(space);
      entry = {generation_.load(std::memory_order_relaxed), space,
               found == records_.end() ? nullptr : found->second.get()};
    }
    return entry.record;
  }

  std::shared_ptr<Record> hold(dxSpace* space) {
    const std::lock_guard lock(mutex_);
    const auto found = records_.find(space);
    return found == records_.end() ? nullptr : found->second;
  }

  /// Adds or replaces the record of a space. Throws std::bad_alloc.
  Record* put(dxSpace* space, std::shared_ptr<Record> record) {
    const std::lock_guard lock(mutex_);
    Record* const raw = record.get();
    records_[space] = std::move(record);
    size_.store(records_.size(), std::memory_order_relaxed);
    renew();
    return raw;
  }

  void erase(dxSpace* space) {
    const std::lock_guard lock(mutex_);
    if (records_.erase(space) == 0) return;
    size_.store(records_.size(), std::memory_order_relaxed);
    renew();
  }

  void clear() {
    const std::lock_guard lock(mutex_);
    records_.clear();
    size_.store(0, std::memory_order_relaxed);
    renew();
  }

  void for_each(const std::function<void(Record&)>& visit) {
    const std::lock_guard lock(mutex_);
    for (auto& [space, record] : records_) visit(*record);
  }

 private:
  struct Entry {
    std::uint64_t generation = 0;
    dxSpace* space = nullptr;
    Record* record = nullptr;
  };
  static constexpr std::size_t kEntries = 16;
  struct Cache {
    Entry entries[kEntries];
  };

  static std::size_t hash(const dxSpace* space) {
    const auto bits = reinterpret_cast<std::uintptr_t>(space);
    return (bits >> 4 ^ bits >> 9) % kEntries;
  }

  /// Generations are never used twice, not even by another table, so that what a thread remembers
  /// of an older state is never taken for the current one.
  void renew() {
    static std::atomic<std::uint64_t> last{0};
    generation_.store(last.fetch_add(1, std::memory_order_relaxed) + 1, std::memory_order_release);
  }

  std::mutex mutex_;
  std::unordered_map<dxSpace*, std::shared_ptr<Record>> records_;
  std::atomic<std::size_t> size_{0};
  std::atomic<std::uint64_t> generation_{0};
};

}  // namespace harpoon::ode
