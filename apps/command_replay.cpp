// `harpoon replay FILE`: a difference that verification found, once more.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "apps/command.hpp"
#include "apps/exit_code.hpp"
#include "apps/files.hpp"
#include "apps/options.hpp"
#include "apps/output.hpp"
#include "apps/printable.hpp"
#include "apps/stock_frame.hpp"
#include "ode/frame_file.hpp"

namespace harpoon::app {
namespace {

using Pairs = std::vector<IndexPair>;

bool same_pair(const IndexPair& a, const IndexPair& b) {
  return a.g1 == b.g1 && a.g2 == b.g2;
}

bool same(const Pairs& a, const Pairs& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), same_pair);
}

std::string pair_at(const ode::CollisionFrame& frame, const Pairs& pairs, std::size_t k) {
  if (k >= pairs.size()) return "nothing";
  std::string text;
  for (const std::uint32_t g : {pairs[k].g1, pairs[k].g2}) {
    const double* const b = frame.geoms[g].bounds;
    text += fmt::format("{}geom {} (x {} to {}, y {} to {}, z {} to {})",
                        text.empty() ? "" : " and ", g, b[0], b[1], b[2], b[3], b[4], b[5]);
  }
  return text;
}

void replay(const std::string& file) {
  const Result<ode::CollisionFrame> parsed = ode::parse_frame(read_text_file(file));
  if (!parsed) {
    throw CommandError(ExitCode::data, fmt::format("{}: {}", shown(file), parsed.error().message));
  }
  const ode::CollisionFrame& frame = *parsed;
  const Pairs stock = collide_in_stock(frame);
  const Pairs ours = value_or_throw(ode::search_again(frame));
  print("recorded: {}\n", printable(frame.difference));
  print("stock: {} pairs, {} the recorded ones\n", stock.size(),
        same(stock, frame.stock) ? "exactly" : "not");
  print("harpoon: {} pairs, {} the recorded ones\n", ours.size(),
        same(ours, frame.ours) ? "exactly" : "not");
  if (same(stock, ours)) {
    print("they are the same here\n");
    return;
  }
  const auto [at, stock_at] =
      std::mismatch(ours.begin(), ours.end(), stock.begin(), stock.end(), same_pair);
  const auto k = static_cast<std::size_t>(at - ours.begin());
  throw CommandError(ExitCode::failure,
                     fmt::format("pair {} is {}; stock has {}", k, pair_at(frame, ours, k),
                                 pair_at(frame, stock, k)));
}

}  // namespace

void add_replay(CLI::App& root, Context& context) {
  CLI::App* command =
      root.add_subcommand("replay", "Repeat a difference that HARPOON_VERIFY found");
  auto file = std::make_shared<std::string>();
  add_name(*command, "file", *file, "FILE", "What verification wrote")->required();
  command->footer(
      "Collides the recorded geoms in stock ODE and by Harpoon's rules. Exit code 1 when they\n"
      "differ.\n\n"
      "Example:\n"
      "  harpoon replay harpoon-difference-1234.txt");
  command->callback([&context, file] { context.run = [file] { replay(*file); }; });
}

}  // namespace harpoon::app
