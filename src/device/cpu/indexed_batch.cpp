#include "device/cpu/indexed_batch.hpp"

#include <algorithm>
#include <memory>
#include <vector>

#include "base/float_environment.hpp"
#include "device/validate.hpp"

namespace harpoon::cpu {
namespace {

/// Batches up to this size stay on the calling thread.
constexpr std::size_t kSmallBatch = 1024;
/// Pairs of one task.
constexpr std::size_t kBlock = 8192;
/// Tasks under way at a time, for each thread.
constexpr std::size_t kBlocksPerThread = 8;

/// Writes those of `count` hits for which there is room.
template <class Real>
void fill(const KernelsOf<Real>& kernels, const IndexedBatch<Real>& batch, const IndexPair* pairs,
          const std::uint32_t* hits, std::size_t count, std::uint64_t position) {
  if (position >= batch.contacts.size()) return;
  const std::size_t room = batch.contacts.size() - position;
  kernels.fill_hits(batch.spheres.data(), pairs, hits, std::min(count, room),
                    batch.contacts.data() + position);
}

template <class Real>
std::uint64_t run_here(const KernelsOf<Real>& kernels, const IndexedBatch<Real>& batch) {
  const FloatEnvironment environment;
  return kernels.collide_hits(batch.spheres.data(), batch.pairs.data(), batch.pairs.size(),
                              batch.contacts.data(), batch.contacts.size());
}

/// Windows of blocks: in each, all blocks are searched, then all are written to their places.
template <class Real>
Result<std::uint64_t> run_windows(const KernelsOf<Real>& kernels, Executor& executor,
                                  const IndexedBatch<Real>& batch) {
  const std::size_t total = batch.pairs.size();
  const std::size_t window_blocks =
      std::min((total + kBlock - 1) / kBlock, kBlocksPerThread * executor.threads());
  const auto hits = std::make_unique_for_overwrite<std::uint32_t[]>(window_blocks * kBlock);
  std::vector<std::size_t> counts(window_blocks);
  std::vector<std::uint64_t> positions(window_blocks);
  std::uint64_t found = 0;
  for (std::size_t begin = 0; begin < total; begin += window_blocks * kBlock) {
    const std::size_t blocks = std::min(window_blocks, (total - begin + kBlock - 1) / kBlock);
    const auto pairs_of = [&](std::size_t block) {
      return batch.pairs.data() + begin + block * kBlock;
    };
    if (auto error = executor.run(blocks, [&](std::size_t block) {
          const std::size_t size = std::min(kBlock, total - begin - block * kBlock);
          counts[block] = kernels.find_hits(batch.spheres.data(), pairs_of(block), size,
                                            hits.get() + block * kBlock);
        })) {
      return *std::move(error);
    }
    for (std::size_t block = 0; block < blocks; ++block) {
      positions[block] = found;
      found += counts[block];
    }
    if (auto error = executor.run(blocks, [&](std::size_t block) {
          fill(kernels, batch, pairs_of(block), hits.get() + block * kBlock, counts[block],
               positions[block]);
        })) {
      return *std::move(error);
    }
  }
  return found;
}

/// The first pair with an index out of range; there is one.
Error first_index_error(std::span<const IndexPair> pairs, std::uint64_t spheres) {
  const auto bad = std::find_if(pairs.begin(), pairs.end(), [&](const IndexPair& p) {
    return p.g1 >= spheres || p.g2 >= spheres;
  });
  return index_error(static_cast<std::uint64_t>(bad - pairs.begin()), *bad, spheres);
}

}  // namespace

template <class Real>
Result<Outcome> run_indexed(const Kernels& kernels, Executor& executor,
                            const IndexedBatch<Real>& batch) {
  const std::size_t total = batch.pairs.size();
  if (total == 0) return Outcome{};
  if (kernels.max_index(batch.pairs.data(), total) >= batch.spheres.size()) {
    return first_index_error(batch.pairs, batch.spheres.size());
  }
  std::uint64_t hits = 0;
  if (total <= kSmallBatch || executor.threads() == 1) {
    hits = run_here(kernels.of<Real>(), batch);
  } else {
    const Result<std::uint64_t> found = run_windows(kernels.of<Real>(), executor, batch);
    if (!found) return found.error();
    hits = *found;
  }
  if (hits > batch.contacts.size()) return contacts_capacity_error(batch.contacts.size(), hits);
  return Outcome{.pairs = total, .hits = hits};
}

template Result<Outcome> run_indexed(const Kernels&, Executor&, const IndexedBatch<float>&);
template Result<Outcome> run_indexed(const Kernels&, Executor&, const IndexedBatch<double>&);

}  // namespace harpoon::cpu
