// `harpoon diamond`: runs the paper's world, writes where its spheres are and what touches, and
// says how far an earlier run was elsewhere.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>

#include "apps/command.hpp"
#include "apps/exit_code.hpp"
#include "apps/files.hpp"
#include "apps/options.hpp"
#include "apps/output.hpp"
#include "apps/progress.hpp"
#include "apps/table.hpp"
#include "bench/divergence.hpp"
#include "bench/ode/diamond.hpp"
#include "bench/recording.hpp"

namespace harpoon::app {
namespace {

/// Bound of lengths, times and forces, and its inverse of those that are not 0.
constexpr double kFarthest = 1e6;

struct DiamondOptions {
  bench::DiamondParameters world;
  unsigned steps = 100;
  unsigned every = 1;
  std::string out = "harpoon-out";
  std::string against;  ///< folder of an earlier run
  std::string plot;
};

/// Where the state goes: to a file, which cannot always be read again, and to be compared.
struct Positions {
  Output& out;
  std::string* copy;  ///< may be null

  void write(const std::string& text) {
    out.write(text);
    if (copy != nullptr) *copy += text;
  }
};

void write_positions(Positions& positions, unsigned step, const bench::DiamondWorld& world) {
  for (std::size_t i = 0; i < world.size(); ++i) {
    positions.write(bench::position_line(step, i, world.position(i)));
  }
}

void write_contact(Output& out, unsigned step, const bench::Candidate& candidate) {
  const ContactF64& c = *candidate.contact;
  out.print("{},{},{},{},{},{},{},{},{},{},{}\n", step, candidate.spheres.g1, candidate.spheres.g2,
            c.pos[0], c.pos[1], c.pos[2], c.normal[0], c.normal[1], c.normal[2], c.depth,
            candidate.flow == Flow::grazing ? "grazing" : "real");
}

struct Totals {
  std::uint64_t candidates = 0;
  std::uint64_t contacts = 0;
};

// Writes the state before each step that is wanted, and the contacts that ODE finds there.
Totals run_world(const DiamondOptions& options, bench::DiamondWorld& world, Positions positions,
                 Output& contacts, Progress& progress) {
  positions.write(fmt::format("{}\n", bench::kPositionsHeader));
  contacts.print("step,g1,g2,x,y,z,nx,ny,nz,depth,type\n");
  Totals totals;
  for (unsigned step = 0; step < options.steps; ++step) {
    const bool is_wanted = step % options.every == 0;
    if (is_wanted) {
      write_positions(positions, step, world);
    }
    world.step([&](const bench::Candidate& candidate) {
      ++totals.candidates;
      if (candidate.contact != nullptr) {
        ++totals.contacts;
        if (is_wanted) {
          write_contact(contacts, step, candidate);
        }
      }
    });
    progress.show((step + 1.0) / options.steps, "steps of the world");
  }
  return totals;
}

constexpr const char* kPositionsFile = "positions.csv";
constexpr const char* kContactsFile = "contacts.csv";

/// The positions of the run to compare with; empty when none is wanted.
std::string read_earlier(const DiamondOptions& options) {
  if (options.against.empty()) return "";
  const std::filesystem::path folder = options.against;
  if (folder.lexically_normal() == std::filesystem::path(options.out).lexically_normal()) {
    throw CommandError(ExitCode::usage,
                       "--against and --out are the same folder. Write this run "
                       "elsewhere with --out.");
  }
  if (!options.plot.empty()) require_writable_file(options.plot, "--plot");
  std::string earlier = read_text_file(folder / kPositionsFile);
  if (!earlier.starts_with(bench::kPositionsHeader)) {
    throw CommandError(ExitCode::data,
                       fmt::format("{} does not begin with \"{}\". Give the folder of a run.",
                                   shown(folder / kPositionsFile), bench::kPositionsHeader));
  }
  return earlier;
}

std::string describe(const Terminal& terminal, const std::vector<bench::Divergence>& divergence) {
  std::vector<std::vector<Cell>> rows;
  for (const bench::Divergence& at : divergence) {
    rows.push_back({fmt::format("{}", at.step), fmt::format("{:.1e}", at.median),
                    fmt::format("{:.1e}", at.largest)});
  }
  return format_table(terminal, {{"step", true}, {"median m", true}, {"largest m", true}}, rows);
}

void compare(const Context& context, const DiamondOptions& options, const std::string& earlier,
             const std::string& positions) {
  const auto file = std::filesystem::path(options.against) / kPositionsFile;
  const auto divergence = bench::compare_positions(earlier, positions);
  if (!divergence) {
    throw CommandError(ExitCode::failure,
                       fmt::format("{} does not compare with this run: {}. Give a run of the same "
                                   "world with the same steps.",
                                   shown(file), divergence.error().message));
  }
  if (earlier == positions) {
    print("the positions are those of {}, bit by bit\n", shown(file));
  } else {
    print("distances between the spheres of both runs:\n{}",
          describe(context.terminal, *divergence));
  }
  if (options.plot.empty()) return;
  const std::string caption = fmt::format(
      "step; distance between the spheres of both runs, m, hMax {}", options.world.h_max);
  write_file(options.plot, bench::divergence_svg(*divergence, caption));
  print("{}\n", shown(options.plot));
}

void run(const Context& context, const DiamondOptions& options) {
  const auto world = value_or_throw(bench::DiamondWorld::create(options.world));
  const std::filesystem::path out = options.out;
  const std::string earlier = read_earlier(options);
  require_writable_folder(out, "--out", {kPositionsFile, kContactsFile});
  Totals totals;
  std::string text;
  {
    OutputFile positions(out / kPositionsFile, "--out");
    OutputFile contacts(out / kContactsFile, "--out");
    Progress progress(context.terminal);
    const Positions both{positions.out(), options.against.empty() ? nullptr : &text};
    totals = run_world(options, *world, both, contacts.out(), progress);
    positions.commit();
    contacts.commit();
  }
  print("{} spheres, {} steps, {} candidate pairs, {} contacts\n{}\n{}\n", world->size(),
        options.steps, totals.candidates, totals.contacts, shown(out / kPositionsFile),
        shown(out / kContactsFile));
  if (!options.against.empty()) compare(context, options, earlier, text);
}

}  // namespace

void add_diamond(CLI::App& root, Context& context) {
  CLI::App* diamond = root.add_subcommand(
      "diamond", "Run the paper's world on ODE; write positions and contacts as CSV");
  auto options = std::make_shared<DiamondOptions>();
  bench::DiamondParameters& world = options->world;
  add_whole(*diamond, "--hmax", world.h_max, 0, bench::kMaxDiamondHMax, "H",
            "Shells of spheres around the centre one");
  add_real(*diamond, "--dsph", world.d_sph, 0, kFarthest, "D",
           "Gap between neighbouring spheres, metres");
  add_whole(*diamond, "--steps", options->steps, 1, 1000000, "N", "World steps to run");
  add_whole(*diamond, "--every", options->every, 1, 1000000, "N", "Write every so many steps");
  add_real(*diamond, "--radius", world.radius, 1 / kFarthest, kFarthest, "R",
           "Radius of a sphere, metres");
  add_real(*diamond, "--force", world.force, -kFarthest, kFarthest, "F",
           "Force toward the centre, newton");
  add_real(*diamond, "--time-step", world.time_step, 1 / kFarthest, kFarthest, "T",
           "Time step, seconds");
  add_name(*diamond, "--out", options->out, "DIR",
           "Folder to write positions.csv and contacts.csv into");
  CLI::Option* const against =
      add_name(*diamond, "--against", options->against, "DIR",
               "Folder of an earlier run of this world: print how far its spheres are from these");
  add_name(*diamond, "--plot", options->plot, "FILE", "Write the distances as an SVG plot")
      ->needs(against);
  diamond->footer(
      "The state written for a step is the one in which its contacts were found, before the world "
      "moves.\n\nExamples:\n  harpoon diamond --hmax 3 --dsph 0\n"
      "  harpoon diamond --hmax 10 --dsph 0.05 --steps 500 --every 50 --out diamond10\n"
      "  harpoon diamond --steps 200 --every 10 --out stock\n"
      "  harpoon run --precision f32 -- \\\n"
      "    harpoon diamond --steps 200 --every 10 --out f32 --against stock --plot f32.svg");
  diamond->callback([&context, options] {
    context.memory_remedy = "Use a smaller --hmax.";
    context.run = [&context, options] { run(context, *options); };
  });
}

}  // namespace harpoon::app
