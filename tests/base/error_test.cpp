// Every error code has an identifier of its own; a Result is a value or an error.

#include "harpoon/error.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <string>
#include <utility>

namespace harpoon {
namespace {

TEST(Error, EveryCodeHasItsOwnName) {
  std::set<std::string_view> names;
  int codes = 0;
  while (to_string(static_cast<Errc>(codes)) != "unknown") {
    names.insert(to_string(static_cast<Errc>(codes)));
    ++codes;
  }
  EXPECT_EQ(codes, static_cast<int>(Errc::device_fault) + 1);
  EXPECT_EQ(names.size(), static_cast<std::size_t>(codes));
  EXPECT_EQ(to_string(Errc::capacity), "capacity");
  EXPECT_EQ(to_string(static_cast<Errc>(255)), "unknown");
}

TEST(Result, HoldsAValue) {
  Result<std::unique_ptr<int>> result = std::make_unique<int>(7);
  ASSERT_TRUE(result.ok());
  EXPECT_TRUE(static_cast<bool>(result));
  EXPECT_EQ(**result, 7);
  const std::unique_ptr<int> taken = std::move(result).value();
  EXPECT_EQ(*taken, 7);
}

TEST(Result, HoldsAnError) {
  const Result<int> result = Error{Errc::capacity, "The output is too small. Give it 12.", 12};
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().code, Errc::capacity);
  EXPECT_EQ(result.error().message, "The output is too small. Give it 12.");
  EXPECT_EQ(result.error().needed, 12u);
}

TEST(Result, IsMutableInPlace) {
  Result<std::string> result = std::string("net");
  result->append("s");
  *result += "!";
  EXPECT_EQ(result.value(), "nets!");
}

}  // namespace
}  // namespace harpoon
