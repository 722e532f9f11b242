#include "device/afu/chunks.hpp"

#include <algorithm>

namespace harpoon::afu {

Chunk ChunkCutter::next() noexcept {
  const Chunk chunk{at_, std::min(pairs_, at_ + limit_)};
  at_ = chunk.end;
  first_ = false;
  return chunk;
}

LocalSpheres::LocalSpheres(std::uint64_t spheres, std::uint32_t table)
    : local_(spheres), epoch_(spheres, 0), table_(table) {}

bool LocalSpheres::name(std::uint32_t global) {
  if (epoch_[global] == now_) return true;
  if (globals_.size() == table_) return false;
  epoch_[global] = now_;
  local_[global] = static_cast<std::uint32_t>(globals_.size());
  globals_.push_back(global);
  return true;
}

Chunk LocalSpheres::cut(std::span<const IndexPair> pairs, std::uint64_t begin,
                        std::uint64_t limit) {
  globals_.clear();
  ++now_;
  Chunk chunk{begin, begin};
  const std::uint64_t end = std::min<std::uint64_t>(pairs.size(), begin + limit);
  while (chunk.end < end && name(pairs[chunk.end].g1) && name(pairs[chunk.end].g2)) ++chunk.end;
  return chunk;
}

}  // namespace harpoon::afu
