// A figure's series as the columns a chart draws: one shared list of counts, and beside it the
// median, low and high of each series, then the references. All times in nanoseconds.

import type { Figure } from "./schema.ts";

/** What the y axis shows: the time of the whole batch, or that time over its collisions. */
export type Quantity = "total" | "each";

type Column = (number | null)[];

export interface PlotData {
  readonly counts: number[];
  /** One of each a series, aligned with `counts`; null where the series has no such batch. */
  readonly series: { readonly median: Column; readonly low: Column; readonly high: Column }[];
  readonly references: Column[];
}

export function plot_data(figure: Figure, quantity: Quantity): PlotData {
  const every_count = figure.series.flatMap((series) => series.points.map((point) => point.count));
  const counts = [...new Set(every_count)].sort((a, b) => a - b);
  const series = figure.series.map(({ points }) => {
    const by_count = new Map(points.map((point) => [point.count, point]));
    const column = (key: "total_us" | "total_us_low" | "total_us_high"): Column =>
      counts.map((count) => {
        const point = by_count.get(count);
        return point ? (point[key] * 1000) / (quantity === "each" ? count : 1) : null;
      });
    return {
      median: column("total_us"),
      low: column("total_us_low"),
      high: column("total_us_high"),
    };
  });
  const references = figure.references.map(({ ns_per_pair }) =>
    counts.map((count) => ns_per_pair * (quantity === "each" ? 1 : count)),
  );
  return { counts, series, references };
}
