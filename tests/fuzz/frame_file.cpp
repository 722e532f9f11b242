// The reader of recorded collisions on arbitrary text: a frame whose pairs can be searched, or an
// error.

#include "ode/frame_file.hpp"

#include "fuzz/input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace harpoon;
  fuzz::Bytes in(data, size);
  // Mutations seldom find the title by themselves.
  const bool titled = in.take<std::uint8_t>() % 2 == 0;
  std::string text = titled ? "harpoon-ode-frame 1\n" : "";
  while (in.left() > 0) text += in.take<char>();
  const Result<ode::CollisionFrame> frame = ode::parse_frame(text);
  if (!frame) {
    FUZZ_REQUIRE(!frame.error().message.empty());
    return 0;
  }
  const Result<ode::CollisionFrame> again = ode::parse_frame(ode::to_text(*frame));
  FUZZ_REQUIRE(again.ok());
  FUZZ_REQUIRE(ode::to_text(*again) == ode::to_text(*frame));
  const Result<std::vector<IndexPair>> pairs = ode::search_again(*frame);
  FUZZ_REQUIRE(pairs.ok());
  for (const IndexPair& pair : *pairs) {
    FUZZ_REQUIRE(pair.g1 < frame->geoms.size() && pair.g2 < frame->geoms.size());
  }
  return 0;
}
