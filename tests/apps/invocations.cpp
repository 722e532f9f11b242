#include "apps/invocations.hpp"

#include "apps/files.hpp"
#include "ode/frame_file.hpp"

namespace harpoon::app {
namespace {

/// What verification could have written: two boxes that a stock hash space does not find.
std::string frame_text() {
  ode::CollisionFrame frame;
  frame.policy = ode::Policy::compat;
  frame.kind = 11;
  frame.min_level = -3;
  frame.max_level = 10;
  frame.difference = "written by a test";
  const std::uint64_t all = ~std::uint64_t{0};
  frame.geoms = {{1, 0, all, all, {0.05, 0.85, 0.05, 0.85, -0.35, 0.45}},
                 {1, 0, all, all, {0.05, 0.85, 0.05, 0.85, 0.05, 0.85}}};
  return ode::to_text(frame);
}

}  // namespace

std::string Invocation::name() const {
  std::string words = "harpoon";
  for (const std::string& argument : arguments) words += " " + argument;
  return words;
}

std::vector<Invocation> every_invocation(const std::filesystem::path& folder,
                                         const std::string& suffix) {
  const auto in = [&](const std::string& name) { return (folder / name).string(); };
  const auto out = [&](const std::string& name) { return in(name + suffix); };
  std::filesystem::create_directories(folder);
  write_file(in("bodies.csv"), "x,y,z,r\n0,0,0,1\n1.5,0,0,1\n");
  write_file(in("bodies.json"), R"([{"x":0,"y":0,"z":0,"r":1},{"x":1.5,"y":0,"z":0,"r":1}])");
  write_file(in("frame.txt"), frame_text());
  std::filesystem::create_directories(in("earlier"));
  std::string positions = "step,sphere,x,y,z\n";
  for (int step = 0; step < 2; ++step) {
    for (int i = 0; i < 7; ++i) {
      positions += std::to_string(step) + "," + std::to_string(i) + ",0,0,0\n";
    }
  }
  write_file(in("earlier/positions.csv"), positions);
  const std::string demo = out("demo"), diamond = out("diamond"), docs = out("docs");
  const std::vector<std::string> scene = {"bench", "scene", "--bodies", "100", "--frames", "1"};
  const auto with = [](std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  const std::vector<std::string> pairs = {"bench",    "pairs", "--count",  "10",
                                          "--rounds", "1",     "--device", "cpu"};
  const std::vector<std::string> ode = {"bench",   "ode",    "--geoms",   "10",
                                        "--space", "simple", "--seconds", "0"};
  return {
      {{"--version"}, {}},
      {{"--help"}, {}},
      {{"help", "bench", "pairs"}, {}},
      {{"devices"}, {}},
      {{"manual"}, {}},
      {{"completion", "bash"}, {}},
      {{"completion", "zsh"}, {}},
      {{"completion", "fish"}, {}},
      {{"detect", in("bodies.csv")}, {}},
      {{"detect", in("bodies.json"), "--format", "json"}, {}},
      {{"detect", in("bodies.csv"), "--output", out("contacts")}, {out("contacts")}},
      {{"selftest", "--pairs", "8", "--device", "cpu"}, {}},
      {{"replay", in("frame.txt")}, {}},
      {{"afu", "--pairs", "4"}, {}, false},
      {{"afu", "--pairs", "4", "--json", "-"}, {}, false},
      {{"afu", "--pairs", "4", "--json", out("afu"), "--waveform", out("vcd")},
       {out("afu"), out("vcd")},
       false},
      {with(pairs, {"--json", "-"}), {}, false},
      {with(pairs, {"--json", out("json"), "--csv", out("csv")}),
       {out("json"), out("csv")},
       false,
       true},
      {with(scene, {"--json", "-"}), {}, false},
      {with(scene, {"--json", out("scene")}), {out("scene")}, false},
      {with(scene, {"--scaling", "--write-docs", docs}),
       {docs + "/scene-figures.md", docs + "/scene-scaling.svg"},
       false},
      {with(ode, {"--json", "-"}), {}, false},
      {with(ode, {"--json", out("ode")}), {out("ode")}, false},
      {{"diamond", "--hmax", "1", "--steps", "2", "--out", diamond, "--against", in("earlier"),
        "--plot", out("plot")},
       {diamond + "/positions.csv", diamond + "/contacts.csv", out("plot")}},
      {{"demo", "--quick", "--out", demo},
       {demo + "/report.html", demo + "/results.json", demo + "/results.csv", demo + "/figure6.csv",
        demo + "/figure7.csv"},
       false},
  };
}

}  // namespace harpoon::app
