#include "base/instruction_set.hpp"

#include <gtest/gtest.h>

#include <set>

#include "harpoon/device.hpp"

namespace harpoon {
namespace {

TEST(InstructionSet, EveryUsableTargetIsFoundByAName) {
  std::set<std::string_view> names;
  for (std::int64_t rest = usable_targets(); rest != 0; rest &= rest - 1) {
    const std::int64_t target = rest & -rest;
    EXPECT_EQ(find_target(name_of_target(target)), target);
    names.insert(name_of_target(target));
  }
  EXPECT_EQ(names.size(), cpu_instruction_sets().size());
  for (const std::string& name : cpu_instruction_sets()) EXPECT_EQ(names.count(name), 1U) << name;
}

TEST(InstructionSet, NoNameIsTheWidestAndAnUnknownNameIsNone) {
  EXPECT_EQ(find_target(""), usable_targets() & -usable_targets());
  EXPECT_EQ(name_of_target(find_target("")), cpu_instruction_sets().back());
  EXPECT_EQ(find_target("abacus"), 0);
}

}  // namespace
}  // namespace harpoon
