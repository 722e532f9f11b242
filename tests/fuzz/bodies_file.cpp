// The readers of `harpoon detect` on arbitrary text: bodies or an error within the text.

#include "apps/detect/bodies_file.hpp"

#include <algorithm>

#include "fuzz/input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace harpoon;
  fuzz::Bytes in(data, size);
  const bool json = in.take<std::uint8_t>() % 2 == 0;
  fuzz::Buffer<char> exact(in.left(), 0);
  for (std::size_t i = 0; i < exact.size(); ++i) exact.set(i, in.take<char>());
  const std::string_view text(exact.data(), exact.size());
  const app::BodiesOrError read = json ? app::read_bodies_json(text) : app::read_bodies_csv(text);
  if (const auto* error = std::get_if<app::TextError>(&read)) {
    const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1;
    FUZZ_REQUIRE(error->line >= 1 && error->line <= lines);
    FUZZ_REQUIRE(error->column >= 1 && error->column <= text.size() + 1);
    FUZZ_REQUIRE(!error->reason.empty());
  } else {
    const auto& bodies = std::get<app::FileBodies>(read);
    FUZZ_REQUIRE(bodies.group.size() == bodies.mask.size());
    FUZZ_REQUIRE(bodies.group.empty() || bodies.group.size() == bodies.spheres.size());
  }
  return 0;
}
