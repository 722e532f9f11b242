// The library says the version of the headers it was built with.

#include "harpoon/version.hpp"

#include <gtest/gtest.h>

#include <string>

namespace harpoon {
namespace {

TEST(Version, IsThatOfTheHeaders) {
  const std::string expected = std::to_string(HARPOON_VERSION_MAJOR) + "." +
                               std::to_string(HARPOON_VERSION_MINOR) + "." +
                               std::to_string(HARPOON_VERSION_PATCH);
  EXPECT_EQ(version(), expected);
}

}  // namespace
}  // namespace harpoon
