// `harpoon detect` and `harpoon bench scene` as a user runs them: files in, contacts and figures
// out.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "apps/files.hpp"
#include "apps/process.hpp"
#include "apps/scratch_folder.hpp"
#include "bench/json.hpp"

namespace harpoon::app {
namespace {

using bench::Json;

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Bodies 0 and 1 overlap by 1/2, 1 and 2 touch, 3 is far away, 4 is not a body.
constexpr const char* kCsv =
    "# a test\nx,y,z,r\n0,0,0,1\n1.5,0,0,1\n1.5,2,0,1\n50,0,0,1\nnan,0,0,1\n";

TEST(DetectCommand, WritesCsvInOrderOfIds) {
  const ScratchFolder folder;
  write_file(folder / "bodies.csv", kCsv);
  const Finished f = run_piped({"detect", (folder / "bodies.csv").string()});
  EXPECT_EQ(f.exit_code, 0) << f.err;
  EXPECT_EQ(f.out,
            "g1,g2,pos_x,pos_y,pos_z,normal_x,normal_y,normal_z,depth\n"
            "0,1,0.75,0,0,-1,0,0,0.5\n"
            "1,2,1.5,1,0,0,-1,0,0\n");
  EXPECT_TRUE(contains(f.err, "5 bodies, 2 contacts"));
  EXPECT_TRUE(contains(f.err, "body 4 is left out"));
}

TEST(DetectCommand, NamesTheFirstOfManyBodiesThatAreLeftOut) {
  const ScratchFolder folder;
  std::string text = "x,y,z,r\n0,0,0,1\n";
  for (int k = 0; k < 1000; ++k) text += "0,0,0,-1\n";
  write_file(folder / "bodies.csv", text);
  const Finished f = run_piped({"detect", (folder / "bodies.csv").string()});
  EXPECT_EQ(f.exit_code, 0) << f.err;
  EXPECT_TRUE(contains(f.err, "body 1 is left out"));
  EXPECT_TRUE(contains(f.err, "990 more"));
  EXPECT_LT(f.err.size(), 2000U);
}

TEST(DetectCommand, WritesJsonToAFileFromJson) {
  const ScratchFolder folder;
  write_file(folder / "bodies.json",
             R"({"bodies": [{"x":0,"y":0,"z":0,"r":1}, {"x":1.5,"y":0,"z":0,"r":1},
                            {"x":0,"y":1.5,"z":0,"r":1,"group":2,"mask":2}]})");
  const std::string out = (folder / "contacts.json").string();
  const Finished f = run_piped({"detect", (folder / "bodies.json").string(), "--format", "json",
                                "--output", out, "--threads", "1", "--order", "space"});
  EXPECT_EQ(f.exit_code, 0) << f.err;
  EXPECT_EQ(f.out, "");
  const Json contacts = Json::parse(read_file(out));
  EXPECT_TRUE(contacts.at("excluded").empty());
  // Body 2 has a group of its own that the masks of the others include: both count.
  ASSERT_EQ(contacts.at("contacts").size(), 2U);
  for (const Json& c : contacts.at("contacts")) {
    EXPECT_EQ(c.at("g1"), 0);
    EXPECT_EQ(c.at("depth"), 0.5);
    EXPECT_EQ(c.at("pos").size(), 3U);
    EXPECT_EQ(c.at("normal").size(), 3U);
  }
}

TEST(DetectCommand, MalformedInputNamesFileLineAndColumn) {
  const ScratchFolder folder;
  write_file(folder / "bad.csv", "x,y,z,r\n0,0,0,1\n0,zero,0,1\n");
  write_file(folder / "bad.json", "[{\"x\": 0, \"y\": 0,\n \"z\": true}]");
  for (const auto& [name, place] : {std::pair{"bad.csv", ":3:3: "}, {"bad.json", ":2:"}}) {
    const std::string file = (folder / name).string();
    const Finished f = run_piped({"detect", file});
    EXPECT_EQ(f.exit_code, 4) << name;
    EXPECT_TRUE(contains(f.err, file + place)) << f.err;
    EXPECT_EQ(f.out, "");
  }
  EXPECT_EQ(run_piped({"detect", (folder / "absent.csv").string()}).exit_code, 3);
}

/// The fields that docs/scene.md promises, with figures that can be true.
void expect_result(const Json& result, const std::string& kind, int bodies) {
  EXPECT_EQ(result.at("kind"), kind);
  EXPECT_EQ(result.at("bodies"), bodies);
  EXPECT_GE(result.at("threads"), 1);
  EXPECT_TRUE(result.at("precision") == "f32" || result.at("precision") == "f64");
  for (const char* field :
       {"ms_per_frame", "ms_min", "ms_p90", "update_ms", "broad_ms", "narrow_ms"}) {
    EXPECT_TRUE(std::isfinite(result.at(field).get<double>())) << field;
    EXPECT_GE(result.at(field), 0) << field;
  }
  EXPECT_LE(result.at("ms_min"), result.at("ms_per_frame"));
  EXPECT_LE(result.at("ms_per_frame"), result.at("ms_p90"));
  EXPECT_EQ(result.at("bytes_floor") == 0, result.at("engine") == "harpoon scene, still");
  if (result.at("engine") == "harpoon scene, set again") {
    EXPECT_EQ(result.at("bytes_floor"), bodies * 2 * 16);
  } else if (result.at("bytes_floor") != 0) {
    EXPECT_GE(result.at("bytes_floor"), bodies * 16);
  }
  EXPECT_GE(result.at("pairs"), result.at("contacts"));
}

TEST(BenchSceneCommand, WritesOneResultForEachEngine) {
  for (const std::string kind : {"gas", "packed", "polydisperse", "bed", "diamond", "clusters"}) {
    const Finished f = run_piped({"bench", "scene", "--kind", kind, "--bodies", "2000", "--frames",
                                  "3", "--against", "all", "--json", "-"});
    ASSERT_EQ(f.exit_code, 0) << f.err;
    const Json json = Json::parse(f.out);
    EXPECT_TRUE(json.at("counts_agree"));
    EXPECT_EQ(json.at("frames"), 3);
    EXPECT_TRUE(json.contains("machine") && json.contains("commit") && json.contains("command"));
    ASSERT_GE(json.at("results").size(), 4U) << kind;
    EXPECT_EQ(json.at("results").at(0).at("engine"), "harpoon");
    std::map<std::string, double> ms;
    for (const Json& result : json.at("results")) {
      expect_result(result, kind, 2000);
      ms[result.at("engine")] = result.at("ms_per_frame");
    }
    ASSERT_TRUE(ms.contains("harpoon scene, still") && ms.contains("harpoon scene, set again"));
    EXPECT_LT(10 * ms["harpoon scene, still"], ms["harpoon scene"]) << kind;
  }
}

TEST(BenchSceneCommand, ScalingWritesEverySizeAndTheDocs) {
  const ScratchFolder folder;
  const Finished f = run_piped({"bench", "scene", "--scaling", "--bodies", "2500", "--frames", "2",
                                "--json", "-", "--write-docs", folder.string()});
  ASSERT_EQ(f.exit_code, 0) << f.err;
  const Json json = Json::parse(f.out);
  std::map<std::string, std::vector<int>> sizes;
  for (const Json& result : json.at("results")) {
    expect_result(result, result.at("kind"), result.at("bodies"));
    if (result.at("engine") == "harpoon") {
      sizes[result.at("kind")].push_back(result.at("bodies"));
      for (const char* stage : {"survey", "order", "search", "contacts"}) {
        EXPECT_GT(result.at("stages_ms").at(stage), 0);
      }
    }
  }
  EXPECT_EQ(sizes.size(), 3U);
  for (const auto& [kind, of_kind] : sizes) {
    EXPECT_EQ(of_kind, (std::vector<int>{1000, 2500})) << kind;
  }
  const std::string text = read_file(folder / "scene-figures.md");
  EXPECT_TRUE(contains(text, "## packed"));
  EXPECT_TRUE(contains(text, "| search |"));
  EXPECT_TRUE(contains(text, "scene-scaling.svg"));
  const std::string plot = read_file(folder / "scene-scaling.svg");
  EXPECT_EQ(plot.rfind("<svg ", 0), 0U);
  EXPECT_EQ(plot.substr(plot.size() - 7), "</svg>\n");
  EXPECT_EQ(std::count(plot.begin(), plot.end(), '<'), std::count(plot.begin(), plot.end(), '>'));
}

TEST(BenchSceneCommand, WrongUsageIsExitCode2) {
  EXPECT_EQ(run_piped({"bench", "scene", "--write-docs", "docs"}).exit_code, 2);
  EXPECT_EQ(run_piped({"bench", "scene", "--kind", "soup"}).exit_code, 2);
  const Finished f = run_piped({"bench", "scene", "--against", "abacus"});
  EXPECT_EQ(f.exit_code, 2);
  EXPECT_TRUE(contains(f.err, "abacus")) << f.err;
}

}  // namespace
}  // namespace harpoon::app
