#include "bench/device_contestant.hpp"

#include <array>
#include <utility>

#include "bench/timer.hpp"

namespace harpoon::bench {
namespace {

constexpr std::array<std::string_view, 3> kFormatNames = {"records", "arrays", "indexed"};

template <class Real>
constexpr const char* kPrecision = sizeof(Real) == 4 ? "f32" : "f64";

// Runs what `make_batch(count)` gives. A modelled device tells its own time, which does not vary,
// so one run is enough.
template <class MakeBatch>
class DeviceContestant final : public Contestant {
 public:
  DeviceContestant(Label label, std::shared_ptr<Device> device, MakeBatch make_batch)
      : label_(std::move(label)), device_(std::move(device)), make_batch_(std::move(make_batch)) {}

  [[nodiscard]] const Label& label() const override { return label_; }

  Result<Turn> take_turn(std::size_t count) override {
    const Batch batch = make_batch_(count);
    const double start_ns = now_ns();
    const Result<Outcome> warm_up = device_->run(batch);
    const double warm_up_ns = now_ns() - start_ns;
    if (!warm_up) {
      return warm_up.error();
    }
    if (warm_up->modelled_ns) {
      return Turn{{*warm_up->modelled_ns}, 1};
    }
    return take_samples(warm_up_ns, [&](std::uint64_t runs) { return time_runs(batch, runs); });
  }

 private:
  Result<double> time_runs(const Batch& batch, std::uint64_t runs) {
    const double start_ns = now_ns();
    for (std::uint64_t i = 0; i < runs; ++i) {
      if (const Result<Outcome> outcome = device_->run(batch); !outcome) {
        return outcome.error();
      }
    }
    return now_ns() - start_ns;
  }

  Label label_;
  std::shared_ptr<Device> device_;
  MakeBatch make_batch_;
};

template <class MakeBatch>
std::unique_ptr<Contestant> make_contestant(const NamedDevice& device, Format format,
                                            const char* precision, double bytes_per_pair,
                                            MakeBatch make_batch) {
  Label label{device.name,
              precision,
              device.threads,
              std::string(to_string(format)),
              device.device->capabilities().modelled,
              bytes_per_pair};
  return std::make_unique<DeviceContestant<MakeBatch>>(std::move(label), device.device,
                                                       std::move(make_batch));
}

}  // namespace

std::string_view to_string(Format format) {
  return kFormatNames[static_cast<std::size_t>(format)];
}

std::optional<Format> parse_format(std::string_view name) {
  for (std::size_t i = 0; i < kFormatNames.size(); ++i) {
    if (kFormatNames[i] == name) {
      return static_cast<Format>(i);
    }
  }
  return std::nullopt;
}

bool supports(const Capabilities& capabilities, Format format, bool is_f64) {
  if (!(is_f64 ? capabilities.f64 : capabilities.f32)) {
    return false;
  }
  switch (format) {
    case Format::records:
      return capabilities.pair_batches;
    case Format::arrays:
      return capabilities.array_batches;
    case Format::indexed:
      return capabilities.indexed_batches;
  }
  return false;
}

template <class Real>
ArrayMemory<Real>::ArrayMemory(std::span<const SpherePairOf<Real>> from) : flow_(from.size()) {
  for (std::vector<Real>& array : in_) {
    array.reserve(from.size());
  }
  for (std::vector<Real>& array : out_) {
    array.resize(from.size());
  }
  for (const SpherePairOf<Real>& pair : from) {
    const Real numbers[kArrays] = {pair.s1.x, pair.s1.y, pair.s1.z, pair.s1.r,
                                   pair.s2.x, pair.s2.y, pair.s2.z, pair.s2.r};
    for (std::size_t i = 0; i < kArrays; ++i) {
      in_[i].push_back(numbers[i]);
    }
  }
}

template <class Real>
PairArraysBatch<Real> ArrayMemory<Real>::batch(std::size_t count) {
  return {{in_[0].data(), in_[1].data(), in_[2].data(), in_[3].data(), in_[4].data(), in_[5].data(),
           in_[6].data(), in_[7].data(), count},
          {out_[0].data(), out_[1].data(), out_[2].data(), out_[3].data(), out_[4].data(),
           out_[5].data(), out_[6].data(), flow_.data(), count}};
}

template <class Real>
std::unique_ptr<Contestant> make_records_contestant(const NamedDevice& device,
                                                    std::shared_ptr<PairMemory<Real>> memory) {
  const double bytes = sizeof(SpherePairOf<Real>) + sizeof(ContactOf<Real>);
  return make_contestant(device, Format::records, kPrecision<Real>, bytes,
                         [memory = std::move(memory)](std::size_t count) -> Batch {
                           return PairBatch<Real>{
                               std::span(std::as_const(memory->pairs)).first(count),
                               std::span(memory->contacts).first(count)};
                         });
}

template <class Real>
std::unique_ptr<Contestant> make_arrays_contestant(const NamedDevice& device,
                                                   std::shared_ptr<ArrayMemory<Real>> memory) {
  const double bytes = sizeof(SpherePairOf<Real>) + sizeof(ContactOf<Real>);
  return make_contestant(
      device, Format::arrays, kPrecision<Real>, bytes,
      [memory = std::move(memory)](std::size_t count) -> Batch { return memory->batch(count); });
}

template <class Real>
std::unique_ptr<Contestant> make_indexed_contestant(const NamedDevice& device,
                                                    const IndexedScene& scene) {
  auto spheres = std::make_shared<std::vector<SphereOf<Real>>>(convert<Real>(scene.spheres));
  auto contacts = std::make_shared<std::vector<BodyContactOf<Real>>>(scene.pairs.size());
  const double bytes = sizeof(IndexPair) + scene.hit_share * sizeof(BodyContactOf<Real>);
  return make_contestant(
      device, Format::indexed, kPrecision<Real>, bytes,
      [&scene, spheres, contacts](std::size_t count) -> Batch {
        return IndexedBatch<Real>{*spheres, std::span(scene.pairs).first(count), *contacts};
      });
}

template class ArrayMemory<float>;
template class ArrayMemory<double>;
template std::unique_ptr<Contestant> make_records_contestant<float>(
    const NamedDevice&, std::shared_ptr<PairMemory<float>>);
template std::unique_ptr<Contestant> make_records_contestant<double>(
    const NamedDevice&, std::shared_ptr<PairMemory<double>>);
template std::unique_ptr<Contestant> make_arrays_contestant<float>(
    const NamedDevice&, std::shared_ptr<ArrayMemory<float>>);
template std::unique_ptr<Contestant> make_arrays_contestant<double>(
    const NamedDevice&, std::shared_ptr<ArrayMemory<double>>);
template std::unique_ptr<Contestant> make_indexed_contestant<float>(const NamedDevice&,
                                                                    const IndexedScene&);
template std::unique_ptr<Contestant> make_indexed_contestant<double>(const NamedDevice&,
                                                                     const IndexedScene&);

}  // namespace harpoon::bench
