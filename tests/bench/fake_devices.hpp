#pragma once

// Devices for tests: a right one that is plain Algorithm 1, and ones that are wrong in one way.

#include <functional>
#include <variant>

#include "bench/algorithm1.hpp"
#include "harpoon/device.hpp"

namespace harpoon::bench {

/// Answers records, arrays and indexed batches by Algorithm 1, and lets `spoil` change each contact
/// before it is written; `spoil` gets the index of the pair in its batch.
class PlainDevice : public Device {
 public:
  struct Spoiler {
    std::function<void(std::size_t, Contact&)> f32 = [](std::size_t, Contact&) {};
    std::function<void(std::size_t, ContactF64&)> f64 = [](std::size_t, ContactF64&) {};
  };

  PlainDevice() : PlainDevice(Spoiler{}) {}
  explicit PlainDevice(Spoiler spoil) : spoil_(std::move(spoil)) {
    capabilities_.description = "plain Algorithm 1";
    capabilities_.f32 = capabilities_.f64 = true;
    capabilities_.pair_batches = capabilities_.array_batches = true;
    capabilities_.indexed_batches = true;
  }

  [[nodiscard]] std::string_view name() const noexcept override { return "plain"; }
  [[nodiscard]] const Capabilities& capabilities() const noexcept override { return capabilities_; }
  [[nodiscard]] Transaction submit(const Batch& batch) noexcept override {
    Outcome outcome = std::visit([this](const auto& b) { return answer(b); }, batch);
    if (capabilities_.modelled) {
      outcome.modelled_ns = 5.0 * static_cast<double>(outcome.pairs);
    }
    return Transaction(Result<Outcome>(outcome));
  }

  Capabilities capabilities_;

 private:
  void spoil(std::size_t i, Contact& contact) const { spoil_.f32(i, contact); }
  void spoil(std::size_t i, ContactF64& contact) const { spoil_.f64(i, contact); }

  template <class Real>
  ContactOf<Real> contact_of(std::size_t i, const SpherePairOf<Real>& pair) const {
    ContactOf<Real> contact = algorithm1(pair);
    spoil(i, contact);
    return contact;
  }

  template <class Real>
  Outcome answer(const PairBatch<Real>& batch) const {
    Outcome outcome;
    for (; outcome.pairs < batch.pairs.size(); ++outcome.pairs) {
      batch.contacts[outcome.pairs] = contact_of(outcome.pairs, batch.pairs[outcome.pairs]);
      outcome.hits += batch.contacts[outcome.pairs].hit() ? 1U : 0U;
    }
    return outcome;
  }

  template <class Real>
  Outcome answer(const PairArraysBatch<Real>& batch) const {
    const SpherePairArraysOf<Real>& p = batch.pairs;
    const ContactArraysOf<Real>& out = batch.contacts;
    Outcome outcome;
    for (std::size_t i = 0; i < p.count; ++i) {
      const auto c = contact_of(i, SpherePairOf<Real>{{p.x1[i], p.y1[i], p.z1[i], p.r1[i]},
                                                      {p.x2[i], p.y2[i], p.z2[i], p.r2[i]}});
      out.pos_x[i] = c.pos[0];
      out.pos_y[i] = c.pos[1];
      out.pos_z[i] = c.pos[2];
      out.normal_x[i] = c.normal[0];
      out.normal_y[i] = c.normal[1];
      out.normal_z[i] = c.normal[2];
      out.depth[i] = c.depth;
      out.flow[i] = c.flow_word;
      outcome.hits += c.hit() ? 1U : 0U;
    }
    outcome.pairs = p.count;
    return outcome;
  }

  template <class Real>
  Outcome answer(const IndexedBatch<Real>& batch) const {
    Outcome outcome;
    for (const IndexPair& pair : batch.pairs) {
      const auto c = contact_of(outcome.pairs++,
                                SpherePairOf<Real>{batch.spheres[pair.g1], batch.spheres[pair.g2]});
      if (c.hit()) {
        batch.contacts[outcome.hits++] = {{c.pos[0], c.pos[1], c.pos[2]},
                                          {c.normal[0], c.normal[1], c.normal[2]},
                                          c.depth,
                                          pair.g1,
                                          pair.g2};
      }
    }
    return outcome;
  }

  Spoiler spoil_;
};

}  // namespace harpoon::bench
