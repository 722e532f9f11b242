#pragma once

// Cuts a batch into transactions that fit a workspace and, in the indexed format, the AFU's sphere
// table. Pure arithmetic and copying; knows nothing of links.

#include <cstdint>
#include <span>
#include <vector>

#include "harpoon/records.hpp"

namespace harpoon::afu {

/// Pairs [begin, end) of a batch that go through one transaction.
struct Chunk {
  std::uint64_t begin = 0, end = 0;
  [[nodiscard]] std::uint64_t size() const noexcept { return end - begin; }
};

/// Chunks of at most `limit` pairs; an empty batch is one empty chunk.
class ChunkCutter {
 public:
  ChunkCutter(std::uint64_t pairs, std::uint64_t limit) noexcept : pairs_(pairs), limit_(limit) {}
  [[nodiscard]] bool more() const noexcept { return first_ || at_ < pairs_; }
  Chunk next() noexcept;

 private:
  std::uint64_t pairs_, limit_, at_ = 0;
  bool first_ = true;
};

/// Local numbering of the spheres that a chunk of index pairs names, when the whole array does not
/// fit the table. `cut` takes as many pairs from `begin` on as keep the named spheres within
/// `table`, at most `limit`.
class LocalSpheres {
 public:
  LocalSpheres(std::uint64_t spheres, std::uint32_t table);
  Chunk cut(std::span<const IndexPair> pairs, std::uint64_t begin, std::uint64_t limit);
  /// The spheres named by the last chunk, in local order.
  [[nodiscard]] std::span<const std::uint32_t> globals() const noexcept { return globals_; }
  [[nodiscard]] std::uint32_t local(std::uint32_t global) const noexcept { return local_[global]; }

 private:
  bool name(std::uint32_t global);
  std::vector<std::uint32_t> local_, epoch_;  // by global index
  std::vector<std::uint32_t> globals_;
  std::uint32_t table_, now_ = 0;
};

}  // namespace harpoon::afu
