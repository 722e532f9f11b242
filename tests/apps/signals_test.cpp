// One signal ends every subcommand but `run`, whatever it is doing, with 128 and its number, and no
// file is half-written. Nothing here waits for a time: a process is looked at until it has come as
// far as it must, and how long a command would have worked is hours.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "apps/files.hpp"
#include "apps/process.hpp"
#include "apps/scratch_folder.hpp"

namespace harpoon::app {
namespace {

namespace fs = std::filesystem;

/// A number from a process' /proc/PID/stat; the 14th is the time it computed, in ticks.
long stat_field(pid_t pid, int field) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  std::string text((std::istreambuf_iterator<char>(file)), {});
  std::istringstream rest(text.substr(text.rfind(')') + 2));
  std::string word;
  for (int k = 3; k <= field; ++k) rest >> word;
  return std::atol(word.c_str());
}

/// Signals that a process has a handler for.
unsigned long caught_signals(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/status");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("SigCgt:")) return std::stoul(line.substr(8), nullptr, 16);
  }
  return 0;
}

/// `bench ode` becomes itself once more, with the drop-in in front.
bool is_second_start(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/environ");
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  return text.find("HARPOON_BENCH_TWIN") != std::string::npos;
}

bool has_ended(pid_t pid) {
  siginfo_t info{};
  return waitid(P_PID, static_cast<id_t>(pid), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
         info.si_pid == pid;
}

/// Neither gone nor waiting to be reaped.
bool is_running(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  const std::size_t name_end = text.rfind(')');
  return name_end != std::string::npos && text[name_end + 2] != 'Z';
}

struct Case {
  std::vector<std::string> arguments;
  bool computes = true;  ///< else it waits for a file
};

class Signals : public testing::Test {
 protected:
  [[nodiscard]] std::string in(const char* name) const { return (folder_ / name).string(); }

  void SetUp() override {
    std::string same = "x,y,z,r\n";
    for (int k = 0; k < 100000; ++k) same += "0,0,0,1\n";
    write_file(in("same.csv"), same);
    ASSERT_EQ(mkfifo(in("fifo").c_str(), 0600), 0);
    fs::create_directories(in("out"));
    for (const char* name : {"out/old", "out/csv"}) write_file(in(name), "old\n");
  }

  /// Runs it until it has worked a little, sends the signal, and gives the status.
  int end_by(const Case& c, int signal) {
    const pid_t pid = start(c);
    // It has its handlers, and is past its start: it has computed for two ticks, or it sleeps in
    // what it waits for.
    const bool starts_twice = c.arguments[1] == "ode";
    while (!has_ended(pid) && starts_twice && !is_second_start(pid)) sched_yield();
    while (!has_ended(pid) && (caught_signals(pid) & (1UL << (SIGTERM - 1))) == 0) sched_yield();
    while (!has_ended(pid) && c.computes && stat_field(pid, 14) < 2) sched_yield();
    kill(pid, signal);
    int status = 0;
    EXPECT_EQ(waitpid(pid, &status, 0), pid);
    return status;
  }

  void expect_no_leftovers() const {
    for (const auto& entry : fs::recursive_directory_iterator(in("out"))) {
      EXPECT_EQ(entry.path().string().find(".tmp"), std::string::npos) << entry.path();
    }
    EXPECT_EQ(read_file(in("out/old")), "old\n");
  }

  static pid_t start(const Case& c) {
    const pid_t pid = fork();
    if (pid != 0) return pid;
    setpgid(0, 0);
    // As a shell starts a job in the background.
    ::signal(SIGINT, SIG_IGN);
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    become_command(c.arguments);
  }

  ScratchFolder folder_;
};

TEST_F(Signals, EndEverySubcommandAtOnce) {
  const Case cases[] = {
      {{"detect", in("same.csv"), "--output", in("out/old")}},
      {{"detect", in("fifo")}, false},
      {{"detect", in("same.csv"), "--output", in("fifo")}},
      {{"afu", "--profile", "harp,clock_mhz=2000,latency_ns=100000,gbps=0.1", "--pairs", "10000000",
        "--json", in("out/old"), "--waveform", in("out/vcd")}},
      {{"selftest", "--pairs", "50000000"}},
      {{"bench", "scene", "--bodies", "2000000", "--frames", "100000", "--json", in("out/old")}},
      {{"bench", "scene", "--scaling", "--bodies", "100000000", "--write-docs", in("out")}},
      {{"bench", "pairs", "--count", "100000", "--rounds", "10000", "--json", in("out/old"),
        "--csv", in("out/new")}},
      {{"bench", "pairs", "--check"}},
      {{"bench", "ode", "--seconds", "3600", "--json", in("out/old")}},
      {{"bench", "ode", "--program", "all", "--seconds", "3600"}},
      {{"demo", "--out", in("out")}},
      {{"diamond", "--hmax", "40", "--steps", "1000000", "--out", in("out")}},
      {{"replay", in("fifo")}, false},
  };
  for (const Case& c : cases) {
    for (const int signal : {SIGINT, SIGTERM}) {
      const int status = end_by(c, signal);
      std::string name;
      for (const std::string& word : c.arguments) name += word + " ";
      EXPECT_TRUE(WIFEXITED(status)) << name << signal;
      EXPECT_EQ(WEXITSTATUS(status), 128 + signal) << name;
      expect_no_leftovers();
    }
  }
}

TEST_F(Signals, EndTheOtherProcessOfAPairToo) {
  const pid_t pid = start({{"bench", "ode", "--seconds", "3600"}});
  const std::string children =
      "/proc/" + std::to_string(pid) + "/task/" + std::to_string(pid) + "/children";
  pid_t twin = 0;
  while (!has_ended(pid) && twin == 0) std::ifstream(children) >> twin;
  ASSERT_NE(twin, 0);
  kill(pid, SIGTERM);
  int status = 0;
  waitpid(pid, &status, 0);
  // The kernel ends it as well; who reaps it is no matter here.
  while (is_running(twin)) sched_yield();
}

TEST_F(Signals, ARunIsTheProgramsOwn) {
  // The program has the actions that the command was started with: here SIGINT ignored.
  const pid_t pid = start({{"run", "--", "/bin/sleep", "10000"}});
  const std::string name = "/proc/" + std::to_string(pid) + "/comm";
  std::string comm;
  while (!has_ended(pid) && comm != "sleep") std::ifstream(name) >> comm;
  kill(pid, SIGINT);
  kill(pid, SIGTERM);
  int status = 0;
  waitpid(pid, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(WTERMSIG(status), SIGTERM);
}

}  // namespace
}  // namespace harpoon::app
