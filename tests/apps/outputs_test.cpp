// What is written never takes the place of what is no regular file: for every option of every
// subcommand that names a file, and everything that such a name may lead to.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <thread>

#include "apps/exit_code.hpp"
#include "apps/files.hpp"
#include "apps/invocations.hpp"
#include "apps/process.hpp"
#include "apps/scratch_folder.hpp"

namespace harpoon::app {
namespace {

namespace fs = std::filesystem;

struct stat status_of(const fs::path& path) {
  struct stat status {};
  EXPECT_EQ(lstat(path.c_str(), &status), 0) << path;
  return status;
}

/// Subcommands that write, with each of the files that they write.
class Outputs : public testing::Test {
 protected:
  template <class Prepare, class Judge>
  void for_every_file(const Prepare& prepare, const Judge& judge) {
    const fs::path work = folder_ / "work";
    int files = 0;
    for (std::size_t k = 0; k < every_invocation(work).size(); ++k) {
      const Invocation invocation = every_invocation(work)[k];
      for (const std::string& file : invocation.files) {
        // What it costs is in the files of the others.
        if (invocation.arguments[0] == "demo" && !file.ends_with("results.csv")) continue;
        fs::remove_all(work);
        fs::create_directories(fs::path(file).parent_path());
        every_invocation(work);
        const std::string appended_to =
            invocation.makes_csv && file == invocation.files.back() ? csv_header() : "old\n";
        prepare(file, appended_to);
        const Finished f = run_piped(invocation.arguments);
        EXPECT_EQ(f.exit_code, 0) << invocation.name() << f.err;
        judge(file, invocation.name());
        ++files;
      }
    }
    EXPECT_GE(files, 12);
  }
  static std::string csv_header() {
    const ScratchFolder folder;
    run_piped({"bench", "pairs", "--count", "10", "--rounds", "1", "--device", "cpu", "--csv",
               (folder / "csv").string()});
    const std::string csv = read_file(folder / "csv");
    return csv.substr(0, csv.find('\n') + 1);
  }
  static void expect_new(const fs::path& file, const std::string& what) {
    const std::string content = read_file(file);
    EXPECT_GT(content.size(), 10U) << what << file;
    EXPECT_NE(content, "old\n") << what << file;
  }

  ScratchFolder folder_;
};

TEST_F(Outputs, KeepModeAndOwnerOfAFile) {
  const bool is_root = geteuid() == 0;
  for_every_file(
      [&](const std::string& file, const std::string& old) {
        write_file(file, old);
        ASSERT_EQ(chmod(file.c_str(), 0604), 0);
        ASSERT_EQ(is_root ? chown(file.c_str(), 12345, 23456) : 0, 0);
      },
      [&](const std::string& file, const std::string& what) {
        expect_new(file, what);
        EXPECT_EQ(status_of(file).st_mode, mode_t{S_IFREG | 0604}) << what;
        EXPECT_EQ(status_of(file).st_uid, is_root ? 12345 : geteuid()) << what;
      });
}

TEST_F(Outputs, FollowLinks) {
  for_every_file(
      [&](const std::string& file, const std::string& old) {
        write_file(file + ".target", old);
        fs::create_symlink(fs::path(file + ".target").filename(), file + ".second");
        fs::create_symlink(file + ".second", file);
      },
      [&](const std::string& file, const std::string& what) {
        EXPECT_TRUE(S_ISLNK(status_of(file).st_mode)) << what;
        EXPECT_TRUE(S_ISLNK(status_of(file + ".second").st_mode)) << what;
        EXPECT_TRUE(S_ISREG(status_of(file + ".target").st_mode)) << what;
        expect_new(file + ".target", what);
      });
  for_every_file([&](const std::string& file,
                     const std::string&) { fs::create_symlink("not-there-yet", file); },
                 [&](const std::string& file, const std::string& what) {
                   EXPECT_TRUE(S_ISLNK(status_of(file).st_mode)) << what;
                   expect_new(fs::path(file).parent_path() / "not-there-yet", what);
                 });
}

TEST_F(Outputs, ReachEveryNameOfAFile) {
  for_every_file(
      [&](const std::string& file, const std::string& old) {
        write_file(file, old);
        fs::create_hard_link(file, file + ".other");
      },
      [&](const std::string& file, const std::string& what) {
        EXPECT_EQ(status_of(file).st_ino, status_of(file + ".other").st_ino) << what;
        expect_new(file + ".other", what);
      });
}

TEST_F(Outputs, GoThroughAFifo) {
  std::thread reader;
  std::string got;
  for_every_file(
      [&](const std::string& file, const std::string&) {
        ASSERT_EQ(mkfifo(file.c_str(), 0600), 0);
        got.clear();
        reader = std::thread([file, &got] { got = read_file(file); });
      },
      [&](const std::string& file, const std::string& what) {
        reader.join();
        EXPECT_TRUE(S_ISFIFO(status_of(file).st_mode)) << what;
        EXPECT_GT(got.size(), 10U) << what;
      });
}

TEST_F(Outputs, GoThroughADevice) {
  if (geteuid() != 0) GTEST_SKIP() << "only root makes devices";
  const std::string probe = (folder_ / "probe").string();
  if (mknod(probe.c_str(), S_IFCHR | 0600, makedev(1, 3)) != 0 ||
      ::open(probe.c_str(), O_WRONLY | O_CLOEXEC) < 0) {
    GTEST_SKIP() << "no devices in " << probe;
  }
  for_every_file(
      [&](const std::string& file, const std::string&) {
        ASSERT_EQ(mknod(file.c_str(), S_IFCHR | 0600, makedev(1, 3)), 0);
      },
      [&](const std::string& file, const std::string& what) {
        EXPECT_TRUE(S_ISCHR(status_of(file).st_mode)) << what;
      });
}

TEST_F(Outputs, GoThroughDescriptorsToTheirPlace) {
  const std::string file = (folder_ / "all").string();
  const std::string bodies = (folder_ / "bodies.csv").string();
  write_file(bodies, "x,y,z,r\n0,0,0,1\n1.5,0,0,1\n");
  for (const char* name : {"/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"}) {
    const Finished f = run_script("{ echo before; \"$HARPOON\" detect '" + bodies + "' --output " +
                                  name + "; echo after; } > '" + file + "'");
    EXPECT_EQ(f.exit_code, 0) << f.err;
    const std::string content = read_file(file);
    EXPECT_EQ(content.substr(0, 10), "before\ng1,") << name;
    EXPECT_EQ(content.substr(content.size() - 6), "after\n") << name;
  }
  EXPECT_EQ(run_script("\"$HARPOON\" detect '" + bodies + "' --output /dev/fd/9").exit_code, 3);
  EXPECT_EQ(run_script("\"$HARPOON\" detect '" + bodies + "' --output /dev/fd/0 < '" + bodies + "'")
                .exit_code,
            3);
  EXPECT_EQ(read_file(bodies).substr(0, 2), "x,");
}

TEST_F(Outputs, AFileThatMayNotBeWrittenStays) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write everything";
  const std::string file = (folder_ / "file").string();
  write_file(file, "old\n");
  ASSERT_EQ(chmod(file.c_str(), 0400), 0);
  EXPECT_THROW(require_writable_file(file, "--output"), CommandError);
  EXPECT_THROW(write_file(file, "new\n"), CommandError);
  EXPECT_EQ(read_file(file), "old\n");
}

}  // namespace
}  // namespace harpoon::app
