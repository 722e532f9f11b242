// The indexed form: one array of spheres, candidate pairs by index, only the hits come back. Shows
// how to ask for more room when the output was too small.

#include <harpoon/harpoon.hpp>

#include <cstdio>
#include <vector>

int main() {
  auto opened = harpoon::open_device("cpu");
  if (!opened) {
    std::fprintf(stderr, "%s\n", opened.error().message.c_str());
    return 1;
  }
  harpoon::Device& device = **opened;

  // A chain of spheres, each overlapping its neighbours; every pair is a candidate.
  std::vector<harpoon::SphereF64> spheres;
  for (int i = 0; i < 8; ++i) spheres.push_back({1.5 * i, 0, 0, 1});
  std::vector<harpoon::IndexPair> candidates;
  for (std::uint32_t g2 = 0; g2 < spheres.size(); ++g2) {
    for (std::uint32_t g1 = 0; g1 < g2; ++g1) candidates.push_back({g1, g2});
  }

  std::vector<harpoon::BodyContactF64> contacts(2);
  harpoon::IndexedBatch<double> batch{spheres, candidates, contacts};
  auto outcome = device.run(batch);
  if (!outcome && outcome.error().code == harpoon::Errc::capacity) {
    std::printf("%zu records are too few, %llu are needed\n", contacts.size(),
                static_cast<unsigned long long>(outcome.error().needed));
    contacts.resize(outcome.error().needed);
    batch.contacts = contacts;
    outcome = device.run(batch);
  }
  if (!outcome) {
    std::fprintf(stderr, "%s\n", outcome.error().message.c_str());
    return 1;
  }

  for (std::uint64_t i = 0; i < outcome->hits; ++i) {
    const harpoon::BodyContactF64& contact = contacts[i];
    std::printf("bodies %u and %u touch at x = %.2f, depth %.2f\n", contact.g1, contact.g2,
                contact.pos[0], contact.depth);
  }
}
