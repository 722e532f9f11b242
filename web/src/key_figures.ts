// The few numbers a reader should leave with, taken from the results and the figures. Modelled
// numbers are never mixed into a measured one: each key figure is one or the other and says so.

import { three_digits, time, whole } from "./format.ts";
import type { Figure, Report, Result } from "./schema.ts";

export interface KeyFigure {
  readonly value: string;
  readonly label: string;
  readonly detail: string;
  readonly modelled: boolean;
}

function best(results: readonly Result[], score: (result: Result) => number): Result | undefined {
  return results.reduce<Result | undefined>(
    (top, result) => (top === undefined || score(result) > score(top) ? result : top),
    undefined,
  );
}

const batch_of = (r: Result): string => `${whole(r.count)} ${r.type} collisions`;
const device_of = (r: Result): string => `${r.device} ${r.precision}`;

function speedup(r: Result | undefined, label: string): KeyFigure | undefined {
  if (!r) return undefined;
  const ode_ns = r.ns_per_pair * r.speedup_vs_ode;
  return {
    value: `${three_digits(r.speedup_vs_ode)}×`,
    label,
    detail: `${device_of(r)}, ${batch_of(r)}: ${time(r.ns_per_pair)} against ODE's ${time(ode_ns)}`,
    modelled: r.modelled,
  };
}

function bandwidth(r: Result | undefined): KeyFigure | undefined {
  if (!r || r.gb_per_s === 0) return undefined;
  const threads = `${r.threads} thread${r.threads === 1 ? "" : "s"}`;
  return {
    value: `${three_digits(r.gb_per_s)} GB/s`,
    label: "highest throughput of records",
    detail: `${device_of(r)}, ${threads}, ${batch_of(r)}`,
    modelled: r.modelled,
  };
}

/** The smallest count from which `figure`'s fastest measured series never again exceeds ODE. */
export function break_even(
  figure: Figure,
): { count: number; label: string; at_start: boolean } | undefined {
  const ode = figure.series.find((series) => series.device === "ode" && !series.modelled);
  if (!ode) return undefined;
  const ode_us = new Map(ode.points.map((point) => [point.count, point.total_us]));
  const found = figure.series
    .filter((series) => series.device !== "ode" && !series.modelled)
    .map(({ label, points }) => {
      const common = points.filter((p) => ode_us.has(p.count)).sort((a, b) => a.count - b.count);
      const last_slower = common.findLastIndex((p) => p.total_us > (ode_us.get(p.count) ?? 0));
      return {
        count: common[last_slower + 1]?.count ?? Infinity,
        label,
        at_start: last_slower < 0,
      };
    });
  found.sort((a, b) => a.count - b.count);
  return found[0] && Number.isFinite(found[0].count) ? found[0] : undefined;
}

function break_even_figure(figures: readonly Figure[]): KeyFigure | undefined {
  const figure = figures[0];
  const found = figure && break_even(figure);
  if (!figure || !found) return undefined;
  const detail = found.at_start
    ? `${found.label} takes no longer than ODE from the smallest batch of Figure ${figure.id} on`
    : `${found.label} takes no longer than ODE from this batch of Figure ${figure.id} on`;
  const value = `${found.at_start ? "≤ " : ""}${whole(found.count)}`;
  return { value, label: "collisions to break even with ODE", detail, modelled: false };
}

export function key_figures(report: Report): KeyFigure[] {
  const ours = report.results.filter((r) => r.device !== "ode");
  const measured = ours.filter((r) => !r.modelled);
  const by_speedup = (r: Result): number => r.speedup_vs_ode;
  const single = measured.filter((r) => r.threads === 1);
  const several = measured.filter((r) => r.threads > 1);
  const modelled = ours.filter((r) => r.modelled);
  return [
    speedup(best(single, by_speedup), "faster than ODE on one thread"),
    speedup(
      best(several, by_speedup),
      `faster than ODE on ${best(several, by_speedup)?.threads} threads`,
    ),
    break_even_figure(report.figures),
    bandwidth(best(measured, (r) => r.gb_per_s)),
    speedup(best(modelled, by_speedup), "faster than ODE, modelled"),
  ].filter((figure) => figure !== undefined);
}
