#include "bench/selftest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>

#include "bench/algorithm1.hpp"
#include "bench/pair_cases.hpp"

namespace harpoon::bench {
namespace {

constexpr const char* kAlgorithm1 = "Algorithm 1";

template <class Real>
constexpr const char* kPrecision = sizeof(Real) == 4 ? "f32" : "f64";

template <class Real>
bool same_number(Real a, Real b) {
  using Bits = std::conditional_t<sizeof(Real) == 4, std::uint32_t, std::uint64_t>;
  return (std::isnan(a) && std::isnan(b)) || std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b);
}

template <class Contact>
bool same_geometry(const Contact& a, const Contact& b) {
  for (int i = 0; i < 3; ++i) {
    if (!same_number(a.pos[i], b.pos[i]) || !same_number(a.normal[i], b.normal[i])) {
      return false;
    }
  }
  return same_number(a.depth, b.depth);
}

template <class Real>
std::string describe(const SphereOf<Real>& s) {
  return fmt::format("({}, {}, {}; r {})", s.x, s.y, s.z, s.r);
}

template <class Real>
std::string describe(const ContactOf<Real>& c) {
  return fmt::format("flow {} pos ({}, {}, {}) normal ({}, {}, {}) depth {}", c.flow_word, c.pos[0],
                     c.pos[1], c.pos[2], c.normal[0], c.normal[1], c.normal[2], c.depth);
}

// A record of words that no device writes: a pair that a device skips is then a mismatch.
template <class Real>
ContactOf<Real> untouched() {
  ContactOf<Real> contact{};
  contact.depth = Real(-12345);
  contact.flow_word = 0xDEAD;
  return contact;
}

// Pairs and the contacts that an oracle gives for them.
template <class Real>
struct Expected {
  std::string oracle;
  std::vector<SpherePairOf<Real>> pairs;
  std::vector<ContactOf<Real>> contacts;
};

// Contacts of all pairs from one device in one form; an error leaves the rest untouched.
template <class Real>
using RunForm = Result<std::vector<ContactOf<Real>>> (*)(Device&,
                                                         const std::vector<SpherePairOf<Real>>&);

template <class Real>
Result<std::vector<ContactOf<Real>>> run_records(Device& device,
                                                 const std::vector<SpherePairOf<Real>>& pairs) {
  std::vector<ContactOf<Real>> contacts(pairs.size(), untouched<Real>());
  const std::span<const SpherePairOf<Real>> all(pairs);
  // Sizes 0, 1, 2, ... first: every tail of every vector length; then the rest in one batch.
  std::size_t done = 0;
  for (std::size_t size = 0; done + size <= std::min<std::size_t>(pairs.size() / 2, 4096); ++size) {
    const Result<Outcome> outcome = device.run(
        PairBatch<Real>{all.subspan(done, size), std::span(contacts).subspan(done, size)});
    if (!outcome) {
      return outcome.error();
    }
    done += size;
  }
  const Result<Outcome> outcome =
      device.run(PairBatch<Real>{all.subspan(done), std::span(contacts).subspan(done)});
  if (!outcome) {
    return outcome.error();
  }
  return contacts;
}

template <class Real>
Result<std::vector<ContactOf<Real>>> run_arrays(Device& device,
                                                const std::vector<SpherePairOf<Real>>& pairs) {
  ArrayMemory<Real> memory(pairs);
  const PairArraysBatch<Real> batch = memory.batch(pairs.size());
  const Result<Outcome> outcome = device.run(batch);
  if (!outcome) {
    return outcome.error();
  }
  std::vector<ContactOf<Real>> contacts;
  contacts.reserve(pairs.size());
  const ContactArraysOf<Real>& c = batch.contacts;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    contacts.push_back({{c.pos_x[i], c.pos_y[i], c.pos_z[i]},
                        {c.normal_x[i], c.normal_y[i], c.normal_z[i]},
                        c.depth[i],
                        c.flow[i]});
  }
  return contacts;
}

// The pairs as a sphere array, spheres 2i and 2i+1 the pair i, asked in a shuffled order. What the
// compact list of hits lacks comes back as Flow::fake; the flow of a hit is not in a BodyContact
// and is taken from the geometry.
template <class Real>
Result<std::vector<ContactOf<Real>>> run_indexed(Device& device,
                                                 const std::vector<SpherePairOf<Real>>& pairs) {
  using Word = typename ContactOf<Real>::FlowWord;
  std::vector<SphereOf<Real>> spheres;
  std::vector<IndexPair> indices;
  for (const SpherePairOf<Real>& pair : pairs) {
    const auto first = static_cast<std::uint32_t>(spheres.size());
    spheres.push_back(pair.s1);
    spheres.push_back(pair.s2);
    indices.push_back({first, first + 1});
  }
  std::mt19937_64 engine(7);
  std::shuffle(indices.begin(), indices.end(), engine);
  std::vector<BodyContactOf<Real>> hits(pairs.size());
  const Result<Outcome> outcome = device.run(IndexedBatch<Real>{spheres, indices, hits});
  if (!outcome) {
    return outcome.error();
  }
  std::vector<ContactOf<Real>> contacts(pairs.size());
  for (ContactOf<Real>& contact : contacts) {
    contact.flow_word = static_cast<Word>(Flow::fake);
  }
  std::size_t hit = 0;
  for (const IndexPair& index : indices) {
    const bool is_hit = hit < outcome->hits && hit < hits.size() && hits[hit].g1 == index.g1 &&
                        hits[hit].g2 == index.g2;
    if (is_hit) {
      const BodyContactOf<Real>& h = hits[hit++];
      const Word flow = algorithm1(pairs[index.g1 / 2]).flow_word;
      contacts[index.g1 / 2] = {
          {h.pos[0], h.pos[1], h.pos[2]}, {h.normal[0], h.normal[1], h.normal[2]}, h.depth, flow};
    }
  }
  if (hit != outcome->hits) {
    return Error{Errc::device_fault,
                 fmt::format("Of {} contacts only {} are in pair order.", outcome->hits, hit)};
  }
  return contacts;
}

template <class Real>
SelftestCheck compare(const NamedDevice& device, Format format, RunForm<Real> run,
                      const Expected<Real>& expected) {
  SelftestCheck check{device.name,
                      std::string(to_string(format)),
                      fmt::format("{} = {}", kPrecision<Real>, expected.oracle),
                      expected.pairs.size(),
                      0,
                      {}};
  const Result<std::vector<ContactOf<Real>>> got = run(*device.device, expected.pairs);
  if (!got) {
    check.first_mismatch = got.error().message;
    return check;
  }
  for (std::size_t i = 0; i < expected.pairs.size(); ++i) {
    if (same_bits((*got)[i], expected.contacts[i])) {
      continue;
    }
    if (check.mismatches++ == 0) {
      check.first_mismatch = fmt::format(
          "pair {} {} {}: got {}, expected {}", i, describe(expected.pairs[i].s1),
          describe(expected.pairs[i].s2), describe((*got)[i]), describe(expected.contacts[i]));
    }
  }
  return check;
}

template <class Real>
Expected<Real> expect_algorithm1(std::vector<SpherePairOf<Real>> pairs) {
  Expected<Real> expected{kAlgorithm1, std::move(pairs), {}};
  expected.contacts.reserve(expected.pairs.size());
  for (const SpherePairOf<Real>& pair : expected.pairs) {
    expected.contacts.push_back(algorithm1(pair));
  }
  return expected;
}

Expected<double> expect_oracle(const Oracle& oracle, std::uint64_t seed, std::size_t count) {
  Expected<double> expected{oracle.name, hard_pairs<double>(seed, count, true), {}};
  expected.contacts.reserve(count);
  for (const SpherePairF64& pair : expected.pairs) {
    expected.contacts.push_back(oracle.collide(pair));
  }
  return expected;
}

// The first `count` of a larger set of expectations.
template <class Real>
Expected<Real> shortened(Expected<Real> expected, std::size_t count) {
  expected.pairs.resize(std::min(count, expected.pairs.size()));
  expected.contacts.resize(expected.pairs.size());
  return expected;
}

class Selftest {
 public:
  Selftest(const SelftestPlan& plan, const OnCheck& on_check, const Interrupted& interrupted)
      : plan_(plan), on_check_(on_check), interrupted_(interrupted) {}

  template <class Real>
  void check_all(const Expected<Real>& expected) {
    const Expected<Real> few = shortened(expected, plan_.modelled_pairs);
    for (const NamedDevice& device : plan_.devices) {
      const Expected<Real>& used = device.device->capabilities().modelled ? few : expected;
      check(device, Format::records, &run_records<Real>, used);
      check(device, Format::arrays, &run_arrays<Real>, used);
      check(device, Format::indexed, &run_indexed<Real>, used);
    }
  }

  std::vector<SelftestCheck> take() { return std::move(checks_); }

 private:
  template <class Real>
  void check(const NamedDevice& device, Format format, RunForm<Real> run,
             const Expected<Real>& expected) {
    if (must_stop(interrupted_) ||
        !supports(device.device->capabilities(), format, sizeof(Real) == 8)) {
      return;
    }
    checks_.push_back(compare(device, format, run, expected));
    if (on_check_) {
      on_check_(checks_.back());
    }
  }

  const SelftestPlan& plan_;
  const OnCheck& on_check_;
  const Interrupted& interrupted_;
  std::vector<SelftestCheck> checks_;
};

}  // namespace

template <class Real>
bool same_bits(const ContactOf<Real>& a, const ContactOf<Real>& b) {
  return a.flow_word == b.flow_word && same_geometry(a, b);
}
template bool same_bits<float>(const Contact&, const Contact&);
template bool same_bits<double>(const ContactF64&, const ContactF64&);

template <class Real>
SelftestCheck check_records(const NamedDevice& device, std::vector<SpherePairOf<Real>> pairs) {
  return compare(device, Format::records, &run_records<Real>, expect_algorithm1(std::move(pairs)));
}
template SelftestCheck check_records<float>(const NamedDevice&, std::vector<SpherePair>);
template SelftestCheck check_records<double>(const NamedDevice&, std::vector<SpherePairF64>);

std::vector<SelftestCheck> run_selftest(const SelftestPlan& plan, const OnCheck& on_check,
                                        const Interrupted& interrupted) {
  Selftest selftest(plan, on_check, interrupted);
  selftest.check_all(expect_algorithm1(hard_pairs<float>(plan.seed, plan.pairs, false)));
  selftest.check_all(expect_algorithm1(hard_pairs<double>(plan.seed, plan.pairs, false)));
  for (const Oracle& oracle : plan.oracles) {
    selftest.check_all(expect_oracle(oracle, plan.seed, plan.pairs));
  }
  return selftest.take();
}

}  // namespace harpoon::bench
