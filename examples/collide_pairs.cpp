// The pair door: a batch of candidate pairs in, one contact record per pair out.

#include <harpoon/harpoon.hpp>

#include <cstdio>
#include <vector>

namespace {

const char* name_of(harpoon::Flow flow) {
  switch (flow) {
    case harpoon::Flow::fake:
      return "apart";
    case harpoon::Flow::grazing:
      return "same centre";
    case harpoon::Flow::real:
      return "touching";
  }
  return "not tested";
}

}  // namespace

int main() {
  auto opened = harpoon::open_device("cpu");
  if (!opened) {
    std::fprintf(stderr, "%s\n", opened.error().message.c_str());
    return 1;
  }
  harpoon::Device& device = **opened;

  // A row of unit spheres against one at the origin: overlapping less and less, then apart.
  std::vector<harpoon::SpherePair> pairs;
  for (int i = 0; i < 6; ++i) {
    const float distance = 0.5f * static_cast<float>(i);
    pairs.push_back({.s1 = {distance, 0, 0, 1}, .s2 = {0, 0, 0, 1}});
  }

  std::vector<harpoon::Contact> contacts(pairs.size());
  const auto outcome = device.run(harpoon::PairBatch<float>{pairs, contacts});
  if (!outcome) {
    std::fprintf(stderr, "%s\n", outcome.error().message.c_str());
    return 1;
  }

  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const harpoon::Contact& contact = contacts[i];
    std::printf("distance %.1f: %s", static_cast<double>(pairs[i].s1.x), name_of(contact.flow()));
    if (contact.hit()) {
      std::printf(", depth %.1f at x = %.2f", static_cast<double>(contact.depth),
                  static_cast<double>(contact.pos[0]));
    }
    std::printf("\n");
  }
  std::printf("%llu of %llu pairs touch\n", static_cast<unsigned long long>(outcome->hits),
              static_cast<unsigned long long>(outcome->pairs));
}
