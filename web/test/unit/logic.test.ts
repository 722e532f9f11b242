import assert from "node:assert/strict";
import { test } from "node:test";
import { assign_styles, name_key, type SeriesName } from "../../src/colours.ts";
import { figure_csv, results_csv, to_csv } from "../../src/csv.ts";
import { three_digits, tick_number, time, unit_of, whole } from "../../src/format.ts";
import { count_points, diamond_points } from "../../src/lattice.ts";
import { plot_data } from "../../src/plot_data.ts";
import { type Figure, parse_report } from "../../src/schema.ts";
import { is_labelled, log_ticks } from "../../src/ticks.ts";
import { sample } from "../template.ts";

const report = parse_report(JSON.stringify(sample()));

test("a diamond has the octahedral number of points, each within reach and none twice", () => {
  for (const hmax of [0, 1, 2, 3, 10, 30]) {
    const expected = ((2 * hmax + 1) * (2 * hmax * hmax + 2 * hmax + 3)) / 3;
    const points = diamond_points(hmax);
    assert.equal(count_points(hmax), expected);
    assert.equal(new Set(points.map(String)).size, expected);
    assert.ok(
      points.every((point) => point.reduce((sum, index) => sum + Math.abs(index), 0) <= hmax),
    );
  }
});

test("measured and modelled series never share a colour, however many there are", () => {
  const names: SeriesName[] = [];
  for (let n = 0; n < 20; ++n) {
    for (const device of ["ode", "cpu", "afu", "cuda", `device ${n}`]) {
      for (const precision of ["f32", "f64"]) {
        for (const modelled of [false, true])
          names.push({ label: `series ${n}`, device, precision, modelled });
      }
    }
  }
  const styles = assign_styles(names);
  assert.equal(styles.size, names.length);
  for (const theme of ["light", "dark"] as const) {
    const colours = (modelled: boolean): Set<string> =>
      new Set(
        names
          .filter((n) => n.modelled === modelled)
          .map((n) => styles.get(name_key(n))?.[theme] ?? ""),
      );
    const measured = colours(false);
    assert.ok(
      [...colours(true)].every((colour) => /^#[0-9a-f]{6}$/.test(colour) && !measured.has(colour)),
    );
  }
  for (const name of names)
    assert.equal((styles.get(name_key(name))?.dash.length ?? 0) > 0, name.modelled);
});

test("the series of a report have each a colour of its own, the same in every figure", () => {
  const names = report.figures.flatMap((figure) => figure.series);
  const styles = assign_styles(names);
  assert.equal(styles.size, 5);
  assert.equal(new Set([...styles.values()].map((style) => style.light)).size, 5);
  assert.deepEqual(assign_styles([...names].reverse()), styles);
  const twins = [1, 2].map((n) => ({
    label: `${n} threads`,
    device: "cpu",
    precision: "f32",
    modelled: false,
  }));
  const [one, two] = [...assign_styles(twins).values()];
  assert.notEqual(one?.light, two?.light);
});

test("CSV quotes what needs it and keeps every digit", () => {
  assert.equal(
    to_csv(
      ["a", "b"],
      [
        ['say "hi"', 1.25],
        ["x,y\nz", true],
      ],
    ),
    'a,b\r\n"say ""hi""",1.25\r\n"x,y\nz",true\r\n',
  );
  const rows = results_csv(report.results).trimEnd().split("\r\n");
  assert.equal(rows.length, report.results.length + 1);
  assert.equal(rows[2], "cpu,f32,1,1000,real,1.06,1.018,false,9.717,60.377,31");
  const figure = report.figures[0] as Figure;
  const points = figure_csv(figure).trimEnd().split("\r\n");
  assert.equal(
    points.length,
    1 + figure.series.reduce((sum, series) => sum + series.points.length, 0),
  );
  assert.match(points[1] ?? "", /^6,"ODE, one call a pair",ode,f64,false,10,0\.\d+,0\.\d+,0\.\d+$/);
});

test("times carry the unit a person would choose", () => {
  const times = [0.5, 1.06, 999.4, 999.6, 6400, 1e6, 2.5e9].map((ns) => time(ns));
  assert.deepEqual(times, [
    "0.500 ns",
    "1.06 ns",
    "999 ns",
    "1.00 µs",
    "6.40 µs",
    "1.00 ms",
    "2.50 s",
  ]);
  assert.deepEqual([0, 0.1064, 12.345, 4560.4, 37881].map(three_digits), [
    "0",
    "0.106",
    "12.3",
    "4,560",
    "37,881",
  ]);
  assert.equal(whole(90000), "90,000");
  assert.deepEqual(
    [0, 50, 1500, 0.1].map((ns) => tick_number(ns, unit_of(1000))),
    ["0", "0.05", "1.5", "0.0001"],
  );
});

test("logarithmic ticks lie in range, powers of ten numbered, 2 and 5 where there is room", () => {
  assert.deepEqual(log_ticks(0.8, 20), [0.8, 0.9, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 20]);
  assert.deepEqual(log_ticks(0.5, 5e6), [1, 10, 100, 1000, 10000, 100000, 1000000]);
  const labelled = (decade: number): number[] =>
    log_ticks(1, 10).filter((tick) => is_labelled(tick, decade, 60));
  assert.deepEqual(labelled(300), [1, 2, 5, 10]);
  assert.deepEqual(labelled(100), [1, 10]);
});

function figure_of(counts: number[], ode_us: number[], ours_us: number[]): Figure {
  const points = (times: number[]): Figure["series"][number]["points"] =>
    times.map((us, n) => ({
      count: counts[n] ?? 0,
      total_us: us,
      total_us_low: us,
      total_us_high: us,
    }));
  const common = { precision: "f32", modelled: false } as const;
  const series = [
    { ...common, label: "ODE", device: "ode", points: points(ode_us) },
    { ...common, label: "ours", device: "afu", points: points(ours_us) },
  ];
  return { id: "6", title: "", series, references: [{ label: "paper", ns_per_pair: 86 }] };
}

test("plot data aligns series over all counts, in total and per collision", () => {
  const figure = figure_of([10, 20], [1, 2], [4]);
  assert.deepEqual(plot_data(figure, "total").counts, [10, 20]);
  assert.deepEqual(
    plot_data(figure, "total").series.map((s) => s.median),
    [
      [1000, 2000],
      [4000, null],
    ],
  );
  assert.deepEqual(
    plot_data(figure, "each").series.map((s) => s.high),
    [
      [100, 100],
      [400, null],
    ],
  );
  assert.deepEqual(plot_data(figure, "total").references, [[860, 1720]]);
  assert.deepEqual(plot_data(figure, "each").references, [[86, 86]]);
});
