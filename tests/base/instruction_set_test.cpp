#include "base/instruction_set.hpp"

#include <dlfcn.h>
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

#if HWY_ARCH_X86
/// Highway's own library, which the build does without.
TEST(InstructionSet, WhatIsUsableIsWhatHighwaySays) {
  void* const highway = dlopen("libhwy.so.1", RTLD_NOW | RTLD_LOCAL);
  if (highway == nullptr) GTEST_SKIP() << "no libhwy.so.1 to ask";
  void* const supported = dlsym(highway, "_ZN3hwy16SupportedTargetsEv");
  ASSERT_NE(supported, nullptr);
  EXPECT_EQ(usable_targets(), reinterpret_cast<std::int64_t (*)()>(supported)() & HWY_TARGETS);
}
#endif

}  // namespace
}  // namespace harpoon
