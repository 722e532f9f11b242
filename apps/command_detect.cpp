// `harpoon detect FILE`: all contacts among a user's own bodies.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <exception>
#include <new>

#include "apps/command.hpp"
#include "apps/detect/bodies_file.hpp"
#include "apps/exit_code.hpp"
#include "apps/files.hpp"
#include "apps/options.hpp"
#include "apps/output.hpp"
#include "apps/progress.hpp"
#include "bench/machine.hpp"

namespace harpoon::app {
namespace {

/// Bodies that are left out and named; JSON lists all of them.
constexpr std::size_t kMostNamed = 10;

struct DetectOptions {
  std::string file;
  std::string format = "csv";
  std::string output = "-";
  std::string order = "ids";
  unsigned threads = 0;
};

bool ends_with_json(std::string file) {
  std::transform(file.begin(), file.end(), file.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return file.ends_with(".json");
}

FileBodies read_bodies(const Context& context, const std::string& file) {
  InputFile input(file);
  Progress progress(context.terminal);
  TextSource source([&](std::span<char> to) { return input.read(to); }, input.bytes(),
                    [&](double part) { progress.show(part, "reading"); });
  BodiesOrError read = ends_with_json(file) ? read_bodies_json(source) : read_bodies_csv(source);
  if (const auto* error = std::get_if<TextError>(&read)) {
    throw CommandError(ExitCode::data, fmt::format("{}:{}:{}: {}", shown(file), error->line,
                                                   error->column, error->reason));
  }
  return std::get<FileBodies>(std::move(read));
}

struct Found {
  std::vector<BodyContactF64> contacts;
  std::vector<std::uint32_t> excluded;
};

/// Room for all contacts. What is more than the machine has would be granted, and the process ended
/// when it is used.
void make_room(std::vector<BodyContactF64>& contacts, std::uint64_t needed) {
  const double gb = static_cast<double>(needed) * sizeof(BodyContactF64) * 1e-9;
  try {
    if (gb > bench::describe_machine().memory_gb) throw std::bad_alloc();
    contacts.resize(needed);
  } catch (const std::exception&) {
    throw CommandError(ExitCode::environment,
                       fmt::format("no memory for all {} contacts ({:.1f} GB). So many bodies "
                                   "overlap; use smaller radii, or rules between them.",
                                   needed, gb));
  }
}

Found find_contacts(const FileBodies& bodies, const DetectOptions& options) {
  Workspace workspace = value_or_throw(Workspace::make({.threads = options.threads}));
  BodiesF64 view{std::span<const SphereF64>(bodies.spheres)};
  view.filters.category = bodies.group;
  view.filters.collide = bodies.mask;
  const ContactOrder order = options.order == "ids" ? ContactOrder::ids : ContactOrder::space;
  Found found;
  found.contacts.resize(4 * bodies.spheres.size());
  auto report = detect(workspace, view, std::span(found.contacts), order);
  if (!report && report.error().code == Errc::capacity) {
    make_room(found.contacts, report.error().needed);
    report = detect(workspace, view, std::span(found.contacts), order);
  }
  const DetectReport done = value_or_throw(std::move(report));
  found.contacts.resize(done.contacts);
  found.excluded = done.excluded;
  return found;
}

void write_csv(const Found& found, Output& out) {
  out.print("g1,g2,pos_x,pos_y,pos_z,normal_x,normal_y,normal_z,depth\n");
  for (const BodyContactF64& c : found.contacts) {
    out.print("{},{},{},{},{},{},{},{},{}\n", c.g1, c.g2, c.pos[0], c.pos[1], c.pos[2], c.normal[0],
              c.normal[1], c.normal[2], c.depth);
  }
}

void write_json(const Found& found, Output& out) {
  out.print("{{\"excluded\": [{}],\n \"contacts\": [", fmt::join(found.excluded, ", "));
  const char* separator = "\n";
  for (const BodyContactF64& c : found.contacts) {
    out.print(
        "{}  {{\"g1\": {}, \"g2\": {}, \"pos\": [{}, {}, {}], \"normal\": [{}, {}, {}], "
        "\"depth\": {}}}",
        separator, c.g1, c.g2, c.pos[0], c.pos[1], c.pos[2], c.normal[0], c.normal[1], c.normal[2],
        c.depth);
    separator = ",\n";
  }
  out.print("\n]}}\n");
}

void run(const Context& context, const DetectOptions& options) {
  if (options.output != "-") require_writable_file(options.output, "--output");
  const FileBodies bodies = read_bodies(context, options.file);
  const Found found = find_contacts(bodies, options);
  const auto write = [&](Output& out) {
    options.format == "json" ? write_json(found, out) : write_csv(found, out);
  };
  if (options.output == "-") {
    write(standard_output());
  } else {
    write_file(options.output, write);
  }
  const auto number = [](std::size_t count, const char* one, const char* several) {
    return fmt::format("{} {}", count, count == 1 ? one : several);
  };
  note("{}, {}\n", number(bodies.spheres.size(), "body", "bodies"),
       number(found.contacts.size(), "contact", "contacts"));
  const std::size_t named = std::min(found.excluded.size(), kMostNamed);
  for (std::size_t k = 0; k < named; ++k) {
    note("body {} is left out: not finite, too large or of negative radius\n", found.excluded[k]);
  }
  if (found.excluded.size() > named) {
    note("and {} more\n", found.excluded.size() - named);
  }
}

}  // namespace

void add_detect(CLI::App& root, Context& context) {
  CLI::App* detect = root.add_subcommand("detect", "All contacts among the bodies of a file");
  auto options = std::make_shared<DetectOptions>();
  add_name(*detect, "file", options->file, "FILE",
           "Bodies: .json, otherwise CSV with header x,y,z,r[,group,mask]")
      ->required();
  add_choice(*detect, "--format", options->format, {"csv", "json"}, "Format of the contacts")
      ->capture_default_str();
  add_name(*detect, "--output", options->output, "FILE", "Where they go; - for standard output");
  add_choice(*detect, "--order", options->order, {"ids", "space"}, "Order of the contacts")
      ->capture_default_str();
  add_whole(*detect, "--threads", options->threads, 0, 1024, "T", "Most threads; 0 for all");
  detect->footer(
      "Bodies are numbered from 0 in the order of the file; numbers are read and written in "
      "double\n"
      "precision. Two bodies count when (group1 & mask2) or (group2 & mask1) is not 0.\n"
      "A line has at most 65536 bytes, a field 1024. JSON is an array of objects, or an object "
      "with\n"
      "one as \"bodies\".\n\n"
      "Examples:\n"
      "  harpoon detect spheres.csv\n"
      "  harpoon detect spheres.json --format json --output contacts.json");
  detect->callback([&context, options] {
    context.memory_remedy = "Give fewer bodies, or use a larger machine.";
    context.run = [&context, options] { run(context, *options); };
  });
}

}  // namespace harpoon::app
