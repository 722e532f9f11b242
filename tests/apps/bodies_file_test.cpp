#include "apps/detect/bodies_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace harpoon::app {
namespace {

FileBodies bodies(const BodiesOrError& read) {
  const auto* error = std::get_if<TextError>(&read);
  EXPECT_EQ(error, nullptr) << (error == nullptr ? "" : error->reason);
  return error == nullptr ? std::get<FileBodies>(read) : FileBodies{};
}

struct Bad {
  const char* text;
  std::size_t line, column;
  const char* part;  ///< of the reason
};

void expect_error(const BodiesOrError& read, const Bad& bad) {
  const auto* error = std::get_if<TextError>(&read);
  ASSERT_NE(error, nullptr) << bad.text;
  EXPECT_EQ(error->line, bad.line) << bad.text << ": " << error->reason;
  EXPECT_EQ(error->column, bad.column) << bad.text << ": " << error->reason;
  EXPECT_NE(error->reason.find(bad.part), std::string::npos) << error->reason;
}

TEST(BodiesFile, ReadsCsv) {
  const FileBodies b = bodies(
      read_bodies_csv("# spheres\r\nr, x,y,z,mask\r\n\r\n0.5,1,-2,3e2,7\n0.25,nan,0,0,4294967295"));
  ASSERT_EQ(b.spheres.size(), 2U);
  EXPECT_EQ(b.spheres[0].x, 1);
  EXPECT_EQ(b.spheres[0].y, -2);
  EXPECT_EQ(b.spheres[0].z, 300);
  EXPECT_EQ(b.spheres[0].r, 0.5);
  EXPECT_TRUE(std::isnan(b.spheres[1].x));
  EXPECT_EQ(b.mask, (std::vector<std::uint32_t>{7, 4294967295U}));
  EXPECT_EQ(b.group, (std::vector<std::uint32_t>{1, 1}));
  EXPECT_TRUE(bodies(read_bodies_csv("x,y,z,r\n")).spheres.empty());
  // What spreadsheets and Fortran programs write.
  const FileBodies marked = bodies(read_bodies_csv("\xEF\xBB\xBFx,y,z,r\n+1.5,-2,+3E+1,1e-999\n"));
  ASSERT_EQ(marked.spheres.size(), 1U);
  EXPECT_EQ(marked.spheres[0].x, 1.5);
  EXPECT_EQ(marked.spheres[0].z, 30);
  EXPECT_EQ(marked.spheres[0].r, 0);
  EXPECT_TRUE(bodies(read_bodies_csv("x,y,z,r\n0,0,0,1\n")).mask.empty());
}

TEST(BodiesFile, NamesLineAndColumnOfBadCsv) {
  const Bad all[] = {
      {"", 1, 1, "no header"},
      {"x,y,z\n", 1, 1, "no column \"r\""},
      {"x,y,z,r,x\n", 1, 9, "twice"},
      {"x,y,z,radius\n", 1, 7, "unknown column"},
      {"x,y,z,r\n1,2,3,4\n1,two,3,4\n", 3, 3, "not a number"},
      {"x,y,z,r\n1,2,3\n", 2, 6, "3 fields"},
      {"x,y,z,r\n1,2,3,4,5\n", 2, 9, "more than 4"},
      {"x,y,z,r,group\n1,2,3,4,-5\n", 2, 9, "32 bits"},
      {"x,y,z,r\n1,,3,4\n", 2, 3, "not a number"},
      {"x,y,z,r\n1,2 2,3,4\n", 2, 3, "not a number"},
      {"x,y,z,r\n1,+-2,3,4\n", 2, 3, "not a number"},
      {"x,y,z,r\n1,-1e999,3,4\n", 2, 3, "too large"},
      {"\xEF\xBB\xBFx,y,z,s\n", 1, 7, "unknown column"},
  };
  for (const Bad& bad : all) expect_error(read_bodies_csv(bad.text), bad);
}

TEST(BodiesFile, ReadsJson) {
  for (const char* text :
       {R"([{"x":1,"y":-2,"z":3.5,"r":0.5,"group":2},{"r":1,"x":0,"y":0,"z":0}])",
        R"({"bodies": [{"x":1,"y":-2,"z":3.5,"r":0.5,"group":2},
                               {"r":1,"x":0,"y":0,"z":0}]})"}) {
    const FileBodies b = bodies(read_bodies_json(text));
    ASSERT_EQ(b.spheres.size(), 2U);
    EXPECT_EQ(b.spheres[0].z, 3.5);
    EXPECT_EQ(b.group, (std::vector<std::uint32_t>{2, 1}));
    EXPECT_EQ(b.mask, (std::vector<std::uint32_t>{0xFFFFFFFF, 0xFFFFFFFF}));
  }
}

TEST(BodiesFile, NamesLineOfBadJson) {
  const struct {
    const char* text;
    std::size_t line;
    const char* part;
  } all[] = {
      {"", 1, "syntax error"},
      {"[{\"x\":1,\n\"y\":}]", 2, "syntax error"},
      {"[{\"x\":1,\"y\":2,\n\"z\":3}]", 2, "no \"r\""},
      {"[{\"x\":\n\"one\"}]", 2, "a string"},
      {"[{\"x\":1,\n\n\"radius\":2}]", 3, "unknown key"},
      {"[{\"x\":1,\"x\":2}]", 1, "twice"},
      {"[1]", 1, "a number"},
      {"{\"spheres\":[]}", 1, "unknown key"},
      {"{}", 1, "no array"},
      {"[{\"x\":1,\"y\":1,\"z\":1,\"r\":1,\"mask\":-1}]", 1, "32 bits"},
      {"[{\"x\":1e999}]", 1, "\"1e999\" is too large"},
      {"[[]]", 1, "an array"},
  };
  for (const auto& bad : all) {
    const BodiesOrError read = read_bodies_json(bad.text);
    const auto* error = std::get_if<TextError>(&read);
    ASSERT_NE(error, nullptr) << bad.text;
    EXPECT_EQ(error->line, bad.line) << bad.text << ": " << error->reason;
    EXPECT_NE(error->reason.find(bad.part), std::string::npos) << error->reason;
  }
}

TEST(BodiesFile, ReportsProgressOfLargeFiles) {
  std::string text = "x,y,z,r\n";
  while (text.size() < (std::size_t{4} << 20)) text += "1.25,2.5,3.75,0.5\n";
  double last = 0;
  int calls = 0;
  const auto read = read_bodies_csv(text, [&](double part) {
    EXPECT_GT(part, last);
    last = part;
    ++calls;
  });
  EXPECT_GT(bodies(read).spheres.size(), 200000U);
  EXPECT_GE(calls, 3);
}

TEST(BodiesFile, TellsHowFarItHasRead) {
  std::string csv = "x,y,z,r\n";
  std::string json = "[";
  for (int i = 0; i < 100000; ++i) {
    csv += "1.25,2.5,3.125,0.5\n";
    json += std::string(i == 0 ? "" : ",\n") + R"({"x":1,"y":2,"z":3,"r":0.5})";
  }
  json += "]";
  for (const bool as_json : {false, true}) {
    std::vector<double> parts;
    const ReadProgress note = [&](double part) { parts.push_back(part); };
    const FileBodies b =
        bodies(as_json ? read_bodies_json(json, note) : read_bodies_csv(csv, note));
    EXPECT_EQ(b.spheres.size(), 100000U);
    ASSERT_GE(parts.size(), (as_json ? json : csv).size() >> 20);
    EXPECT_TRUE(std::is_sorted(parts.begin(), parts.end()));
    EXPECT_GT(parts.front(), 0);
    EXPECT_LE(parts.back(), 1);
  }
}

}  // namespace
}  // namespace harpoon::app
