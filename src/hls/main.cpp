// harpoon-hls: writes the SystemVerilog that is generated from the C++ colliders, or checks that
// what is there is what it would write.
//
//   harpoon-hls DIR          write every generated file into DIR
//   harpoon-hls --check DIR  compare instead; names each stale or stray file and fails

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include "hls/designs.hpp"

namespace {

namespace fs = std::filesystem;
using harpoon::hls::GeneratedFile;

std::string content(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

int write(const std::vector<GeneratedFile>& files, const fs::path& directory) {
  fs::create_directories(directory);
  for (const GeneratedFile& file : files) {
    std::ofstream out(directory / file.name, std::ios::binary);
    out << file.text;
    if (!out.flush()) {
      fmt::print(stderr, "harpoon-hls: cannot write {}\n", (directory / file.name).string());
      return 1;
    }
  }
  return 0;
}

int check(const std::vector<GeneratedFile>& files, const fs::path& directory) {
  int stale = 0;
  std::set<fs::path> known;
  for (const GeneratedFile& file : files) {
    known.insert(file.name);
    if (content(directory / file.name) == file.text) continue;
    fmt::print(stderr, "stale: {}\n", (directory / file.name).string());
    ++stale;
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(directory)) {
    if (known.contains(entry.path().filename())) continue;
    fmt::print(stderr, "not generated: {}\n", entry.path().string());
    ++stale;
  }
  return stale == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  const bool checking = argc == 3 && std::string(argv[1]) == "--check";
  if (argc != 2 && !checking) {
    fmt::print(stderr, "usage: harpoon-hls [--check] DIR\n");
    return 2;
  }
  const std::vector<GeneratedFile> files = harpoon::hls::generated_files();
  return checking ? check(files, argv[2]) : write(files, argv[1]);
}
