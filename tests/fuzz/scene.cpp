// detect on arbitrary bodies against the collider on all pairs, and overlap_pairs on arbitrary
// boxes against all comparisons; the output ends where it says.

#include <array>
#include <utility>
#include <vector>

#include "fuzz/input.hpp"
#include "harpoon/scene.hpp"
#include "scene/brute_force.hpp"

namespace {

using namespace harpoon;

template <class Real>
void run(fuzz::Bytes& in) {
  const auto scale = static_cast<Real>(in.take<std::int8_t>());
  const bool raw = in.take<std::uint8_t>() % 2 == 0;
  std::vector<SphereOf<Real>> spheres;
  while (in.left() > 0 && spheres.size() < 120) {
    const auto number = [&] {
      return raw ? in.take<Real>() : scale * static_cast<Real>(in.take<std::int16_t>()) / 256;
    };
    spheres.push_back({number(), number(), number(), number()});
  }
  fuzz::Buffer<SphereOf<Real>> exact(spheres.size(), 0);
  for (std::size_t i = 0; i < spheres.size(); ++i) exact.set(i, spheres[i]);
  const BodiesOf<Real> bodies{std::span<const SphereOf<Real>>(exact.data(), spheres.size())};
  const auto expected = testing::brute_force<Real>(spheres);
  std::vector<BodyContactOf<Real>> out(expected.size());
  const auto report = detect(bodies, std::span(out), ContactOrder::ids, {.threads = 1});
  FUZZ_REQUIRE(report.ok());
  FUZZ_REQUIRE(testing::same_bits(out, expected));
}

template <class Real>
void run_boxes(fuzz::Bytes& in) {
  const auto scale = static_cast<Real>(in.take<std::int8_t>());
  const bool raw = in.take<std::uint8_t>() % 2 == 0;
  const bool ordered = in.take<std::uint8_t>() % 2 == 0;
  std::vector<std::array<Real, 6>> boxes;
  while (in.left() > 0 && boxes.size() < 300) {
    std::array<Real, 6> box;
    for (Real& v : box) {
      v = raw ? in.take<Real>() : scale * static_cast<Real>(in.take<std::int16_t>()) / 256;
    }
    for (std::size_t k = 0; ordered && k < 6; k += 2) {
      if (box[k] > box[k + 1]) std::swap(box[k], box[k + 1]);
    }
    boxes.push_back(box);
  }
  const auto expected = testing::overlapping(boxes);
  std::vector<IndexPair> out(expected.size());
  auto workspace = Workspace::make({.threads = 1});
  FUZZ_REQUIRE(workspace.ok());
  const BoundsOf<Real> bounds(boxes.empty() ? nullptr : boxes[0].data(), boxes.size());
  const auto report = overlap_pairs(*workspace, bounds, std::span(out), ContactOrder::ids);
  FUZZ_REQUIRE(report.ok());
  FUZZ_REQUIRE(report->contacts == expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) {
    FUZZ_REQUIRE(out[k].g1 == expected[k].g1 && out[k].g2 == expected[k].g2);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes in(data, size);
  switch (in.take<std::uint8_t>() % 4) {
    case 0:
      run<float>(in);
      break;
    case 1:
      run<double>(in);
      break;
    case 2:
      run_boxes<float>(in);
      break;
    default:
      run_boxes<double>(in);
      break;
  }
  return 0;
}
