// Every command that prints a table keeps to the width of a terminal.

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "apps/process.hpp"
#include "apps/scratch_folder.hpp"
#include "apps/table.hpp"

namespace harpoon::app {
namespace {

void expect_narrow(const std::vector<std::string>& arguments) {
  const Finished f = run_piped(arguments);
  ASSERT_EQ(f.exit_code, 0) << f.err;
  std::size_t printed = 0;
  std::istringstream lines(f.out);
  for (std::string line; std::getline(lines, line); ++printed) {
    const bool is_path = line.find(" /") != std::string::npos || line.starts_with("/");
    const auto width = std::count_if(line.begin(), line.end(), [](char c) {
      return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
    });
    EXPECT_TRUE(is_path || width <= static_cast<std::ptrdiff_t>(kLineWidth))
        << ::testing::PrintToString(arguments) << "\n"
        << line;
  }
  EXPECT_GE(printed, 2U);
}

TEST(Width, OfEveryCommandsTableIsThatOfATerminal) {
  const ScratchFolder folder;
  const std::string out = (folder / "a").string();
  expect_narrow({"devices"});
  expect_narrow({"selftest", "--pairs", "100"});
  expect_narrow({"demo", "--quick", "--out", (folder / "demo").string()});
  expect_narrow({"diamond", "--steps", "5", "--out", out});
  expect_narrow({"diamond", "--steps", "5", "--out", (folder / "b").string(), "--against", out});
  expect_narrow({"bench", "pairs", "--count", "10,100000", "--rounds", "1", "--threads", "1,2"});
  expect_narrow({"bench", "pairs", "--format", "indexed", "--count", "1000", "--rounds", "1"});
  expect_narrow({"bench", "scene", "--bodies", "5000", "--frames", "2"});
}

TEST(Width, OfTheAfusTablesToo) {
  if (run_piped({"devices"}).out.find("\nafu    yes") == std::string::npos) {
    GTEST_SKIP() << "no simulated AFU here";
  }
  expect_narrow({"afu", "--pairs", "100"});
}

}  // namespace
}  // namespace harpoon::app
