// The data a report is made of: the contract between `harpoon demo`, which writes it into the
// template, and this page. Times carry their unit in the name; every time is a wall time unless
// its entry is `modelled`. The shapes are checks and types at once (see check.ts).

import {
  type Checked,
  count,
  date,
  flag,
  list,
  not_negative,
  object,
  one_of,
  positive,
  text,
  with_rule,
} from "./check.ts";

const precision = one_of("f32", "f64");

const machine = object({
  cpu: text,
  cores: count,
  memory_gb: not_negative,
  /** The largest cache; 0 where the machine does not tell. */
  cache_mb: not_negative,
  os: text,
  kernel: text,
  compiler: text,
  /** The widest instruction set the CPU device used, e.g. "AVX2". */
  instruction_set: text,
  /** The ODE measured against: version and precision. */
  ode: text,
  /** Version of Harpoon. */
  harpoon: text,
});

/** One row of the summary table. */
const result = object({
  /** "ode", "cpu", "afu", "cuda" or a device to come. */
  device: text,
  precision,
  threads: count,
  /** Pairs in the batch. */
  count,
  type: one_of("real", "fake", "grazing", "mixed"),
  /** Median over `runs`. */
  ns_per_pair: positive,
  ns_per_pair_min: positive,
  /** True: a time computed from a model of the device; false: a clock was read. */
  modelled: flag,
  /** ODE's ns_per_pair_min on the same pairs over this one; 1 for ODE itself. */
  speedup_vs_ode: not_negative,
  /** Of the fastest run. */
  gb_per_s: not_negative,
  runs: count,
});

/** One batch size of a series; `total_us` is the median over the runs, low and high its spread. */
const point = with_rule(
  object({ count: positive, total_us: positive, total_us_low: positive, total_us_high: positive }),
  (p) =>
    p.total_us_low <= p.total_us && p.total_us <= p.total_us_high
      ? undefined
      : "expected total_us_low <= total_us <= total_us_high",
);

const series = object({
  label: text,
  device: text,
  precision,
  modelled: flag,
  points: list(point),
});

/** A line of constant time per collision taken from elsewhere, e.g. from the paper. */
const reference = object({ label: text, ns_per_pair: positive });

const figure = object({
  /** The paper's number of the figure: "6", "7". */
  id: text,
  title: text,
  series: list(series),
  references: list(reference),
});

/** A world of Figure 4: spheres at the integer points |i|+|j|+|k| <= hmax. */
const diamond = object({
  hmax: count,
  /** Gap between neighbouring spheres, in metres: they stand 2 * radius + dsph apart. */
  dsph: not_negative,
  /** In metres. */
  radius: positive,
  /** The writer's count of spheres, which the page counts again. */
  spheres: count,
});

/** What the paper says, what this run found, and how the two stand to each other. */
const claim = object({ paper: text, ours: text, verdict: text });

/** A number that a reader should leave with; measured or modelled, never both in one. */
const headline = object({ value: text, label: text, detail: text, modelled: flag });

export const report = object({
  schema: one_of(2),
  title: text,
  /** The experiment in a sentence. */
  experiment: text,
  headlines: list(headline),
  machine,
  /** How busy the machine was with other things, in a sentence. */
  load_text: text,
  commit: text,
  date,
  /** The command that repeats the experiment. */
  command: text,
  /** Median cost of reading the clock once; not subtracted from any time here. */
  timer_overhead_ns: not_negative,
  results: list(result),
  figures: list(figure),
  diamonds: list(diamond),
  claims: list(claim),
  notes: list(text),
});

export type Report = Checked<typeof report>;
export type Machine = Report["machine"];
export type Result = Report["results"][number];
export type Figure = Report["figures"][number];
export type Series = Figure["series"][number];
export type Diamond = Report["diamonds"][number];

/** Reads the text of the data element. Throws an Error whose message is fit for the page. */
export function parse_report(json: string): Report {
  let value: unknown;
  try {
    value = JSON.parse(json);
  } catch (error) {
    throw new Error(`The data is not JSON: ${(error as Error).message}`);
  }
  if (value === null) throw new Error("This is the empty template: no data was written into it.");
  return report(value, "");
}
