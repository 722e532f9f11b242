#pragma once

// The circuits that Harpoon generates from its colliders, and the files they are written to.

#include <string>
#include <vector>

#include "hls/emit.hpp"

namespace harpoon::hls {

/// A collider recorded as a graph, with the names of its source.
struct Design {
  Description description;
  Graph graph;
};

Design design_sphere_sphere();
Design design_sphere_miss();
Design design_sphere_plane();
Design design_aabb_overlap();

/// A generated file: its name inside the folder of generated files, and its text.
struct GeneratedFile {
  std::string name;
  std::string text;
};

/// Every generated file.
std::vector<GeneratedFile> generated_files();

}  // namespace harpoon::hls
