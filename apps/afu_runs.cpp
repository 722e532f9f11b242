#include "apps/afu_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <random>

#include "apps/exit_code.hpp"
#include "bench/timer.hpp"

namespace harpoon::app {
namespace {

using afu::contract::Format;

constexpr std::size_t kFewestSpheres = 16;
constexpr std::size_t kPairsPerSphere = 64;

AfuWorkload workload_of(const AfuRunsPlan& plan, std::size_t pairs, unsigned hit_percent) {
  const std::size_t spheres =
      std::clamp<std::size_t>(pairs / kPairsPerSphere, kFewestSpheres, kMostAfuSpheres);
  return make_afu_workload(spheres, pairs, hit_percent, plan.seed);
}

// As bits: equal contacts are equal to the last one.
template <class ContactType>
std::string difference(std::size_t index, const ContactType& got, const ContactType& expected) {
  using Words = std::array<std::uint32_t, sizeof(ContactType) / sizeof(std::uint32_t)>;
  return std::bit_cast<Words>(got) == std::bit_cast<Words>(expected)
             ? ""
             : fmt::format("result {} differs from the scalar collider's", index);
}

AfuRun finish(const std::string& name, const afu::AfuDevice& device, double begin_ns) {
  return {name, device.last_run(), bench::now_ns() - begin_ns, ""};
}

AfuRun run_records(const std::string& name, afu::AfuDevice& device, const AfuWorkload& workload) {
  std::vector<SpherePair> pairs;
  pairs.reserve(workload.pairs.size());
  for (const IndexPair& pair : workload.pairs) {
    pairs.push_back({workload.spheres[pair.g1], workload.spheres[pair.g2]});
  }
  std::vector<Contact> contacts(pairs.size());
  const double begin_ns = bench::now_ns();
  value_or_throw(device.run(PairBatch<float>{pairs, contacts}));
  AfuRun run = finish(name, device, begin_ns);
  for (std::size_t i = 0; i < pairs.size() && run.mismatch.empty(); ++i) {
    run.mismatch = difference(i, contacts[i], collide(pairs[i]));
  }
  return run;
}

std::vector<BodyContact> expected_hits(const AfuWorkload& workload) {
  std::vector<BodyContact> hits;
  for (const IndexPair& pair : workload.pairs) {
    const Contact c = collide(SpherePair{workload.spheres[pair.g1], workload.spheres[pair.g2]});
    if (c.hit()) {
      hits.push_back({{c.pos[0], c.pos[1], c.pos[2]},
                      {c.normal[0], c.normal[1], c.normal[2]},
                      c.depth,
                      pair.g1,
                      pair.g2});
    }
  }
  return hits;
}

AfuRun run_indexed(const std::string& name, afu::AfuDevice& device, const AfuWorkload& workload) {
  const std::vector<BodyContact> expected = expected_hits(workload);
  std::vector<BodyContact> contacts(workload.pairs.size());
  const double begin_ns = bench::now_ns();
  const Outcome outcome =
      value_or_throw(device.run(IndexedBatch<float>{workload.spheres, workload.pairs, contacts}));
  AfuRun run = finish(name, device, begin_ns);
  if (outcome.hits != expected.size()) {
    run.mismatch =
        fmt::format("{} hits, the scalar collider finds {}", outcome.hits, expected.size());
  }
  for (std::size_t i = 0; i < expected.size() && run.mismatch.empty(); ++i) {
    run.mismatch = difference(i, contacts[i], expected[i]);
  }
  return run;
}

}  // namespace

AfuWorkload make_afu_workload(std::size_t spheres, std::size_t pairs, unsigned hit_percent,
                              std::uint64_t seed) {
  std::mt19937_64 random(seed);
  AfuWorkload workload;
  for (std::size_t i = 0; i < spheres; ++i) {
    const std::size_t couple = i / 2;
    const auto place = static_cast<float>(couple);
    workload.spheres.push_back({4 * place + 0.25F * static_cast<float>(i % 2), place, 0, 0.5F});
  }
  const std::size_t couples = spheres / 2;
  for (std::size_t i = 0; i < pairs; ++i) {
    const auto first = static_cast<std::uint32_t>(random() % (2 * couples));
    const std::size_t away = 1 + random() % (couples - 1);
    const auto stranger = static_cast<std::uint32_t>((first + 2 * away) % (2 * couples));
    workload.pairs.push_back({first, random() % 100 < hit_percent ? first ^ 1U : stranger});
  }
  return workload;
}

std::vector<AfuRun> run_afu(const AfuRunsPlan& plan) {
  const AfuWorkload none = workload_of(plan, 0, 0);
  const AfuWorkload direct = workload_of(plan, plan.pairs, plan.direct_hit_percent);
  const AfuWorkload indexed = workload_of(plan, plan.pairs, plan.indexed_hit_percent);
  const AfuWorkload published =
      workload_of(plan, std::min(plan.pairs, kMostPublishedPairs), plan.direct_hit_percent);
  AfuSettings settings;
  settings.profile = plan.profile;
  AfuSettings traced = settings;
  traced.waveform = plan.waveform;
  AfuSettings hits_only = settings;
  hits_only.options.hits_only = true;
  AfuSettings as_published = settings;
  as_published.options.puc = kPublishedBehaviour;

  struct Step {
    const char* name;
    const AfuSettings& settings;
    const AfuWorkload& workload;
    bool is_indexed;
  };
  const Step steps[] = {{"empty batch", settings, none, false},
                        {"direct", traced, direct, false},
                        {"direct, hits only", hits_only, direct, false},
                        {"indexed, hits only", settings, indexed, true},
                        {"direct, as published", as_published, published, false}};
  std::vector<AfuRun> runs;
  for (const Step& step : steps) {
    const std::unique_ptr<afu::AfuDevice> device = value_or_throw(open_afu(step.settings));
    runs.push_back(step.is_indexed ? run_indexed(step.name, *device, step.workload)
                                   : run_records(step.name, *device, step.workload));
  }
  return runs;
}

std::string_view format_name(Format format) {
  switch (format) {
    case Format::direct:
      return "direct";
    case Format::direct_hits:
      return "direct_hits";
    case Format::indexed_hits:
      return "indexed_hits";
  }
  return "unknown";
}

}  // namespace harpoon::app
