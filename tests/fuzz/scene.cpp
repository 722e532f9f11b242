// detect on arbitrary bodies against the collider on all pairs; the output ends where it says.

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

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes in(data, size);
  if (in.take<std::uint8_t>() % 2 == 0) {
    run<float>(in);
  } else {
    run<double>(in);
  }
  return 0;
}
