// What the command prints and writes without running anything: tables, progress, files, options.

#include <gtest/gtest.h>
#include <stdlib.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <random>

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

std::size_t widest_line(const std::string& text) {
  std::size_t widest = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    const std::string line = text.substr(begin, end - begin);
    widest = std::max(widest,
                      static_cast<std::size_t>(std::count_if(line.begin(), line.end(), [](char c) {
                        return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
                      })));
    begin = end + 1;
  }
  return widest;
}

TEST(Table, BreaksTextsWhereItWouldBeTooWide) {
  const std::string what =
      "f32 records, 8000000 pairs, 2 thread(s): share of the copy bandwidth, 30";
  const std::string table =
      format_table(kPlain, {{"target"}, {"measured", true}, {"by itself"}},
                   {{what, "1.25", "harpoon bench pairs --count 8000000 --precision f32 --copy"},
                    {"short", "100", "x"}});
  EXPECT_LE(widest_line(table), kLineWidth);
  // None is broken.
  for (const char* word : {"records,", "8000000", "thread(s):", "bandwidth,", "--precision"}) {
    EXPECT_NE(table.find(word), std::string::npos) << word;
  }
  EXPECT_NE(table.find("short"), std::string::npos);
}

TEST(Table, BreaksTitlesAboveNumbers) {
  std::vector<Column> columns = {{"program"}};
  std::vector<Cell> row = {"a name"};
  for (int i = 0; i < 9; ++i) {
    columns.push_back({"collision: stock ms", true});
    row.emplace_back("1234.56");
  }
  const std::string table = format_table(kPlain, columns, {row});
  EXPECT_LE(widest_line(table), kLineWidth);
  EXPECT_EQ(table.find("1234.5 "), std::string::npos);
}

TEST(Table, AnyTextKeepsToTheWidthOfATerminal) {
  std::mt19937 engine(11);
  int wide = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const std::size_t columns = 1 + engine() % 6;
    std::vector<Column> titles;
    std::vector<std::vector<Cell>> rows(1 + engine() % 4);
    std::size_t natural = 0;
    for (std::size_t c = 0; c < columns; ++c) {
      const bool is_number = engine() % 2 == 0;
      titles.push_back({is_number ? "a title of some words" : "text", is_number});
      for (std::vector<Cell>& row : rows) {
        std::string text;
        const std::size_t words = is_number ? 1 : 1 + engine() % 12;
        for (std::size_t w = 0; w < words; ++w) {
          text += (w == 0 ? "" : " ") + std::string(1 + engine() % (is_number ? 9 : 30), 'x');
        }
        natural += text.size();
        row.emplace_back(text);
      }
    }
    wide += natural > kLineWidth * rows.size();
    const std::string table = format_table(kPlain, titles, rows);
    EXPECT_LE(widest_line(table), kLineWidth) << "trial " << trial << "\n" << table;
    std::size_t drawn = 0;
    for (const std::vector<Cell>& row : rows) {
      for (const Cell& cell : row) {
        drawn += static_cast<std::size_t>(std::count(cell.text.begin(), cell.text.end(), 'x'));
      }
    }
    std::size_t titled = 0;
    for (const Column& column : titles) {
      titled += static_cast<std::size_t>(std::count(column.title.begin(), column.title.end(), 'x'));
    }
    EXPECT_EQ(std::count(table.begin(), table.end(), 'x'),
              static_cast<std::ptrdiff_t>(drawn + titled));
  }
  EXPECT_GT(wide, 50);
}

TEST(Lines, AreBrokenAtSpacesAndWithinWordsLastOfAll) {
  using Lines = std::vector<std::string>;
  EXPECT_EQ(broken_into_lines("", 5), Lines({""}));
  EXPECT_EQ(broken_into_lines("one two three", 7), Lines({"one two", "three"}));
  EXPECT_EQ(broken_into_lines("one two three", 6), Lines({"one", "two", "three"}));
  EXPECT_EQ(broken_into_lines("abcdefgh", 3), Lines({"abc", "def", "gh"}));
  EXPECT_EQ(broken_into_lines("µµµ µµ", 3), Lines({"µµµ", "µµ"}));
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

TEST(ResultTable, KeepsToTheWidthOfATerminal) {
  bench::ResultSet results;
  for (const char* device : {"ode", "ode (Figure 5)", "cpu", "afu"}) {
    for (const std::size_t count : {10UL, 90000UL, 2147483648UL}) {
      const double ns = 1234.56 * static_cast<double>(count);
      results.rows.push_back({{device, "f64", 1024, "records", device[0] == 'a', 64},
                              bench::PairType::real,
                              {count, {ns, ns, ns, 10 * ns, 3, ns}, 30},
                              123.45,
                              {100, 130}});
    }
  }
  results.notes = {std::string(200, 'n')};
  EXPECT_LE(widest_line(describe_results(kPlain, results)), kLineWidth);
  const std::string targets = describe_targets(
      kPlain,
      {{"f32 indexed, 100000 spheres, 1000000 random mixed pairs: times faster than dCollide",
        12.5,
        {12, 13},
        12,
        "harpoon bench pairs --device cpu --format indexed --type mixed --count 1000000 "
        "--precision f32"},
       {"f32 records, 1000000 pairs: two threads against one (at 85 % of 30.5 GB/s of copying)",
        1,
        {0.5, 3},
        1.7,
        "harpoon bench pairs --count 10"}});
  EXPECT_LE(widest_line(targets), kLineWidth);
  EXPECT_NE(targets.find("pass"), std::string::npos);
  EXPECT_NE(targets.find("too noisy"), std::string::npos);
}

TEST(ResultTable, OfASweepShowsTenCountsWithTheLast) {
  bench::ResultSet results;
  for (std::size_t count = 10; count <= 1000; count += 10) {
    results.rows.push_back({{"cpu", "f32", 1, "records", false, 64},
                            bench::PairType::real,
                            {count, {100, 90, 95, 110, 3, 90}, 30},
                            2,
                            {2, 2}});
  }
  results.notes = {"A note."};
  const std::string text = describe_results(kPlain, results);
  // Title, rows, what the columns are (two lines), clock, load, note.
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1 + 10 + 2 + 1 + 1 + 1);
  EXPECT_NE(text.find(" 1000 "), std::string::npos);
  EXPECT_NE(text.find("A note.\n"), std::string::npos);
}

}  // namespace
}  // namespace harpoon::app
