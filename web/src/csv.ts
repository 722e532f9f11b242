// The report's data as CSV (RFC 4180: comma, CRLF, quotes doubled), generated in the page.

import type { Figure, Result } from "./schema.ts";

type Cell = string | number | boolean;

function quote(cell: Cell): string {
  const text = String(cell);
  return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

export function to_csv(header: readonly string[], rows: readonly (readonly Cell[])[]): string {
  return [header, ...rows].map((row) => `${row.map(quote).join(",")}\r\n`).join("");
}

const kResultColumns = [
  "device",
  "precision",
  "threads",
  "count",
  "type",
  "ns_per_pair",
  "ns_per_pair_min",
  "modelled",
  "speedup_vs_ode",
  "gb_per_s",
  "runs",
] as const satisfies readonly (keyof Result)[];

export function results_csv(results: readonly Result[]): string {
  return to_csv(
    kResultColumns,
    results.map((result) => kResultColumns.map((column) => result[column])),
  );
}

/** One row a point of each series. References are not data of this run and are left out. */
export function figure_csv(figure: Figure): string {
  const header = ["figure", "label", "device", "precision", "modelled", "count"];
  const times = ["total_us", "total_us_low", "total_us_high"];
  const rows = figure.series.flatMap((series) =>
    series.points.map((point) => [
      figure.id,
      series.label,
      series.device,
      series.precision,
      series.modelled,
      point.count,
      point.total_us,
      point.total_us_low,
      point.total_us_high,
    ]),
  );
  return to_csv([...header, ...times], rows);
}
