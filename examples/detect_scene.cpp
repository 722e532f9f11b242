// The scene: bodies in, all contacts out, nobody names candidates. Shows a persistent scene over
// some frames, and the bounds of other shapes with a plane among them.

#include <harpoon/harpoon.hpp>

#include <cstdio>
#include <limits>
#include <vector>

namespace {

/// Two rows of spheres fall onto each other: 0.6 a frame.
bool fall() {
  std::vector<harpoon::SphereF64> spheres;
  for (int i = 0; i < 5; ++i) {
    spheres.push_back({2.5 * i, 0, 0, 1});
    spheres.push_back({2.5 * i, 0, 3, 1});
  }
  auto scene = harpoon::SceneF64::make();
  if (!scene) return false;
  for (int frame = 0; frame < 4; ++frame) {
    if (scene->set_bodies(std::span<const harpoon::SphereF64>(spheres))) return false;
    const auto found = scene->detect();
    if (!found) return false;
    std::printf("frame %d: %zu contacts", frame, found->contacts.size());
    if (!found->contacts.empty()) std::printf(", depth %.1f", found->contacts[0].depth);
    std::printf("\n");
    for (std::size_t upper = 1; upper < spheres.size(); upper += 2) spheres[upper].z -= 0.6;
  }
  return true;
}

/// Candidates for colliders of your own: a box each for a crate, a ramp and the ground's
/// half-space.
bool bound() {
  const double infinity = std::numeric_limits<double>::infinity();
  // min x, max x, min y, max y, min z, max z
  const double boxes[3][6] = {{0, 1, 0, 1, 0.5, 1.5},
                              {0.5, 4, 0, 2, 0, 2},
                              {-infinity, infinity, -infinity, infinity, -infinity, 0}};
  auto workspace = harpoon::Workspace::make();
  if (!workspace) return false;
  harpoon::IndexPair pairs[3];
  const auto report =
      harpoon::overlap_pairs(*workspace, harpoon::BoundsF64(boxes[0], 3), std::span(pairs));
  if (!report) return false;
  for (std::uint64_t i = 0; i < report->contacts; ++i) {
    std::printf("boxes %u and %u overlap\n", pairs[i].g1, pairs[i].g2);
  }
  return true;
}

}  // namespace

int main() {
  return fall() && bound() ? 0 : 1;
}
