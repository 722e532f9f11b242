#pragma once

// A Harpoon device as a contestant, in each of the three forms of a batch.

#include <memory>
#include <vector>

#include "bench/contestant.hpp"
#include "bench/indexed_scene.hpp"
#include "harpoon/device.hpp"

namespace harpoon::bench {

/// How pairs are laid out in memory.
enum class Format : std::uint8_t { records, arrays, indexed };

/// "records", "arrays", "indexed". Static storage.
std::string_view to_string(Format format);
std::optional<Format> parse_format(std::string_view name);

/// A device under the name and the thread count it is shown with.
struct NamedDevice {
  std::string name;
  unsigned threads = 1;
  std::shared_ptr<Device> device;
};

/// Does the device do this?
bool supports(const Capabilities& capabilities, Format format, bool is_f64);

/// Pairs and room for their contacts, shared by all contestants of one precision so that none has
/// the better memory. One turn at a time uses it.
template <class Real>
struct PairMemory {
  std::vector<SpherePairOf<Real>> pairs;
  std::vector<ContactOf<Real>> contacts;

  explicit PairMemory(std::vector<SpherePairOf<Real>> from)
      : pairs(std::move(from)), contacts(pairs.size()) {}
};

/// The same as separate arrays.
template <class Real>
class ArrayMemory {
 public:
  explicit ArrayMemory(std::span<const SpherePairOf<Real>> from);
  /// Views of the first `count` pairs and their contacts.
  [[nodiscard]] PairArraysBatch<Real> batch(std::size_t count);

 private:
  static constexpr std::size_t kArrays = 8;
  std::vector<Real> in_[kArrays];
  std::vector<Real> out_[kArrays - 1];
  std::vector<typename ContactOf<Real>::FlowWord> flow_;
};

template <class Real>
std::unique_ptr<Contestant> make_records_contestant(const NamedDevice& device,
                                                    std::shared_ptr<PairMemory<Real>> memory);
template <class Real>
std::unique_ptr<Contestant> make_arrays_contestant(const NamedDevice& device,
                                                   std::shared_ptr<ArrayMemory<Real>> memory);
/// `scene` must outlive the result.
template <class Real>
std::unique_ptr<Contestant> make_indexed_contestant(const NamedDevice& device,
                                                    const IndexedScene& scene);

}  // namespace harpoon::bench
