// What the command prints and writes without running anything: tables, progress, files, options.

#include <gtest/gtest.h>
#include <stdlib.h>

#include <CLI/CLI.hpp>

#include "apps/device_catalog.hpp"
#include "apps/exit_code.hpp"
#include "apps/files.hpp"
#include "apps/options.hpp"
#include "apps/progress.hpp"
#include "apps/result_table.hpp"
#include "apps/scratch_folder.hpp"
#include "apps/table.hpp"

namespace harpoon::app {
namespace {

constexpr Terminal kPlain{false, false};
constexpr Terminal kColour{false, true};

template <class Action>
CommandError error_of(Action action) {
  try {
    action();
  } catch (const CommandError& error) {
    return error;
  }
  ADD_FAILURE() << "no CommandError";
  return {ExitCode::ok, ""};
}

TEST(Table, AlignsColumnsAndEndsLinesClean) {
  EXPECT_EQ(format_table(kPlain, {{"name"}, {"ns", true}, {"note"}},
                         {{"a", "1.5", "µs"}, {"longer", "100", ""}}),
            "name     ns  note\n"
            "a       1.5  µs\n"
            "longer  100  \n");
}

TEST(Table, ColoursOnlyWhereTheTerminalHasThem) {
  EXPECT_EQ(coloured(kPlain, Colour::red, "MISS"), "MISS");
  EXPECT_EQ(coloured(kColour, Colour::red, "MISS"), "\x1b[31mMISS\x1b[0m");
  EXPECT_EQ(coloured(kColour, Colour::none, "MISS"), "MISS");
}

TEST(Terminal, NoColorAndDumbTerminalsForbidEscapes) {
  // Whatever the streams of this test are, neither may turn an escape on.
  setenv("NO_COLOR", "1", 1);
  EXPECT_FALSE(detect_terminal().has_colour);
  unsetenv("NO_COLOR");
  setenv("TERM", "dumb", 1);
  EXPECT_FALSE(detect_terminal().has_colour);
  EXPECT_FALSE(detect_terminal().shows_progress);
}

TEST(Progress, LineShowsShareTimeLeftAndTitle) {
  EXPECT_EQ(progress_line(0.5, 20, "Figure 7"),
            "[###############...............]  50 %  20 s left  Figure 7");
  EXPECT_EQ(progress_line(0, 1, "recording"), "[..............................]   0 %  recording");
  EXPECT_EQ(progress_line(2, 10, "x").substr(0, 32), "[##############################]");
}

TEST(ExitCode, SeparatesUsageEnvironmentAndFailure) {
  EXPECT_EQ(exit_code_for(Errc::invalid_argument), ExitCode::usage);
  EXPECT_EQ(exit_code_for(Errc::device_unavailable), ExitCode::environment);
  EXPECT_EQ(exit_code_for(Errc::out_of_memory), ExitCode::environment);
  EXPECT_EQ(exit_code_for(Errc::device_fault), ExitCode::failure);
  const CommandError error = error_of([] {
    value_or_throw(Result<int>(Error{Errc::device_timeout, "Nothing came back."}));
  });
  EXPECT_EQ(error.code(), ExitCode::environment);
  EXPECT_STREQ(error.what(), "Nothing came back.");
  EXPECT_EQ(value_or_throw(Result<int>(7)), 7);
}

TEST(Files, AreWrittenWholeAndLeaveNothingElse) {
  const ScratchFolder folder;
  write_file(folder / "a.txt", "one\n");
  write_file(folder / "a.txt", "two\n");
  EXPECT_EQ(read_file(folder / "a.txt"), "two\n");
  EXPECT_THROW(write_file(folder / "a.txt",
                          [](Output& out) {
                            out.write("half");
                            out.flush();
                            throw CommandError(ExitCode::failure, "stop");
                          }),
               CommandError);
  EXPECT_EQ(read_file(folder / "a.txt"), "two\n");
  const std::filesystem::directory_iterator files(folder.string());
  EXPECT_EQ(std::distance(begin(files), end(files)), 1);
}

TEST(Files, ErrorsNameThePathTheReasonAndTheOption) {
  const ScratchFolder folder;
  write_file(folder / "file", "");
  const CommandError below_file =
      error_of([&] { require_writable_folder(folder / "file/below", "--out"); });
  EXPECT_EQ(below_file.code(), ExitCode::environment);
  EXPECT_NE(std::string(below_file.what()).find("file/below"), std::string::npos);
  EXPECT_NE(std::string(below_file.what()).find("--out"), std::string::npos);
  const CommandError absent = error_of([&] { require_writable_file(folder / "no/x", "--json"); });
  EXPECT_NE(std::string(absent.what()).find("No such file"), std::string::npos) << absent.what();
  EXPECT_NE(std::string(error_of([&] { require_writable_file(folder.string(), "--csv"); }).what())
                .find("it is a folder"),
            std::string::npos);
  EXPECT_THROW(read_file(folder / "absent"), CommandError);
}

TEST(Files, CheckingAFileDoesNotCreateOrChangeIt) {
  const ScratchFolder folder;
  require_writable_file(folder / "new", "--json");
  EXPECT_FALSE(std::filesystem::exists(folder / "new"));
  write_file(folder / "old", "kept");
  require_writable_file(folder / "old", "--json");
  EXPECT_EQ(read_file(folder / "old"), "kept");
  require_writable_folder(folder / "x/y", "--out");
  EXPECT_TRUE(std::filesystem::is_empty(folder / "x/y"));
}

TEST(Files, CsvIsAppendedUnderOneHeader) {
  const ScratchFolder folder;
  append_csv(folder / "t.csv", "a,b", "1,2\n");
  append_csv(folder / "t.csv", "a,b", "3,4\n");
  EXPECT_EQ(read_file(folder / "t.csv"), "a,b\n1,2\n3,4\n");
  const CommandError error = error_of([&] { append_csv(folder / "t.csv", "a,c", "5,6\n"); });
  EXPECT_NE(std::string(error.what()).find("header"), std::string::npos);
  EXPECT_EQ(read_file(folder / "t.csv"), "a,b\n1,2\n3,4\n");
}

TEST(Options, ChoicesAndWholeNumbersNameTheBadValue) {
  CLI::App app;
  std::string type = "real";
  unsigned count = 1;
  add_choice(app, "--type", type, {"real", "fake"}, "The type");
  app.add_option("--count", count)->check(whole_number(1, 100));
  app.parse(std::vector<std::string>{"fake", "--type"});
  EXPECT_EQ(type, "fake");
  const auto message = [&](std::vector<std::string> reversed) -> std::string {
    try {
      app.parse(std::move(reversed));
    } catch (const CLI::ParseError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message({"odd", "--type"}).find("\"odd\" is not one of real, fake"), std::string::npos);
  for (const char* bad : {"0", "101", "1.5", "-1", "ten", "18446744073709551616", ""}) {
    EXPECT_NE(message({bad, "--count"}).find("is not a whole number from 1 to 100"),
              std::string::npos)
        << bad;
  }
}

TEST(DeviceCatalog, HasCpuFirstAndOpensItByNameAndThreads) {
  const std::vector<CatalogEntry> entries = device_catalog();
  ASSERT_FALSE(entries.empty());
  EXPECT_EQ(entries[0].name, "cpu");
  EXPECT_TRUE(entries[0].look().available);
  const auto opened = open_devices("cpu", {2, 1});
  ASSERT_EQ(opened.size(), 2U);
  EXPECT_EQ(opened[0].threads, 1U);
  EXPECT_EQ(opened[1].threads, 2U);
  EXPECT_GE(open_devices("all", {1}).size(), 1U);
  const CommandError unknown = error_of([] { open_devices("gpu9", {1}); });
  EXPECT_EQ(unknown.code(), ExitCode::usage);
  EXPECT_NE(std::string(unknown.what()).find("gpu9"), std::string::npos);
  EXPECT_EQ(device_choices().substr(0, 7), "all|cpu");
}

TEST(DeviceCatalog, ZeroThreadsMeansAllAndNothingIsDoubled) {
  const std::vector<unsigned> all = thread_counts({0});
  ASSERT_EQ(all.size(), 1U);
  EXPECT_GE(all[0], 1U);
  EXPECT_EQ(thread_counts({3, 1, 3}), (std::vector<unsigned>{1, 3}));
}

TEST(ResultTable, OfASweepShowsTenCountsWithTheLast) {
  bench::ResultSet results;
  for (std::size_t count = 10; count <= 1000; count += 10) {
    results.rows.push_back({{"cpu", "f32", 1, "records", false, 64},
                            bench::PairType::real,
                            {count, {100, 90, 95, 110, 3}, 30},
                            2});
  }
  results.notes = {"A note."};
  const std::string text = describe_results(kPlain, results);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1 + 10 + 1 + 1);
  EXPECT_NE(text.find(" 1000 "), std::string::npos);
  EXPECT_NE(text.find("A note.\n"), std::string::npos);
}

}  // namespace
}  // namespace harpoon::app
