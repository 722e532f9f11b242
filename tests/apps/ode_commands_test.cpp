// `harpoon run` and `harpoon bench ode` as a user runs them.

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>

#include "apps/files.hpp"
#include "apps/process.hpp"
#include "apps/scratch_folder.hpp"
#include "bench/json.hpp"
#include "ode/frame_file.hpp"

namespace harpoon::app {
namespace {

using bench::Json;

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(RunCommand, SetsThePreloadAndTheVariables) {
  const Finished f = run_piped({"run", "--policy", "fixed", "--stats", "--", "/bin/sh", "-c",
                                "echo $LD_PRELOAD $HARPOON_ODE $HARPOON_STATS $HARPOON_VERIFY"});
  EXPECT_EQ(f.exit_code, 0) << f.err;
  EXPECT_TRUE(contains(f.out, "/libharpoon_ode.so fixed 1 0")) << f.out;
}

TEST(RunCommand, EndsAsTheProgramEnds) {
  EXPECT_EQ(run_piped({"run", "--", "/bin/sh", "-c", "exit 7"}).exit_code, 7);
}

TEST(RunCommand, EndsAsTheProgramEndsWhileItWaits) {
  for (const char* option : {"--stats", "--verify", "--require"}) {
    const Finished killed = run_piped({"run", option, "--", "/bin/sh", "-c", "kill -TERM $$"});
    EXPECT_EQ(killed.exit_code, 128 + SIGTERM) << option;
    const int expected = std::string(option) == "--require" ? 5 : 7;
    EXPECT_EQ(run_piped({"run", option, "--", "/bin/sh", "-c", "exit 7"}).exit_code, expected);
    const Finished absent = run_piped({"run", option, "--", "/no/such/program"});
    EXPECT_EQ(absent.exit_code, 3);
    EXPECT_TRUE(contains(absent.err, "/no/such/program")) << absent.err;
  }
}

TEST(RunCommand, SignalsReachTheProgram) {
  // It tells its parent to end, is told so itself, and ends in its own way.
  const Finished f = run_piped({"run", "--stats", "--", "/bin/sh", "-c",
                                "trap 'echo told; exit 3' TERM; kill -TERM $PPID; "
                                "while :; do sleep 0.01; done"});
  EXPECT_EQ(f.exit_code, 3) << f.err;
  EXPECT_EQ(f.out, "told\n");
}

/// Programs that do without ODE, in all ways to end.
TEST(RunCommand, SaysThatNoCallArrived) {
  const char* const kSilence = "no call of ODE arrived at Harpoon";
  for (const char* program : {"exit 0", "exec sh -c 'exit 0'", "(exit 0); sh -c true"}) {
    for (const char* option : {"--stats", "--verify"}) {
      const Finished f = run_piped({"run", option, "--", "/bin/sh", "-c", program});
      EXPECT_EQ(f.exit_code, 0);
      const std::size_t first = f.err.find(kSilence);
      EXPECT_NE(first, std::string::npos) << f.err;
      EXPECT_EQ(f.err.find(kSilence, first + 1), std::string::npos) << f.err;
    }
    const Finished required = run_piped({"run", "--require", "--", "/bin/sh", "-c", program});
    EXPECT_EQ(required.exit_code, 5);
    EXPECT_TRUE(contains(required.err, kSilence)) << required.err;
  }
  EXPECT_EQ(run_piped({"run", "--", "/bin/sh", "-c", "exit 0"}).err, "");
}

TEST(RunCommand, WhatIsRequiredMayHappenInAnyProcess) {
  const ScratchFolder folder;
  const std::string out = (folder / "out").string();
  const auto diamond = [&](const Environment& environment) {
    return run_piped({"run", "--require", "--", "/bin/sh", "-c",
                      "cd / && \"$0\" diamond --steps 2 --out " + out + "; exit $?",
                      std::filesystem::read_symlink("/proc/self/exe").parent_path() / "harpoon"},
                     environment);
  };
  const Finished served = diamond({});
  EXPECT_EQ(served.exit_code, 0) << served.err;
  EXPECT_FALSE(contains(served.err, "ODE arrived")) << served.err;
  const Finished refused = diamond({"HARPOON_MIN_GEOMS=many"});
  EXPECT_EQ(refused.exit_code, 5) << refused.err;
  EXPECT_TRUE(contains(refused.err, "could not serve them")) << refused.err;
}

/// The dynamic linker would stop reading there, and load nothing or another file.
TEST(RunCommand, APathThatCannotBePreloadedIsNamed) {
  for (const char* name : {"with space", "with:colon"}) {
    const ScratchFolder folder;
    const std::filesystem::path home = folder / name;
    std::filesystem::create_directories(home / "bin");
    std::filesystem::create_directories(home / "lib");
    write_file(home / "lib" / "libharpoon_ode.so", "");
    std::filesystem::copy(std::filesystem::read_symlink("/proc/self/exe").parent_path() / "harpoon",
                          home / "bin" / "harpoon");
    const Finished f = run_piped({"run", "--", home / "bin" / "harpoon", "run", "--", "true"});
    EXPECT_EQ(f.exit_code, 3) << f.err;
    EXPECT_TRUE(contains(f.err, "cannot be preloaded")) << f.err;
  }
}

TEST(RunCommand, NamesWhatIsWrong) {
  const Finished nothing = run_piped({"run"});
  EXPECT_EQ(nothing.exit_code, 2);
  const Finished absent = run_piped({"run", "--", "/no/such/program"});
  EXPECT_EQ(absent.exit_code, 3);
  EXPECT_TRUE(contains(absent.err, "/no/such/program")) << absent.err;
  EXPECT_EQ(run_piped({"run", "--policy", "fast", "--", "true"}).exit_code, 2);
}

/// The paper's system: the diamond in ODE with its contacts from a device.
std::string diamond_positions(const ScratchFolder& folder, const char* name,
                              const std::vector<std::string>& options) {
  std::vector<std::string> words = {"run", "--stats"};
  words.insert(words.end(), options.begin(), options.end());
  const std::string out = (folder / name).string();
  words.insert(words.end(),
               {"--", "/proc/self/exe", "diamond", "--hmax", "3", "--steps", "30", "--out", out});
  const Finished f = run_piped(words);
  EXPECT_EQ(f.exit_code, 0) << f.err;
  EXPECT_TRUE(contains(f.err, "30 searched")) << f.err;
  return read_file((folder / name) / "positions.csv");
}

TEST(RunCommand, TheDiamondIsStocksToTheLastBit) {
  const ScratchFolder folder;
  const Finished f =
      run_piped({"diamond", "--hmax", "3", "--steps", "30", "--out", (folder / "stock").string()});
  ASSERT_EQ(f.exit_code, 0) << f.err;
  EXPECT_EQ(diamond_positions(folder, "exact", {}), read_file(folder / "stock" / "positions.csv"));
}

TEST(RunCommand, TheDiamondInBinary32IsTheSameOnEveryDevice) {
  const ScratchFolder folder;
  const std::string cpu = diamond_positions(folder, "cpu", {"--precision", "f32"});
  EXPECT_NE(cpu, diamond_positions(folder, "exact", {}));
#if HARPOON_WITH_SIMULATED_AFU
  EXPECT_EQ(diamond_positions(folder, "afu", {"--precision", "f32", "--device", "afu"}), cpu);
#endif
}

TEST(DiamondCommand, SaysHowFarAnEarlierRunIs) {
  const ScratchFolder folder;
  const auto diamond = [&](const char* out, std::vector<std::string> more) {
    std::vector<std::string> words = {
        "diamond", "--steps", "40", "--every", "10", "--out", (folder / out).string()};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  const std::string stock = (folder / "stock").string(), plot = (folder / "plot.svg").string();
  ASSERT_EQ(run_piped(diamond("stock", {})).exit_code, 0);
  const Finished same = run_piped(diamond("same", {"--against", stock}));
  EXPECT_EQ(same.exit_code, 0) << same.err;
  EXPECT_TRUE(contains(same.out, "bit by bit")) << same.out;

  std::vector<std::string> words = {"run", "--precision", "f32", "--", "/proc/self/exe"};
  for (const std::string& word : diamond("f32", {"--against", stock, "--plot", plot})) {
    words.push_back(word);
  }
  const Finished other = run_piped(words);
  EXPECT_EQ(other.exit_code, 0) << other.err;
  EXPECT_TRUE(contains(other.out, "\n  30 ")) << other.out;
  EXPECT_FALSE(contains(other.out, "bit by bit")) << other.out;
  EXPECT_TRUE(contains(read_file(plot), "largest</tspan>"));

  const Finished larger = run_piped(diamond("larger", {"--against", stock, "--hmax", "4"}));
  EXPECT_EQ(larger.exit_code, 1);
  EXPECT_TRUE(contains(larger.err, "line 65")) << larger.err;
  EXPECT_EQ(run_piped(diamond("stock", {"--against", stock})).exit_code, 2);
  EXPECT_EQ(run_piped(diamond("out", {"--plot", plot})).exit_code, 2);
  const Finished absent = run_piped(diamond("out", {"--against", "/no/such"}));
  EXPECT_EQ(absent.exit_code, 3);
  EXPECT_TRUE(contains(absent.err, "/no/such/positions.csv")) << absent.err;
}

TEST(RunCommand, ADeviceThatIsNotThereIsNamedAndCpuServes) {
  const ScratchFolder folder;
  const Finished g = run_piped({"run", "--device", "abacus", "--", "/proc/self/exe", "diamond",
                                "--steps", "2", "--out", (folder / "out").string()});
  EXPECT_EQ(g.exit_code, 0) << g.err;
  EXPECT_TRUE(contains(g.err, "abacus")) << g.err;
}

/// Two boxes that a stock hash space does not find.
std::string missed_pair(ode::Policy policy) {
  ode::CollisionFrame frame;
  frame.policy = policy;
  frame.kind = 11;
  frame.min_level = -3;
  frame.max_level = 10;
  frame.difference = "written by a test";
  const std::uint64_t all = ~std::uint64_t{0};
  frame.geoms = {{1, 0, all, all, {0.05, 0.85, 0.05, 0.85, -0.35, 0.45}},
                 {1, 0, all, all, {0.05, 0.85, 0.05, 0.85, 0.05, 0.85}}};
  if (policy == ode::Policy::fixed) frame.ours = {{0, 1}};
  return ode::to_text(frame);
}

TEST(ReplayCommand, RepeatsADifference) {
  const ScratchFolder folder;
  write_file(folder / "fixed.txt", missed_pair(ode::Policy::fixed));
  const Finished differs = run_piped({"replay", (folder / "fixed.txt").string()});
  EXPECT_EQ(differs.exit_code, 1);
  EXPECT_TRUE(contains(differs.out, "stock: 0 pairs, exactly")) << differs.out;
  EXPECT_TRUE(contains(differs.out, "harpoon: 1 pairs, exactly")) << differs.out;
  EXPECT_TRUE(contains(differs.err, "geom 0 (x 0.05 to 0.85")) << differs.err;
  write_file(folder / "compat.txt", missed_pair(ode::Policy::compat));
  const Finished same = run_piped({"replay", (folder / "compat.txt").string()});
  EXPECT_EQ(same.exit_code, 0) << same.err;
  EXPECT_TRUE(contains(same.out, "the same here")) << same.out;
}

TEST(ReplayCommand, ReportsAFrameOnWhichStockAborts) {
  const ScratchFolder folder;
  std::string text = missed_pair(ode::Policy::compat);
  text.replace(text.rfind("0x"), std::string::npos, "nan\nours 0\nstock 0\n");
  write_file(folder / "nan.txt", text);
  const Finished f = run_piped({"replay", (folder / "nan.txt").string()});
  EXPECT_EQ(f.exit_code, 1) << f.err;
  EXPECT_TRUE(contains(f.err, "stock ODE aborts on these geoms: assertion")) << f.err;
}

TEST(ReplayCommand, NamesTheLineOfADamagedFile) {
  const ScratchFolder folder;
  write_file(folder / "bad.txt", "harpoon-ode-frame 1\nx\nsingle maybe\n");
  const Finished f = run_piped({"replay", (folder / "bad.txt").string()});
  EXPECT_NE(f.exit_code, 0);
  EXPECT_TRUE(contains(f.err, "line 3")) << f.err;
}

// The table, which goes to standard error beside JSON.
std::size_t widest_line(const std::string& text) {
  std::size_t widest = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    widest = std::max(widest, end - begin);
    begin = end + 1;
  }
  return widest;
}

TEST(BenchOde, EveryKindOfWorldAndSpaceIsIdentical) {
  for (const char* kind : {"packed", "gas", "mixed", "asleep"}) {
    const Finished f = run_piped(
        {"bench", "ode", "--kind", kind, "--geoms", "600", "--seconds", "0", "--json", "-"});
    ASSERT_EQ(f.exit_code, 0) << f.err;
    EXPECT_LE(widest_line(f.err), 80U) << f.err;
    const Json results = Json::parse(f.out).at("results");
    ASSERT_EQ(results.size(), 4U);
    for (const Json& row : results) {
      EXPECT_EQ(row.at("kind"), kind);
      EXPECT_EQ(row.at("geoms"), 600);
      EXPECT_TRUE(row.at("identical")) << kind << " " << row.at("space");
      EXPECT_GT(row.at("pairs"), 20);
      EXPECT_GT(row.at("contacts"), 10);
      EXPECT_GT(row.at("stock_ms"), 0.0);
      EXPECT_GT(row.at("harpoon_ms"), 0.0);
      EXPECT_GT(row.at("speedup"), 0.0);
    }
  }
}

void expect_sound(const Json& row) {
  EXPECT_TRUE(row.at("identical"));
  EXPECT_GE(row.at("samples"), 5);
  EXPECT_GT(row.at("pairs"), 10.0);
  const double step = row.at("stock_step_ms"), collision = row.at("stock_collision_ms");
  const double our_step = row.at("harpoon_step_ms");
  EXPECT_GT(our_step, row.at("harpoon_collision_ms").get<double>());
  EXPECT_GT(row.at("harpoon_collision_ms"), 0.0);
  EXPECT_GT(step, collision);
  EXPECT_DOUBLE_EQ(row.at("collision_share"), collision / step);
  EXPECT_DOUBLE_EQ(row.at("speedup"), step / our_step);
  EXPECT_DOUBLE_EQ(row.at("limit").get<double>() * (1 - collision / step), 1);
}

TEST(BenchOde, WholeProgramsRunAsWithStock) {
  struct Case {
    const char* program;
    const char* size;
    int geoms;
  };
  // Five planes; eight balls and a plane; an arm of 42.
  const Case cases[] = {{"pile", "300", 305},
                        {"sleeping", "200", 209},
                        {"planner", "40", 82},
                        {"clutter", "1000", 1042}};
  for (const auto& [program, size, geoms] : cases) {
    const Finished f = run_piped(
        {"bench", "ode", "--program", program, "--geoms", size, "--seconds", "0.05", "--json", "-"},
        {"HARPOON_VERIFY=1"});
    ASSERT_EQ(f.exit_code, 0) << f.err;
    EXPECT_TRUE(contains(f.err, "share")) << f.err;
    const Json results = Json::parse(f.out).at("results");
    ASSERT_EQ(results.size(), 1U);
    EXPECT_EQ(results[0].at("program"), program);
    EXPECT_EQ(results[0].at("geoms"), geoms);
    EXPECT_GT(results[0].at("contacts"), 0.0) << program;
    expect_sound(results[0]);
  }
}

TEST(BenchOde, AProgramThatRunsAnotherWayIsReported) {
  const std::vector<std::string> words = {"bench",     "ode", "--program", "diamond10",
                                          "--seconds", "0",   "--json",    "-"};
  const Finished exact = run_piped(words);
  ASSERT_EQ(exact.exit_code, 0) << exact.err;
  expect_sound(Json::parse(exact.out).at("results").at(0));
  const Finished other = run_piped(words, {"HARPOON_PRECISION=f32"});
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_TRUE(contains(other.err, "with the drop-in diamond10 runs another way")) << other.err;
  EXPECT_FALSE(Json::parse(other.out).at("results").at(0).at("identical"));
}

TEST(BenchOde, AWorldWithOtherContactsIsReported) {
  const Finished f = run_piped(
      {"bench", "ode", "--geoms", "600", "--space", "hash", "--seconds", "0", "--json", "-"},
      {"HARPOON_PRECISION=f32"});
  EXPECT_EQ(f.exit_code, 1);
  EXPECT_TRUE(contains(f.err, "the drop-in differs from stock in the hash space")) << f.err;
  EXPECT_FALSE(Json::parse(f.out).at("results").at(0).at("identical"));
}

TEST(BenchOde, ATurnOfASmallWorldHasManySteps) {
  const Finished f = run_piped(
      {"bench", "ode", "--geoms", "42", "--space", "simple", "--seconds", "0", "--json", "-"});
  ASSERT_EQ(f.exit_code, 0) << f.err;
  EXPECT_GT(Json::parse(f.out).at("results").at(0).at("samples"), 20);
}

TEST(BenchOde, NeedsAStockOfItsOwn) {
  for (const char* what : {"--program=planner", "--kind=packed"}) {
    const std::vector<std::string> preloaded = {"run",   "--",  "/proc/self/exe",
                                                "bench", "ode", what};
    const Finished twice = run_piped(preloaded);
    EXPECT_EQ(twice.exit_code, 2);
    EXPECT_TRUE(contains(twice.err, "preloaded already")) << twice.err;
    const Finished alone = run_piped(preloaded, {"HARPOON_BENCH_TWIN=999"});
    EXPECT_EQ(alone.exit_code, 3);
    EXPECT_TRUE(contains(alone.err, "The process with stock libode has ended")) << alone.err;
  }
}

TEST(BenchOde, OptionsThatDoNotGoTogetherAreNamed) {
  for (const char* option : {"--kind=gas", "--space=hash"}) {
    const Finished f = run_piped({"bench", "ode", "--program", "pile", option});
    EXPECT_EQ(f.exit_code, 2);
    EXPECT_TRUE(contains(f.err, "excludes --program")) << f.err;
  }
  const Finished sized = run_piped({"bench", "ode", "--program", "all", "--geoms", "50"});
  EXPECT_EQ(sized.exit_code, 2);
  EXPECT_TRUE(contains(sized.err, "--geoms does not go with diamond10")) << sized.err;
}

}  // namespace
}  // namespace harpoon::app
