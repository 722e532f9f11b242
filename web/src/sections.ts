// The parts of the report that are text and tables, in the order of the page.

import { results_csv } from "./csv.ts";
import { button, choice, download_button, h } from "./dom.ts";
import { three_digits, time, whole } from "./format.ts";
import type { Report, Result } from "./schema.ts";
import { choose_theme } from "./theme.ts";

export function header(report: Report): HTMLElement {
  const themes = { auto: "system", light: "light", dark: "dark" };
  const tiles = report.headlines.map(({ value, label, detail, modelled }) =>
    h(
      "div",
      { class: modelled ? "tile modelled" : "tile" },
      h("dt", {}, label),
      h("dd", {}, h("strong", {}, value), h("span", {}, detail)),
    ),
  );
  return h(
    "header",
    {},
    h(
      "div",
      { class: "title" },
      h("h1", {}, report.title),
      choice("colours", themes, "auto", choose_theme),
    ),
    h("p", { class: "lead" }, report.experiment),
    h("dl", { class: "tiles" }, ...tiles),
  );
}

// What a reader came for is next to the name, so that it is on a narrow screen too.
const kColumns = [
  "device",
  "speed-up over ODE",
  "ns per pair",
  "fastest run",
  "GB/s",
  "threads",
  "runs",
] as const;

function name_of({ device, precision, threads }: Result): string {
  return `${device} ${precision}${threads > 1 ? `, ${threads} threads` : ""}`;
}

function result_row(result: Result, largest_speedup: number): HTMLTableRowElement {
  const kind = result.modelled ? "modelled" : "measured";
  const bar = h("span", { class: `bar ${kind}` });
  bar.style.setProperty("--share", String(result.speedup_vs_ode / largest_speedup));
  const number = (text: string): HTMLElement => h("td", { class: "number" }, text);
  return h(
    "tr",
    { class: result.device === "ode" ? "baseline" : undefined },
    h("th", { scope: "row" }, name_of(result), " ", h("small", { class: kind }, kind)),
    h("td", { class: "number speedup" }, bar, `${three_digits(result.speedup_vs_ode)}×`),
    number(three_digits(result.ns_per_pair)),
    number(three_digits(result.ns_per_pair_min)),
    number(three_digits(result.gb_per_s)),
    number(whole(result.threads)),
    number(whole(result.runs)),
  );
}

/** The summary table: one group of rows a batch, so that devices on equal work are neighbours. */
export function results_section(report: Report): HTMLElement {
  const largest = Math.max(1, ...report.results.map((result) => result.speedup_vs_ode));
  const groups = new Map<string, Result[]>();
  for (const result of report.results) {
    const batch = `${whole(result.count)} ${result.type} collisions`;
    groups.set(batch, [...(groups.get(batch) ?? []), result]);
  }
  const head = kColumns.map((name, n) =>
    h("th", { scope: "col", class: n === 0 ? undefined : "number" }, name),
  );
  const bodies = [...groups].map(([batch, results]) =>
    h(
      "tbody",
      {},
      h(
        "tr",
        { class: "batch" },
        h("th", { scope: "rowgroup", colspan: String(kColumns.length) }, batch),
      ),
      ...results.map((result) => result_row(result, largest)),
    ),
  );
  const table = h("table", { class: "results" }, h("thead", {}, h("tr", {}, ...head)), ...bodies);
  return h(
    "section",
    { id: "results" },
    h("h2", {}, "Time per collision"),
    h(
      "p",
      { class: "soft" },
      "Each group is one batch of the same pairs for every device. ns per pair is the median " +
        "over the runs; speed-up and GB/s are those of the fastest run, which other programs " +
        "cannot move.",
    ),
    h(
      "div",
      { class: "scroll", tabindex: "0", role: "region", "aria-label": "Table of results" },
      table,
    ),
    h(
      "div",
      { class: "below" },
      h("span", {}),
      download_button("Results as CSV", "harpoon-results.csv", () => results_csv(report.results)),
    ),
  );
}

export function claims_section(report: Report): HTMLElement | undefined {
  if (report.claims.length === 0) return undefined;
  const cell = (name: string, text: string): HTMLElement => h("td", { "data-name": name }, text);
  const rows = report.claims.map(({ paper, ours, verdict }) =>
    h("tr", {}, cell("The paper", paper), cell("This run", ours), cell("Verdict", verdict)),
  );
  const head = ["The paper", "This run", "Verdict"].map((name) => h("th", { scope: "col" }, name));
  return h(
    "section",
    { id: "claims" },
    h("h2", {}, "The paper's claims beside this run"),
    h("table", { class: "claims" }, h("thead", {}, h("tr", {}, ...head)), h("tbody", {}, ...rows)),
  );
}

function copy(command: HTMLElement, said: HTMLElement): void {
  const selection = getSelection();
  selection?.selectAllChildren(command);
  const say = (worked: boolean): void => {
    said.textContent = worked ? "copied" : "selected: press Ctrl+C";
  };
  if (navigator.clipboard) {
    navigator.clipboard.writeText(command.textContent).then(
      () => say(true),
      () => say(false),
    );
  } else {
    say(false);
  }
}

export function machine_section(report: Report): HTMLElement {
  const { machine } = report;
  const facts: readonly (readonly [string, string])[] = [
    ["processor", machine.cpu],
    ["cores", whole(machine.cores)],
    ["memory", `${three_digits(machine.memory_gb)} GB`],
    ["largest cache", machine.cache_mb > 0 ? `${three_digits(machine.cache_mb)} MB` : "unknown"],
    ["instruction set", machine.instruction_set],
    ["system", machine.os],
    ["kernel", machine.kernel],
    ["compiler", machine.compiler],
    ["ODE", machine.ode],
    ["Harpoon", machine.harpoon],
    ["commit", report.commit],
    ["date", report.date.replace("T", " ").replace(/\.\d+/, "").replace("Z", " UTC")],
    ["load", report.load_text],
    ["reading the clock", `${time(report.timer_overhead_ns)}, reported apart`],
  ];
  const list = facts.map(([name, value]) => h("div", {}, h("dt", {}, name), h("dd", {}, value)));
  const command = h("code", { id: "command" }, report.command);
  const said = h("span", { role: "status", class: "soft" });
  return h(
    "section",
    { id: "machine" },
    h("h2", {}, "Where and how it ran"),
    h("dl", { class: "facts" }, ...list),
    h("h3", {}, "To repeat it"),
    h(
      "div",
      { class: "command" },
      command,
      button("Copy", () => copy(command, said)),
      said,
    ),
  );
}

export function notes_section(report: Report): HTMLElement | undefined {
  if (report.notes.length === 0) return undefined;
  const notes = report.notes.map((note) => h("li", {}, note));
  return h("section", { id: "notes" }, h("h2", {}, "Notes"), h("ul", {}, ...notes));
}
