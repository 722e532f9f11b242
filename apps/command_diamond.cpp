// `harpoon diamond`: runs the paper's world and writes where its spheres are and what touches.

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
#include "bench/ode/diamond.hpp"
#include "bench/recording.hpp"

namespace harpoon::app {
namespace {

struct DiamondOptions {
  bench::DiamondParameters world;
  unsigned steps = 100;
  unsigned every = 1;
  std::string out = "harpoon-out";
};

void write_positions(std::ostream& out, unsigned step, const bench::DiamondWorld& world) {
  for (std::size_t i = 0; i < world.size(); ++i) {
    const bench::Point p = world.position(i);
    fmt::print(out, "{},{},{},{},{}\n", step, i, p[0], p[1], p[2]);
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
  positions << "step,sphere,x,y,z\n";
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

void run(const Context& context, const DiamondOptions& options) {
  const auto world = value_or_throw(bench::DiamondWorld::create(options.world));
  const std::filesystem::path out = options.out;
  require_writable_folder(out, "--out");
  const auto positions_file = out / "positions.csv";
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
  diamond->footer(
      "The state written for a step is the one in which its contacts were found, before the world "
      "moves.\n\nExamples:\n  harpoon diamond --hmax 3 --dsph 0\n"
      "  harpoon diamond --hmax 10 --dsph 0.05 --steps 500 --every 50 --out diamond10");
  diamond->callback(
      [&context, options] { context.run = [&context, options] { run(context, *options); }; });
}

}  // namespace harpoon::app
