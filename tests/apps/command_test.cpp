// The command as a user meets it: exit codes, messages, files, terminals, interruption.

#include <gtest/gtest.h>
#include <signal.h>

#include <regex>

#include "apps/files.hpp"
#include "apps/process.hpp"
#include "apps/scratch_folder.hpp"
#include "bench/json.hpp"
#include "harpoon/version.hpp"

namespace harpoon::app {
namespace {

using bench::Json;

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::size_t lines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

TEST(Command, PrintsItsVersionAndCommit) {
  const Finished f = run_piped({"--version"});
  EXPECT_EQ(f.exit_code, 0);
  EXPECT_TRUE(contains(f.out, "harpoon " + std::string(version()))) << f.out;
  EXPECT_TRUE(contains(f.out, "commit"));
  EXPECT_EQ(f.err, "");
}

TEST(Command, HelpIsEverywhereWithExamples) {
  const std::vector<std::vector<std::string>> commands = {
      {},          {"demo"},     {"bench"},      {"bench", "pairs"}, {"diamond"},
      {"devices"}, {"selftest"}, {"completion"}, {"manual"},         {"afu"}};
  for (std::vector<std::string> command : commands) {
    command.push_back("--help");
    const Finished f = run_piped(command);
    EXPECT_EQ(f.exit_code, 0) << command.front();
    EXPECT_TRUE(contains(f.out, "Example")) << command.front();
    EXPECT_EQ(f.err, "") << command.front();
  }
  EXPECT_TRUE(contains(run_piped({"--help"}).out, "Exit codes:"));
}

TEST(Command, WrongUsageIsExitCode2AndNamesWhatIsWrong) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{}, "subcommand is required"},
      {{"fly"}, "\"fly\" is no command"},
      {{"demo", "--fast"}, "\"--fast\" is no command or option of harpoon demo"},
      {{"bench", "pairs", "--type", "soft"}, "\"soft\" is not one of real, fake, grazing, mixed"},
      {{"bench", "pairs", "--count", "0"}, "--count: \"0\" is not a whole number from 1"},
      {{"bench", "pairs", "--device", "abacus"}, "there is no device \"abacus\""},
      {{"bench", "pairs", "--figure", "6", "--count", "10"}, "excludes"},
      {{"diamond", "--hmax", "46"}, "--hmax"},
      {{"diamond", "--dsph", "-1"}, "--dsph: \"-1\" is not a number from 0"},
      {{"completion", "tcsh"}, "\"tcsh\" is not one of bash, zsh, fish"}};
  for (const auto& [arguments, message] : cases) {
    const Finished f = run_piped(arguments);
    EXPECT_EQ(f.exit_code, 2) << message;
    EXPECT_TRUE(contains(f.err, "harpoon: error: ")) << f.err;
    EXPECT_TRUE(contains(f.err, message)) << f.err;
    EXPECT_EQ(f.out, "") << message;
  }
}

// Whatever else is wrong, or asked for, the word that nobody knows is to blame; and only that.
TEST(Command, TheRightWordIsBlamed) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"bench", "scen", "--help"},
       "\"scen\" is no command or option of harpoon bench. Did you mean scene?"},
      {{"bench", "--help", "scen"}, "\"scen\" is no command or option of harpoon bench"},
      {{"demoo", "--version"}, "\"demoo\" is no command or option of harpoon. Did you mean demo?"},
      {{"detect", "--frmat", "csv", "x"},
       "\"--frmat\" is no command or option of harpoon detect. Did you mean --format?"},
      {{"bench", "pairs", "--cuont", "1"}, "Did you mean --count?"},
      {{"help", "bench", "pears"},
       "\"pears\" is no command or option of harpoon bench. Did you mean pairs?"},
      {{"run", "--policy", "foo", "--", "true"},
       "--policy: \"foo\" is not one of compat, fixed, strict"},
      {{"run", "--polcy", "compat", "--", "true"},
       "\"--polcy\" is no command or option of harpoon run. Did you mean --policy?"},
      {{"run", "--"}, "No command to run"},
      {{"detect", "--threads", "-1", "x"},
       "--threads: \"-1\" is not a whole number from 0 to 1024"},
      {{"detect"}, "file is required"}};
  for (const auto& [arguments, message] : cases) {
    const Finished f = run_piped(arguments);
    EXPECT_EQ(f.exit_code, 2) << message;
    EXPECT_TRUE(contains(f.err, message)) << f.err;
    EXPECT_EQ(f.out, "") << message;
  }
  EXPECT_FALSE(contains(run_piped({"fly"}).err, "Did you mean")) << "nothing is near";
}

TEST(Command, HelpAndVersionHaveOtherNames) {
  EXPECT_EQ(run_piped({"-V"}).out, run_piped({"--version"}).out);
  EXPECT_EQ(run_piped({"help"}).out, run_piped({"--help"}).out);
  EXPECT_EQ(run_piped({"help", "bench"}).out, run_piped({"bench", "--help"}).out);
  EXPECT_EQ(run_piped({"help", "bench", "pairs"}).out, run_piped({"bench", "pairs", "--help"}).out);
}

TEST(Command, TooLittleMemoryIsBlamedOnWhatTakesIt) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer itself needs more addresses than are left";
#endif
  const ScratchFolder folder;
  const std::string file = (folder / "same.csv").string();
  std::string text = "x,y,z,r\n";
  for (int k = 0; k < 30000; ++k) text += "0,0,0,1\n";
  write_file(file, text);
  // All pairs of 30,000 bodies take 32 GB.
  const Finished contacts =
      run_script("ulimit -v 4000000; exec \"$HARPOON\" detect '" + file + "' --threads 1");
  EXPECT_EQ(contacts.exit_code, 3);
  EXPECT_TRUE(contains(contacts.err, "contacts")) << contacts.err;
  EXPECT_FALSE(contains(contacts.err, "--count")) << contacts.err;
  EXPECT_EQ(lines(contacts.err), 1U) << contacts.err;
}

TEST(Command, WhatCannotBeWrittenIsExitCode3BeforeAnyWork) {
  const ScratchFolder folder;
  write_file(folder / "file", "");
  const std::string below = (folder / "file/below").string();
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"demo", "--out", below}, "--out"},
      {{"diamond", "--out", below}, "--out"},
      {{"bench", "pairs", "--json", below}, "--json"},
      {{"bench", "pairs", "--csv", folder.string()}, "--csv"}};
  for (const auto& [arguments, option] : cases) {
    const Finished f = run_piped(arguments);
    EXPECT_EQ(f.exit_code, 3) << option;
    EXPECT_TRUE(contains(f.err, option)) << f.err;
  }
}

TEST(Command, ABatchBeyondTheMemoryIsExitCode3) {
  const Finished f = run_piped({"bench", "pairs", "--count", "2147483648"});
  // A machine with more than half a terabyte would start to work; none of ours has.
  EXPECT_EQ(f.exit_code, 3);
  EXPECT_TRUE(contains(f.err, "--count")) << f.err;
}

TEST(Devices, ListsCpuAndItsInstructionSets) {
  const Finished f = run_piped({"devices"});
  EXPECT_EQ(f.exit_code, 0);
  EXPECT_TRUE(std::regex_search(f.out, std::regex("\ncpu +yes +measured"))) << f.out;
  EXPECT_TRUE(contains(f.out, "Instruction sets of cpu here: ")) << f.out;
}

class AfuCommand : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::regex_search(run_piped({"devices"}).out, std::regex("\nafu +yes +modelled"))) {
      GTEST_SKIP() << "no Verilator in this build";
    }
  }
};

TEST_F(AfuCommand, ShowsTheAfuAndEveryFormat) {
  const Finished f = run_piped({"afu", "--pairs", "300"});
  ASSERT_EQ(f.exit_code, 0) << f.err;
  EXPECT_EQ(f.err, "");
  EXPECT_TRUE(contains(f.out, "AFU ID   484152504f4f4e01")) << f.out;
  EXPECT_TRUE(contains(f.out, "10 SCPUs, 10 index lanes"));
  EXPECT_TRUE(contains(f.out, "Profile  harp: HARP v1"));
  EXPECT_TRUE(std::regex_search(f.out, std::regex("\nempty batch +0 +0 +376 +- ")));
  EXPECT_TRUE(std::regex_search(f.out, std::regex("\ndirect +300 ")));
  EXPECT_TRUE(std::regex_search(f.out, std::regex("\nindexed, hits only +300 ")));
  EXPECT_TRUE(contains(f.out, "7 free"));
  EXPECT_TRUE(contains(f.out, "are modelled"));
}

TEST_F(AfuCommand, WritesTheSameAsJson) {
  const Finished f = run_piped({"afu", "--pairs", "1000", "--hits", "100", "--indexed-hits", "0",
                                "--profile", "harp,latency_ns=500,in_flight=32", "--json", "-"});
  ASSERT_EQ(f.exit_code, 0) << f.err;
  const Json root = Json::parse(f.out);
  EXPECT_EQ(root.at("link").at("profile"), "harp");
  EXPECT_EQ(root.at("link").at("lines_in_flight"), 32);
  EXPECT_EQ(root.at("link").at("modelled"), true);
  EXPECT_EQ(root.at("afu").at("scpus"), 10);
  EXPECT_EQ(root.at("afu").at("formats").size(), 3U);
  ASSERT_EQ(root.at("runs").size(), 5U);
  const auto cycles = [&](int run) { return root.at("runs")[run].at("cycles").get<double>(); };
  for (const Json& run : root.at("runs")) {
    EXPECT_GT(run.at("cycles"), run.at("counters").at("cycles")) << run;
    EXPECT_EQ(run.at("last_steps").size(), 7U);
    EXPECT_GE(run.at("link_occupancy"), 0);
    EXPECT_LE(run.at("link_occupancy"), 1);
  }
  EXPECT_EQ(root.at("runs")[1].at("format"), "direct");
  EXPECT_EQ(root.at("runs")[1].at("hits"), 1000);
  EXPECT_EQ(root.at("runs")[1].at("counters").at("lines_read"), 500);
  EXPECT_EQ(root.at("runs")[3].at("hits"), 0);
  EXPECT_LT(cycles(3), cycles(1)) << "16 index pairs a line and no hit, yet slower";
  EXPECT_GT(cycles(4), 10 * cycles(1)) << "4 lines in flight and a barrier hardly cost anything";
}

TEST_F(AfuCommand, WritesAWaveformAndNamesABadProfile) {
  const ScratchFolder folder;
  const std::string vcd = (folder / "afu.vcd").string();
  const Finished f = run_piped({"afu", "--pairs", "4", "--waveform", vcd});
  ASSERT_EQ(f.exit_code, 0) << f.err;
  EXPECT_TRUE(contains(f.out, vcd));
  EXPECT_TRUE(contains(read_file(vcd), "$enddefinitions"));
  for (const auto& command : {std::vector<std::string>{"afu"}, {"bench", "pairs"}}) {
    std::vector<std::string> arguments = command;
    arguments.insert(arguments.end(), {"--profile", "harp,speed=9"});
    const Finished bad = run_piped(arguments);
    EXPECT_EQ(bad.exit_code, 2) << bad.err;
    EXPECT_TRUE(contains(bad.err, "speed=9")) << bad.err;
  }
}

TEST_F(AfuCommand, ASlowLinkIsWaitedForAndAnAbsurdOneRefused) {
  const Finished slow = run_piped({"afu", "--pairs", "333", "--profile", "harp,latency_ns=5000"});
  EXPECT_EQ(slow.exit_code, 0) << slow.err;
  for (const char* absurd :
       {"clock_mhz=1e9", "clock_mhz=200000000", "clock_mhz=inf", "latency_ns=nan",
        "latency_ns=1e12", "shared=2", "shared=0.5", "in_flight=2.5"}) {
    for (const auto& command :
         {std::vector<std::string>{"afu", "--pairs", "20"}, {"bench", "pairs"}}) {
      std::vector<std::string> arguments = command;
      arguments.insert(arguments.end(), {"--profile", std::string("harp,") + absurd});
      const Finished f = run_piped(arguments);
      EXPECT_EQ(f.exit_code, 2) << absurd;
      EXPECT_TRUE(contains(f.err, " from ")) << f.err;
      EXPECT_TRUE(contains(f.err, "write_latency_ns")) << f.err;
    }
  }
}

TEST_F(AfuCommand, OtherLinksCanBeMeasuredBesideOde) {
  std::vector<double> ns;
  for (const char* profile : {"harp", "harp,gbps=4"}) {
    const Finished f =
        run_piped({"bench", "pairs", "--count", "2000", "--rounds", "1", "--precision", "f32",
                   "--device", "afu", "--profile", profile, "--json", "-"});
    ASSERT_EQ(f.exit_code, 0) << f.err;
    const Json root = Json::parse(f.out);
    const Json& last = root.at("results").back();
    EXPECT_EQ(last.at("device"), "afu");
    EXPECT_EQ(last.at("modelled"), true);
    ns.push_back(last.at("ns_per_pair"));
  }
  EXPECT_GT(ns[1], 1.7 * ns[0]) << "half the bandwidth";
}

TEST(SelftestCommand, PassesHere) {
  const Finished f = run_piped({"selftest", "--pairs", "4000", "--device", "cpu", "--seed", "9"});
  EXPECT_EQ(f.exit_code, 0) << f.out << f.err;
  EXPECT_TRUE(contains(f.out, "checks passed"));
  EXPECT_TRUE(contains(f.out, "(seed 9)"));
  EXPECT_EQ(f.err, "");
}

TEST(Diamond, WritesPositionsAndContacts) {
  const ScratchFolder folder;
  const Finished f = run_piped({"diamond", "--hmax", "2", "--dsph", "0.05", "--steps", "40",
                                "--every", "10", "--out", folder.string()});
  ASSERT_EQ(f.exit_code, 0) << f.err;
  EXPECT_TRUE(contains(f.out, "25 spheres, 40 steps"));
  const std::string positions = read_file(folder / "positions.csv");
  EXPECT_EQ(lines(positions), 1 + 4 * 25U);
  EXPECT_EQ(positions.substr(0, positions.find('\n')), "step,sphere,x,y,z");
  EXPECT_TRUE(contains(positions, "\n30,24,"));
  const std::string contacts = read_file(folder / "contacts.csv");
  EXPECT_EQ(contacts.substr(0, contacts.find('\n')), "step,g1,g2,x,y,z,nx,ny,nz,depth,type");
  EXPECT_GT(lines(contacts), 10U);
  EXPECT_TRUE(contains(contacts, ",real\n"));
}

TEST(BenchPairs, WritesJsonAndAppendsCsv) {
  const ScratchFolder folder;
  const std::string json = (folder / "r.json").string();
  const std::string csv = (folder / "r.csv").string();
  for (int i = 0; i < 2; ++i) {
    const Finished f = run_piped({"bench", "pairs", "--count", "10,50", "--rounds", "1", "--device",
                                  "cpu", "--json", json, "--csv", csv});
    ASSERT_EQ(f.exit_code, 0) << f.err;
    EXPECT_TRUE(contains(f.out, json));
    EXPECT_EQ(f.err, "");
  }
  const Json root = Json::parse(read_file(json));
  ASSERT_EQ(root.at("results").size(), 8U);
  EXPECT_EQ(root.at("results")[0].at("device"), "ode");
  EXPECT_EQ(root.at("results")[0].at("speedup_vs_ode"), 1);
  EXPECT_TRUE(contains(root.at("command").get<std::string>(), "--count 10,50"));
  EXPECT_EQ(lines(read_file(csv)), 1 + 2 * 8U);
}

TEST(BenchPairs, JsonCanGoToStandardOutputAlone) {
  const Finished f = run_piped({"bench", "pairs", "--count", "10", "--rounds", "1", "--type",
                                "grazing", "--device", "cpu", "--json", "-"});
  ASSERT_EQ(f.exit_code, 0) << f.err;
  const Json root = Json::parse(f.out);
  EXPECT_EQ(root.at("results")[0].at("type"), "grazing");
  EXPECT_TRUE(contains(root.at("notes")[0], "were made"));
}

TEST(BenchPairs, DoesTheIndexedFormAndCopyBandwidth) {
  const Finished indexed = run_piped({"bench", "pairs", "--format", "indexed", "--count", "500",
                                      "--spheres", "100", "--rounds", "1", "--device", "cpu"});
  ASSERT_EQ(indexed.exit_code, 0) << indexed.err;
  EXPECT_TRUE(contains(indexed.out, "100 distinct spheres"));
}

class Demo : public testing::Test {
 protected:
  static constexpr const char* kFiles[] = {"report.html", "results.json", "results.csv",
                                           "figure6.csv", "figure7.csv"};
};

TEST_F(Demo, WritesEverythingAndNoProgressInAPipe) {
  const ScratchFolder folder;
  const Finished f = run_piped({"demo", "--quick", "--out", (folder / "out").string()});
  ASSERT_EQ(f.exit_code, 0) << f.err;
  EXPECT_EQ(f.err, "");
  EXPECT_FALSE(contains(f.out, "\x1b"));
  EXPECT_FALSE(contains(f.out, "\r"));
  EXPECT_TRUE(contains(f.out, "equal bit for bit"));
  for (const char* name : kFiles) {
    const std::string file = (folder / "out" / name).string();
    EXPECT_TRUE(contains(f.out, file)) << name;
    EXPECT_GT(read_file(file).size(), 100U) << name;
  }
  const std::string page = read_file(folder / "out" / "report.html");
  const std::string slot = "id=\"harpoon-data\">";
  const std::size_t begin = page.find(slot) + slot.size();
  const Json data = Json::parse(page.substr(begin, page.find("</script>", begin) - begin));
  EXPECT_EQ(data.at("schema"), 2);
  EXPECT_EQ(data.at("figures").size(), 2U);
}

TEST_F(Demo, ShowsProgressOnATerminalAndHonoursNoColor) {
  const ScratchFolder folder;
  const std::vector<std::string> arguments = {"demo", "--quick", "--out", folder.string()};
  const Finished colour = run_on_terminal(arguments, {"TERM=xterm", "NO_COLOR"});
  EXPECT_EQ(colour.exit_code, 0) << colour.out;
  EXPECT_TRUE(contains(colour.out, " %  "));
  EXPECT_TRUE(contains(colour.out, "\x1b[1m"));
  const Finished plain = run_on_terminal(arguments, {"TERM=xterm", "NO_COLOR=1"});
  EXPECT_EQ(plain.exit_code, 0);
  EXPECT_TRUE(contains(plain.out, " %  "));
  EXPECT_FALSE(std::regex_search(plain.out, std::regex("\x1b\\[[0-9;]*m")));
  const Finished dumb = run_on_terminal(arguments, {"TERM=dumb", "NO_COLOR"});
  EXPECT_EQ(dumb.exit_code, 0);
  EXPECT_FALSE(contains(dumb.out, "\x1b"));
}

TEST_F(Demo, AnInterruptEndsItCleanlyWithoutFiles) {
  const ScratchFolder folder;
  bool sent = false;
  const Finished f = run_on_terminal({"demo", "--out", (folder / "out").string()}, {"TERM=xterm"},
                                     [&](const std::string&, int pid) {
                                       if (!sent) {
                                         sent = true;
                                         kill(pid, SIGINT);
                                       }
                                     });
  EXPECT_TRUE(sent);
  EXPECT_EQ(f.exit_code, 130) << f.out;
  EXPECT_TRUE(contains(f.out, "Interrupted. No file was written."));
  EXPECT_TRUE(std::filesystem::is_empty(folder / "out"));
}

}  // namespace
}  // namespace harpoon::app
