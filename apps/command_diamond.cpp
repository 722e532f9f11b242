// `harpoon diamond`: runs the paper's world, writes where its spheres are and what touches, and
// says how far an earlier run was elsewhere.

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <ostream>

#include "apps/command.hpp"
#include "apps/exit_code.hpp"
#include "apps/files.hpp"
#include "apps/interrupt.hpp"
#include "apps/progress.hpp"
#include "apps/table.hpp"
#include "bench/divergence.hpp"
#include "bench/ode/diamond.hpp"
#include "bench/recording.hpp"

namespace harpoon::app {
namespace {

struct DiamondOptions {
  bench::DiamondParameters world;
  unsigned steps = 100;
  unsigned every = 1;
  std::string out = "harpoon-out";
  std::string against;  ///< folder of an earlier run
  std::string plot;
};

void write_positions(std::ostream& out, unsigned step, const bench::DiamondWorld& world) {
  for (std::size_t i = 0; i < world.size(); ++i) {
    out << bench::position_line(step, i, world.position(i));
  }
}

void write_contact(std::ostream& out, unsigned step, const bench::Candidate& candidate) {
  const ContactF64& c = *candidate.contact;
  fmt::print(out, "{},{},{},{},{},{},{},{},{},{},{}\n", step, candidate.spheres.g1,
             candidate.spheres.g2, c.pos[0], c.pos[1], c.pos[2], c.normal[0], c.normal[1],
             c.normal[2], c.depth, candidate.flow == Flow::grazing ? "grazing" : "real");
}

struct Totals {
  std::uint64_t candidates = 0;
  std::uint64_t contacts = 0;
};

// Writes the state before each step that is wanted, and the contacts that ODE finds there.
Totals run_world(const DiamondOptions& options, bench::DiamondWorld& world, std::ostream& positions,
                 std::ostream& contacts, Progress& progress) {
  positions << bench::kPositionsHeader << '\n';
  contacts << "step,g1,g2,x,y,z,nx,ny,nz,depth,type\n";
  Totals totals;
  for (unsigned step = 0; step < options.steps; ++step) {
    throw_if_interrupted();
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
  return read_file(folder / kPositionsFile);
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
                                   file.string(), divergence.error().message));
  }
  if (earlier == positions) {
    fmt::print("the positions are those of {}, bit by bit\n", file.string());
  } else {
    fmt::print("distances between the spheres of both runs:\n{}",
               describe(context.terminal, *divergence));
  }
  if (options.plot.empty()) return;
  const std::string caption = fmt::format(
      "step; distance between the spheres of both runs, m, hMax {}", options.world.h_max);
  write_file(options.plot, bench::divergence_svg(*divergence, caption));
  fmt::print("{}\n", options.plot);
}

void run(const Context& context, const DiamondOptions& options) {
  const auto world = value_or_throw(bench::DiamondWorld::create(options.world));
  const std::filesystem::path out = options.out;
  const std::string earlier = read_earlier(options);
  require_writable_folder(out, "--out");
  const auto positions_file = out / kPositionsFile;
  const auto contacts_file = out / "contacts.csv";
  Totals totals;
  {
    Progress progress(context.terminal);
    write_file(positions_file, [&](std::ostream& positions) {
      write_file(contacts_file, [&](std::ostream& contacts) {
        totals = run_world(options, *world, positions, contacts, progress);
      });
    });
  }
  fmt::print("{} spheres, {} steps, {} candidate pairs, {} contacts\n{}\n{}\n", world->size(),
             options.steps, totals.candidates, totals.contacts, positions_file.string(),
             contacts_file.string());
  if (!options.against.empty()) compare(context, options, earlier, read_file(positions_file));
}

}  // namespace

void add_diamond(CLI::App& root, Context& context) {
  CLI::App* diamond = root.add_subcommand(
      "diamond", "Run the paper's world on ODE; write positions and contacts as CSV");
  auto options = std::make_shared<DiamondOptions>();
  diamond->add_option("--hmax", options->world.h_max, "Shells of spheres around the centre one")
      ->check(CLI::Range(0U, bench::kMaxDiamondHMax))
      ->type_name("H")
      ->capture_default_str();
  diamond->add_option("--dsph", options->world.d_sph, "Gap between neighbouring spheres, metres")
      ->type_name("D")
      ->capture_default_str();
  diamond->add_option("--steps", options->steps, "World steps to run")
      ->check(CLI::Range(1, 1000000))
      ->type_name("N")
      ->capture_default_str();
  diamond->add_option("--every", options->every, "Write every so many steps")
      ->check(CLI::Range(1, 1000000))
      ->type_name("N")
      ->capture_default_str();
  diamond->add_option("--radius", options->world.radius, "Radius of a sphere, metres")
      ->type_name("R")
      ->capture_default_str();
  diamond->add_option("--force", options->world.force, "Force toward the centre, newton")
      ->type_name("F")
      ->capture_default_str();
  diamond->add_option("--time-step", options->world.time_step, "Time step, seconds")
      ->type_name("T")
      ->capture_default_str();
  diamond->add_option("--out", options->out, "Folder to write positions.csv and contacts.csv into")
      ->type_name("DIR")
      ->capture_default_str();
  CLI::Option* const against =
      diamond
          ->add_option("--against", options->against,
                       "Folder of an earlier run of this world: print how far its spheres are from "
                       "these")
          ->type_name("DIR");
  diamond->add_option("--plot", options->plot, "Write the distances as an SVG plot")
      ->type_name("FILE")
      ->needs(against);
  diamond->footer(
      "The state written for a step is the one in which its contacts were found, before the world "
      "moves.\n\nExamples:\n  harpoon diamond --hmax 3 --dsph 0\n"
      "  harpoon diamond --hmax 10 --dsph 0.05 --steps 500 --every 50 --out diamond10\n"
      "  harpoon diamond --steps 200 --every 10 --out stock\n"
      "  harpoon run --precision f32 -- \\\n"
      "    harpoon diamond --steps 200 --every 10 --out f32 --against stock --plot f32.svg");
  diamond->callback(
      [&context, options] { context.run = [&context, options] { run(context, *options); }; });
}

}  // namespace harpoon::app
