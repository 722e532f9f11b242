// Nothing is lost in silence: every call of every subcommand that reads or writes fails once, does
// little, or has a reader that is gone. A call that fails is an error with a message; files are old
// or new, and nothing else is left behind.

#include <gtest/gtest.h>

#include <cerrno>
#include <filesystem>
#include <map>

#include "apps/files.hpp"
#include "apps/invocations.hpp"
#include "apps/process.hpp"
#include "apps/scratch_folder.hpp"

namespace harpoon::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kOld = "old\n";

struct Fault {
  const char* call;
  int reason;
};

class EveryCall : public testing::Test {
 protected:
  [[nodiscard]] Finished run(const Invocation& invocation, const Fault& fault, int number) const {
    fs::remove(reached());
    return run_piped(
        invocation.arguments,
        {std::string("LD_PRELOAD=") + HARPOON_FAILING_CALLS, "FAILING_FOLDER=" + work(),
         std::string("FAILING_CALL=") + fault.call, "FAILING_NUMBER=" + std::to_string(number),
         "FAILING_REACHED=" + reached(), "FAILING_ERRNO=" + std::to_string(fault.reason)});
  }
  [[nodiscard]] std::string work() const { return (folder_ / "work").string(); }
  [[nodiscard]] std::string reached() const { return (folder_ / "reached").string(); }
  [[nodiscard]] bool was_reached() const { return fs::exists(reached()); }

  /// A folder with old files.
  std::vector<Invocation> prepare() const {
    fs::remove_all(work());
    fs::create_directories(work());
    std::vector<Invocation> all = every_invocation(work());
    for (const Invocation& invocation : all) put_old_files(invocation);
    return all;
  }
  static void put_old_files(const Invocation& invocation) {
    for (const std::string& file : invocation.files) {
      fs::create_directories(fs::path(file).parent_path());
      if (invocation.makes_csv && file == invocation.files.back()) {
        fs::remove(file);
      } else {
        write_file(file, kOld);
      }
    }
  }
  /// Old, new or not there; and no temporary.
  void expect_whole_files(const Invocation& invocation, const std::string& what) const {
    for (const std::string& file : invocation.files) {
      if (!fs::exists(file)) continue;
      const std::string content = read_file(file);
      ASSERT_FALSE(content.empty()) << what << " " << file;
      EXPECT_TRUE(content.back() == '\n' || content.ends_with("</html>")) << what << " " << file;
    }
    for (const auto& entry : fs::recursive_directory_iterator(work())) {
      EXPECT_EQ(entry.path().string().find(".tmp"), std::string::npos) << what << entry.path();
    }
  }
  static std::map<std::string, std::string> contents(const Invocation& invocation) {
    std::map<std::string, std::string> all;
    for (const std::string& file : invocation.files) all[file] = read_file(file);
    return all;
  }

 private:
  ScratchFolder folder_;
};

TEST_F(EveryCall, ThatFailsIsAnErrorAndLeavesWholeFiles) {
  const Fault faults[] = {{"open", EACCES},      {"read", EIO},   {"write", ENOSPC},
                          {"write", EPIPE},      {"fsync", EIO},  {"rename", EACCES},
                          {"fallocate", ENOSPC}, {"mkdir", EROFS}};
  std::map<std::string, int> injected;
  for (const Invocation& invocation : prepare()) {
    for (const Fault& fault : faults) {
      // It takes seconds, and its writes are those of all others.
      if (invocation.arguments[0] == "demo" && fault.reason == EPIPE) continue;
      for (int number = 0;; ++number) {
        put_old_files(invocation);
        const Finished f = run(invocation, fault, number);
        if (!was_reached()) {
          EXPECT_EQ(f.exit_code, 0) << invocation.name() << f.err;
          break;
        }
        const std::string what =
            invocation.name() + ": " + fault.call + " " + std::to_string(number) + "\n" + f.err;
        EXPECT_EQ(f.exit_code, 3) << what;
        EXPECT_NE(f.err.find("harpoon: error: "), std::string::npos) << what;
        EXPECT_NE(f.err.find(std::strerror(fault.reason)), std::string::npos) << what;
        expect_whole_files(invocation, what);
        ++injected[fault.call];
        ASSERT_LT(number, 1000) << what;
      }
    }
  }
  for (const char* call : {"open", "read", "write", "fsync", "rename"}) {
    EXPECT_GT(injected[call], 5) << call;
  }
}

TEST_F(EveryCall, ThatClosesMayFailWithoutHarm) {
  for (const Invocation& invocation : prepare()) {
    for (int number = 0; invocation.arguments[0] != "demo"; ++number) {
      put_old_files(invocation);
      const Finished f = run(invocation, {"close", EIO}, number);
      if (!was_reached()) break;
      const std::string what = invocation.name() + ": close " + std::to_string(number) + f.err;
      EXPECT_TRUE(f.exit_code == 0 || f.exit_code == 3) << what;
      expect_whole_files(invocation, what);
    }
  }
}

TEST_F(EveryCall, ThatDoesLittleIsRepeated) {
  for (const Invocation& invocation : prepare()) {
    const Finished whole = run(invocation, {"none", 0}, 0);
    ASSERT_EQ(whole.exit_code, 0) << invocation.name() << whole.err;
    const auto expected = contents(invocation);
    for (const char* call : {"short read", "short write"}) {
      put_old_files(invocation);
      const Finished little = run(invocation, {call, 0}, 0);
      EXPECT_EQ(little.exit_code, 0) << invocation.name() << little.err;
      EXPECT_EQ(little.out.empty(), whole.out.empty());
      for (const auto& [file, content] : contents(invocation)) {
        EXPECT_NE(content, kOld) << file;
        EXPECT_TRUE(!invocation.is_repeatable || content == expected.at(file)) << file;
      }
      EXPECT_TRUE(!invocation.is_repeatable || little.out == whole.out) << invocation.name();
    }
  }
}

TEST_F(EveryCall, OnAStandardOutputThatTakesNothing) {
  for (const Invocation& invocation : prepare()) {
    std::string words = "\"$HARPOON\"";
    for (const std::string& argument : invocation.arguments) words += " '" + argument + "'";
    for (const char* where : {"> /dev/full", ">&-"}) {
      put_old_files(invocation);
      const Finished f = run_script("exec " + words + " " + where);
      const bool says_nothing = invocation.arguments[0] == "detect" && !invocation.files.empty();
      EXPECT_EQ(f.exit_code, says_nothing ? 0 : 3) << invocation.name() << where << f.err;
      if (!says_nothing) {
        EXPECT_NE(f.err.find("Cannot write standard output"), std::string::npos)
            << invocation.name() << where << f.err;
      }
      expect_whole_files(invocation, invocation.name() + where);
    }
    // The reader goes first: it has gone when the command starts.
    const Finished piped = run_script("mkfifo " + work() + "/gone; { exec 3<>" + work() +
                                      "/gone; exec 4>" + work() + "/gone; exec 3<&-; } ; " + words +
                                      " >&4 4>&-; echo \"code $?\" >&2; rm " + work() + "/gone");
    const bool says_nothing = invocation.arguments[0] == "detect" && !invocation.files.empty();
    EXPECT_NE(piped.err.find(says_nothing ? "code 0" : "code 3"), std::string::npos)
        << invocation.name() << piped.err;
  }
}

TEST_F(EveryCall, OnAStandardErrorThatTakesNothing) {
  prepare();
  const std::string detect = "\"$HARPOON\" detect '" + work() + "/bodies.csv'";
  EXPECT_EQ(run_script(detect + " 2> /dev/full").exit_code, 3);
  EXPECT_EQ(run_script(detect + " 2>&-").exit_code, 0) << "nobody wanted the remarks";
  EXPECT_EQ(run_script("\"$HARPOON\" detect /nowhere 2> /dev/full").exit_code, 3);
  EXPECT_EQ(run_script("\"$HARPOON\" fly 2>&-").exit_code, 2);
}

}  // namespace
}  // namespace harpoon::app
