// Every byte, and every file that is no text of bodies, as a message shows it.

#include "apps/printable.hpp"

#include <gtest/gtest.h>

#include "apps/detect/bodies_file.hpp"
#include "apps/file_kind.hpp"
#include "apps/shown_text.hpp"

namespace harpoon::app {
namespace {

using namespace std::string_literals;

TEST(Printable, EveryByteIsEscapedOrPlain) {
  for (int byte = 0; byte < 256; ++byte) {
    const std::string text = "a"s + static_cast<char>(byte) + "z";
    const std::string shown = printable(text);
    EXPECT_TRUE(is_fit_for_a_terminal(shown)) << byte;
    const bool is_plain = byte >= 0x20 && byte < 0x7F;
    EXPECT_EQ(shown == text, is_plain) << byte;
    EXPECT_EQ(in_quotes(text).front(), '"');
    EXPECT_TRUE(is_fit_for_a_terminal(in_quotes(text))) << byte;
  }
  EXPECT_EQ(printable("\x1b]0;x\x07\n\r\t\0\x7f"s + '\0'),
            "\\x1b]0;x\\x07\\n\\r\\t\\x00\\x7f\\x00");
  EXPECT_EQ(in_quotes("a\"b\\c"), "\"a\\\"b\\\\c\"");
}

TEST(Printable, WhatIsNoUtf8OrInvisibleIsEscaped) {
  EXPECT_EQ(printable("Grüße, 世界 🎈"), "Grüße, 世界 🎈");
  EXPECT_EQ(printable("\xC3"), "\\xc3");
  EXPECT_EQ(printable("\xC0\xAF"), "\\xc0\\xaf") << "an overlong slash";
  EXPECT_EQ(printable("\xED\xA0\x80"), "\\xed\\xa0\\x80") << "a surrogate";
  EXPECT_EQ(printable("\xF5\x80\x80\x80"), "\\xf5\\x80\\x80\\x80");
  EXPECT_EQ(printable("\xC2\x9B"
                      "31m"),
            "\\u009b31m")
      << "a control sequence of one character";
  for (const char* hidden : {"\xE2\x80\xAE", "\xE2\x80\x8B", "\xE2\x81\xA6", "\xEF\xBB\xBF",
                             "\xE2\x80\xA8", "\xC2\xA0", "\xC2\xAD", "\xF3\xA0\x81\x81"}) {
    EXPECT_EQ(printable(hidden).substr(0, 2), "\\u") << hidden;
  }
}

TEST(Printable, LongTextsKeepTheirEnds) {
  EXPECT_EQ(printable(std::string(100, 'a'), 100), std::string(100, 'a'));
  const std::string long_one = "begin" + std::string(10000000, 'a') + "end";
  const std::string shown = printable(long_one, 40);
  EXPECT_EQ(shown, "begin" + std::string(15, 'a') + "..." + std::string(7, 'a') + "end");
  EXPECT_LE(in_quotes(std::string(5000000, '\x1b')).size(), 4 * kMostQuoted + 10);
  EXPECT_LE(printable(std::string(5000, '\xff'), 40).size(), 4 * 40U + 3);
}

struct Foreign {
  std::string text;
  const char* part;  ///< of the reason
};

std::string in_utf16(const std::string& text, bool marked) {
  std::string wide = marked ? "\xFF\xFE" : "";
  for (const char c : text) wide += {c, '\0'};
  return wide;
}

TEST(ForeignFiles, AreNamedForWhatTheyAre) {
  const std::string csv = "x,y,z,r\n0,0,0,1\n";
  const Foreign all[] = {
      {in_utf16(csv, true), "UTF-16"},
      {in_utf16(csv, false), "UTF-16"},
      {"\xFE\xFF\0x\0,\0y"s, "UTF-16"},
      {"\xFF\xFE\0\0x\0\0\0"s, "UTF-32"},
      {"\x1F\x8B\x08\x08"s + csv, "gzip"},
      {"BZh91AY", "bzip2"},
      {"\xFD\x37zXZ\0\0"s, "xz"},
      {"\x28\xB5\x2F\xFD$", "zstd"},
      {"PK\x03\x04\x14", "zip"},
      {"\xD0\xCF\x11\xE0\xA1", "spreadsheet"},
      {"\x89HDF\r\n\x1A\n", "HDF5"},
      {"\x93NUMPY\x01", "NumPy"},
      {std::string(96, '\0'), "binary"},
      {csv + "0,0,0,5\0\n"s, "binary"},
      {"x;y;z;r\n0;0;0;1\n", "semicolons"},
      {"x\ty\tz\tr\n0\t0\t0\t1\n", "tabs"},
      {"x y z r\n0 0 0 1\n", "spaces"},
      {"x|y|z|r\n", "bars"},
      {"x,y,z,r\n0;0;0;1\n", "semicolons"},
      {"\"x\",\"y\",\"z\",\"r\"\n", "without quotes"},
      {"x,y,z,r\n\"0\",0,0,1\n", "without quotes"},
      {"x,y,z,r\n\"1,200.5\",0,0,1\n", "without quotes"},
      {"x,y,z,r\r0,0,0,1\r", "CR alone"},
      {"x,y,z,r\n0.0D+00,0,0,1\n", "Fortran"},
      {"x,y,z,r\n1d0,0,0,1\n", "Fortran"},
      {"x,y,z,r\n1'000,0,0,1\n", "thousands"},
      {"x,y,z,r\n1_000,0,0,1\n", "thousands"},
      {"x,y,z,r,\n0,0,0,1,\n", "ends with a comma"},
      {"x,y,z,r\n0,0,0,1,\n", "end no line with a comma"},
      {"x,y,z,r\n1\xC2\xA0"
       "000,0,0,1\n",
       "no-break space"},
      {"x,y,z,r\n\xE2\x88\x92"
       "1,0,0,1\n",
       "minus sign"},
      {"x,y,z,r\n,0,0,1\n", "empty"},
      {"0,0,0,1\n", "there is no header"},
      {"[{\"x\":0}]", "this is JSON;"},
      {"{\"x\":0,\"y\":0,\"z\":0,\"r\":1}\n{\"x\":0,\"y\":0,\"z\":0,\"r\":1}\n", "JSON lines"},
      {"ITEM: TIMESTEP\n0\n", "LAMMPS"},
      {"<html>\n", "HTML"},
      {"", "there is no header"},
  };
  for (const Foreign& file : all) {
    const BodiesOrError read = read_bodies_csv(file.text);
    const auto* error = std::get_if<TextError>(&read);
    ASSERT_NE(error, nullptr) << file.part;
    EXPECT_NE(error->reason.find(file.part), std::string::npos)
        << printable(file.text) << ": " << error->reason;
    EXPECT_TRUE(is_fit_for_a_terminal(error->reason)) << printable(error->reason);
  }
  const BodiesOrError lines = read_bodies_json("{\"x\":0,\"y\":0,\"z\":0,\"r\":1}\n{\"x\":0}\n");
  EXPECT_NE(std::get<TextError>(lines).reason.find("JSON lines"), std::string::npos);
}

TEST(ForeignFiles, TextsAreNotTakenForAnythingElse) {
  for (const char* text : {"x,y,z,r\n", "", "# BZh\n", "Größe\n", "\xEF\xBB\xBFx,y,z,r\n"}) {
    EXPECT_EQ(other_than_text(text), "") << text;
  }
}

}  // namespace
}  // namespace harpoon::app
