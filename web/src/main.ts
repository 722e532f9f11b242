// The page: reads the data written into it, checks it, and draws the report. Whatever goes wrong
// is said on the page.

import { assign_styles } from "./colours.ts";
import { make_diamond } from "./diamond.ts";
import { h } from "./dom.ts";
import { make_figure } from "./figure.ts";
import { parse_report, type Report } from "./schema.ts";
import {
  claims_section,
  header,
  machine_section,
  notes_section,
  results_section,
} from "./sections.ts";
import { follow_system_and_printer } from "./theme.ts";

function diamonds_section(report: Report): { section: HTMLElement | undefined; draw: () => void } {
  const diamonds = report.diamonds.map(make_diamond);
  if (diamonds.length === 0) return { section: undefined, draw: () => undefined };
  const hint =
    "Drag to turn, or focus one and use arrow keys, + and -, the wheel. Inner layers are darker.";
  const section = h(
    "section",
    { id: "figure-4" },
    h("h2", {}, "Figure 4. The diamonds"),
    h("div", { class: "diamonds" }, ...diamonds.map(({ figure }) => figure)),
    h("p", { class: "hint" }, hint),
  );
  return { section, draw: () => diamonds.forEach(({ draw }) => draw()) };
}

function show(report: Report): void {
  document.title = report.title;
  const styles = assign_styles(report.figures.flatMap((figure) => figure.series));
  const figures = report.figures.map((figure) => make_figure(figure, styles));
  const diamonds = diamonds_section(report);
  const parts = [
    header(report),
    results_section(report),
    claims_section(report),
    ...figures.map(({ section }) => section),
    diamonds.section,
    machine_section(report),
    notes_section(report),
  ];
  document.body.replaceChildren(h("main", {}, ...parts));
  follow_system_and_printer();
  for (const { draw } of figures) draw();
  diamonds.draw();
}

function show_problem(problem: unknown): void {
  const message = problem instanceof Error ? problem.message : String(problem);
  const box = h(
    "div",
    { class: "problem", role: "alert" },
    h("h1", {}, "This report cannot be shown"),
    h("p", {}, message),
    h("p", { class: "soft" }, "Make the report anew with harpoon demo."),
  );
  document.body.prepend(h("main", {}, box));
}

addEventListener("error", (event) => show_problem(event.error ?? event.message));
try {
  show(parse_report(document.getElementById("harpoon-data")?.textContent ?? ""));
} catch (problem) {
  show_problem(problem);
}
