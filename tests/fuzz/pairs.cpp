// The pair door under arbitrary input. The first bytes choose a format, a cpu device (every
// instruction set on one thread; the widest on an injected executor that runs tasks backwards),
// sizes, alignment and at most one misuse; the rest are the operands. Every contact must have the
// bits of the scalar `collide`, every misuse must give its documented error and leave the output as
// it was, and the inputs are never written.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "fuzz/input.hpp"
#include "harpoon/device.hpp"

namespace harpoon::fuzz {
namespace {

enum class Misuse : std::uint8_t {
  none,
  too_few_contacts,
  misaligned_input,
  misaligned_output,
  null_input,
  null_output,
  overlap,
  bad_index,
};

/// What the first six bytes of an input choose.
struct Choice {
  std::uint8_t format;
  std::uint8_t device;
  std::uint8_t misuse_byte;
  std::uint8_t slack;
  std::uint8_t offset;
  std::uint8_t repeat;

  /// Half of all inputs are well-formed.
  [[nodiscard]] Misuse misuse() const {
    return misuse_byte < 128 ? Misuse::none : static_cast<Misuse>(misuse_byte % 8);
  }
  /// Where in its allocation a buffer starts: aligned, but to no more than it must be.
  template <class Real>
  [[nodiscard]] std::size_t start(bool misaligned) const {
    return offset % 16 * sizeof(Real) + (misaligned ? 1 + offset % (sizeof(Real) - 1) : 0);
  }
};

Device& device_number(std::size_t number) {
  static const std::vector<std::unique_ptr<Device>> devices = [] {
    std::vector<std::unique_ptr<Device>> made;
    for (const std::string& set : cpu_instruction_sets()) {
      made.push_back(
          make_cpu_device({.threads = 1, .parallel_for = {}, .instruction_set = set}).value());
    }
    const auto backwards = [](std::size_t tasks, const std::function<void(std::size_t)>& body) {
      while (tasks-- > 0) body(tasks);
    };
    made.push_back(
        make_cpu_device({.threads = 7, .parallel_for = backwards, .instruction_set = {}}).value());
    return made;
  }();
  return *devices[number % devices.size()];
}

/// The same bits, or both NaN: the contract leaves sign and payload of a NaN open.
template <class Real>
bool same(Real a, Real b) {
  return std::memcmp(&a, &b, sizeof(Real)) == 0 || (a != a && b != b);
}

template <class A, class B>
bool same_geometry(const A& a, const B& b) {
  for (int i = 0; i < 3; ++i) {
    if (!same(a.pos[i], b.pos[i]) || !same(a.normal[i], b.normal[i])) return false;
  }
  return same(a.depth, b.depth);
}

/// The rest of the input as records, the whole list `repeat` times over.
template <class T>
std::vector<T> take_all(Bytes& bytes, std::size_t repeat) {
  std::vector<T> once((bytes.left() + sizeof(T) - 1) / sizeof(T));
  for (T& record : once) record = bytes.take<T>();
  std::vector<T> all;
  for (std::size_t i = 0; i < repeat; ++i) all.insert(all.end(), once.begin(), once.end());
  return all;
}

/// A refused batch of records or arrays.
void check_refusal(const Result<Outcome>& result, Misuse misuse, std::size_t pairs) {
  FUZZ_REQUIRE(!result.ok());
  FUZZ_REQUIRE(!result.error().message.empty());
  const bool capacity = misuse == Misuse::too_few_contacts;
  FUZZ_REQUIRE(result.error().code == (capacity ? Errc::capacity : Errc::invalid_argument));
  FUZZ_REQUIRE(result.error().needed == (capacity ? pairs : 0));
}

/// A completed batch of records or arrays; `contact_of(i)` reads its output.
template <class Real, class ContactOfIndex>
void check_completion(const Result<Outcome>& result, const std::vector<SpherePairOf<Real>>& pairs,
                      const ContactOfIndex& contact_of) {
  FUZZ_REQUIRE(result.ok());
  std::uint64_t hits = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const ContactOf<Real> expected = collide(pairs[i]);
    const ContactOf<Real> got = contact_of(i);
    FUZZ_REQUIRE(same_geometry(got, expected));
    FUZZ_REQUIRE(got.flow_word == expected.flow_word);
    hits += expected.hit() ? 1 : 0;
  }
  FUZZ_REQUIRE(result->pairs == pairs.size());
  FUZZ_REQUIRE(result->hits == hits);
}

template <class Real>
void fuzz_records(Bytes bytes, const Choice& choice) {
  using Pair = SpherePairOf<Real>;
  const auto pairs = take_all<Pair>(bytes, 1 + choice.repeat % 64);
  Misuse misuse = choice.misuse();
  if (pairs.empty() || misuse == Misuse::bad_index) misuse = Misuse::none;

  const bool too_few = misuse == Misuse::too_few_contacts;
  const std::size_t room = too_few ? choice.slack % pairs.size() : pairs.size() + choice.slack % 3;
  Buffer<Pair> in(pairs.size(), choice.start<Real>(misuse == Misuse::misaligned_input));
  Buffer<ContactOf<Real>> out(room, choice.start<Real>(misuse == Misuse::misaligned_output));
  for (std::size_t i = 0; i < pairs.size(); ++i) in.set(i, pairs[i]);

  const Pair* from = misuse == Misuse::null_input ? nullptr : in.data();
  ContactOf<Real>* to = misuse == Misuse::null_output ? nullptr : out.data();
  if (misuse == Misuse::overlap) {
    const std::size_t numbers = choice.slack % (pairs.size() * sizeof(Pair) / sizeof(Real));
    to = reinterpret_cast<ContactOf<Real>*>(reinterpret_cast<Real*>(in.data()) + numbers);
  }
  const auto result =
      device_number(choice.device).run(PairBatch<Real>{{from, pairs.size()}, {to, room}});

  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Pair now = in.get(i);
    FUZZ_REQUIRE(std::memcmp(&now, &pairs[i], sizeof(Pair)) == 0);
  }
  if (misuse != Misuse::none) {
    check_refusal(result, misuse, pairs.size());
    FUZZ_REQUIRE(out.untouched_from(0));
  } else {
    check_completion<Real>(result, pairs, [&](std::size_t i) { return out.get(i); });
    FUZZ_REQUIRE(out.untouched_from(pairs.size()));
  }
}

/// The eight inputs and eight outputs of an array batch.
template <class Real>
struct Arrays {
  using Word = typename ContactOf<Real>::FlowWord;

  Arrays(const std::vector<SpherePairOf<Real>>& pairs, std::size_t room, const Choice& choice,
         Misuse misuse)
      : flow(room, choice.start<Real>(false)) {
    for (std::size_t k = 0; k < 8; ++k) {
      // Only one of the inputs is misaligned: any of them must be noticed.
      const bool bad = k == choice.slack % 8;
      in.emplace_back(pairs.size(), choice.start<Real>(bad && misuse == Misuse::misaligned_input));
      if (k < 7) {
        const bool bad_out = k == choice.slack % 7;
        out.emplace_back(room, choice.start<Real>(bad_out && misuse == Misuse::misaligned_output));
      }
    }
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const auto& [a, b] = pairs[i];
      const std::array<Real, 8> numbers{a.x, a.y, a.z, a.r, b.x, b.y, b.z, b.r};
      for (std::size_t k = 0; k < 8; ++k) in[k].set(i, numbers[k]);
    }
  }

  PairArraysBatch<Real> batch(const Choice& choice, Misuse misuse) {
    std::array<Real*, 8> i{};
    std::array<Real*, 7> o{};
    for (std::size_t k = 0; k < 8; ++k) i[k] = in[k].data();
    for (std::size_t k = 0; k < 7; ++k) o[k] = out[k].data();
    if (misuse == Misuse::null_input) i[choice.slack % 8] = nullptr;
    if (misuse == Misuse::null_output) o[choice.slack % 7] = nullptr;
    if (misuse == Misuse::overlap) o[choice.slack % 7] = i[choice.offset % 8];
    return {{i[0], i[1], i[2], i[3], i[4], i[5], i[6], i[7], in[0].size()},
            {o[0], o[1], o[2], o[3], o[4], o[5], o[6], flow.data(), flow.size()}};
  }

  [[nodiscard]] ContactOf<Real> contact(std::size_t i) const {
    return {{out[0].get(i), out[1].get(i), out[2].get(i)},
            {out[3].get(i), out[4].get(i), out[5].get(i)},
            out[6].get(i),
            flow.get(i)};
  }

  [[nodiscard]] bool untouched_from(std::size_t first) const {
    return flow.untouched_from(first) &&
           std::all_of(out.begin(), out.end(),
                       [&](const Buffer<Real>& b) { return b.untouched_from(first); });
  }

  std::vector<Buffer<Real>> in;
  std::vector<Buffer<Real>> out;
  Buffer<Word> flow;
};

template <class Real>
void fuzz_arrays(Bytes bytes, const Choice& choice) {
  const auto pairs = take_all<SpherePairOf<Real>>(bytes, 1 + choice.repeat % 64);
  Misuse misuse = choice.misuse();
  if (pairs.empty() || misuse == Misuse::bad_index) misuse = Misuse::none;
  const bool too_few = misuse == Misuse::too_few_contacts;
  const std::size_t room = too_few ? choice.slack % pairs.size() : pairs.size() + choice.slack % 3;

  Arrays<Real> arrays(pairs, room, choice, misuse);
  const auto result = device_number(choice.device).run(arrays.batch(choice, misuse));
  if (misuse != Misuse::none) {
    check_refusal(result, misuse, pairs.size());
    FUZZ_REQUIRE(arrays.untouched_from(0));
  } else {
    check_completion<Real>(result, pairs, [&](std::size_t i) { return arrays.contact(i); });
    FUZZ_REQUIRE(arrays.untouched_from(pairs.size()));
  }
}

/// The contacts that an indexed batch must find, in pair order.
template <class Real>
std::vector<BodyContactOf<Real>> expected_hits(const std::vector<SphereOf<Real>>& spheres,
                                               const std::vector<IndexPair>& pairs) {
  std::vector<BodyContactOf<Real>> hits;
  for (const auto& [g1, g2] : pairs) {
    const ContactOf<Real> c = collide(SpherePairOf<Real>{spheres[g1], spheres[g2]});
    if (!c.hit()) continue;
    hits.push_back(
        {{c.pos[0], c.pos[1], c.pos[2]}, {c.normal[0], c.normal[1], c.normal[2]}, c.depth, g1, g2});
  }
  return hits;
}

template <class Real>
void check_indexed(const Result<Outcome>& result, const std::vector<BodyContactOf<Real>>& expected,
                   const Buffer<BodyContactOf<Real>>& out, std::size_t pairs) {
  const std::size_t written = std::min(expected.size(), out.size());
  if (expected.size() > out.size()) {
    FUZZ_REQUIRE(!result.ok());
    FUZZ_REQUIRE(result.error().code == Errc::capacity);
    FUZZ_REQUIRE(result.error().needed == expected.size());
  } else {
    FUZZ_REQUIRE(result.ok());
    FUZZ_REQUIRE(result->pairs == pairs);
    FUZZ_REQUIRE(result->hits == expected.size());
  }
  for (std::size_t i = 0; i < written; ++i) {
    const BodyContactOf<Real> got = out.get(i);
    FUZZ_REQUIRE(got.g1 == expected[i].g1 && got.g2 == expected[i].g2);
    FUZZ_REQUIRE(same_geometry(got, expected[i]));
  }
}

template <class Real>
void fuzz_indexed(Bytes bytes, const Choice& choice) {
  std::vector<SphereOf<Real>> spheres(1 + bytes.take<std::uint8_t>() % 64);
  for (auto& sphere : spheres) sphere = bytes.take<SphereOf<Real>>();
  auto pairs = take_all<IndexPair>(bytes, 1 + choice.repeat % 64);
  Misuse misuse = choice.misuse();
  if (pairs.empty() || misuse == Misuse::too_few_contacts) misuse = Misuse::none;
  const auto limit = static_cast<std::uint32_t>(spheres.size());
  for (auto& [g1, g2] : pairs) g1 %= limit, g2 %= limit;
  const auto expected = expected_hits(spheres, pairs);
  if (misuse == Misuse::bad_index) pairs[choice.offset % pairs.size()].g2 = limit + choice.slack;

  Buffer<SphereOf<Real>> bodies(spheres.size(),
                                choice.start<Real>(misuse == Misuse::misaligned_input));
  for (std::size_t i = 0; i < spheres.size(); ++i) bodies.set(i, spheres[i]);
  Buffer<IndexPair> in(pairs.size(), choice.offset % 16 * sizeof(std::uint32_t));
  for (std::size_t i = 0; i < pairs.size(); ++i) in.set(i, pairs[i]);
  // Room for half of the hits, for all but one, for all, or for all and more.
  std::size_t room = expected.size() + choice.slack % 4;
  if (choice.slack % 4 == 3) room = expected.size() / 2;
  if (misuse == Misuse::misaligned_output || misuse == Misuse::null_output) room = pairs.size();
  Buffer<BodyContactOf<Real>> out(room, choice.start<Real>(misuse == Misuse::misaligned_output));

  IndexedBatch<Real> batch{{bodies.data(), bodies.size()}, {in.data(), in.size()}, {}};
  batch.contacts = {misuse == Misuse::null_output ? nullptr : out.data(), room};
  if (misuse == Misuse::null_input) batch.pairs = {static_cast<IndexPair*>(nullptr), in.size()};
  if (misuse == Misuse::overlap) {
    batch.contacts = {reinterpret_cast<BodyContactOf<Real>*>(bodies.data()), 1};
  }
  const auto result = device_number(choice.device).run(batch);

  if (misuse == Misuse::none) {
    check_indexed(result, expected, out, pairs.size());
    return;
  }
  FUZZ_REQUIRE(!result.ok());
  FUZZ_REQUIRE(result.error().code ==
               (misuse == Misuse::bad_index ? Errc::invalid_index : Errc::invalid_argument));
  FUZZ_REQUIRE(out.untouched_from(0));
}

void fuzz_pairs(Bytes bytes) {
  const auto choice = bytes.take<Choice>();
  switch (choice.format % 6) {
    case 0:
      return fuzz_records<float>(bytes, choice);
    case 1:
      return fuzz_records<double>(bytes, choice);
    case 2:
      return fuzz_arrays<float>(bytes, choice);
    case 3:
      return fuzz_arrays<double>(bytes, choice);
    case 4:
      return fuzz_indexed<float>(bytes, choice);
    default:
      return fuzz_indexed<double>(bytes, choice);
  }
}

}  // namespace
}  // namespace harpoon::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  harpoon::fuzz::fuzz_pairs({data, size});
  return 0;
}
