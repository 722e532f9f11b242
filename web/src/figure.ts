// Figures 6 and 7: time over the number of collisions, one line a series with its spread as a
// band, the paper's times as labelled grey lines. Drawn by uPlot; this file adds the switches and
// the legend, which shows and hides lines and reads out their values at the pointer or the arrow
// keys (at the largest batch otherwise). Beside the chart, it never covers what is pointed at.

import uPlot from "uplot";
import { type LineStyle, name_key } from "./colours.ts";
import { figure_csv } from "./csv.ts";
import { button, choice, download_button, h, on_resize } from "./dom.ts";
import { three_digits, tick_number, time, type TimeUnit, unit_of, whole } from "./format.ts";
import { plot_data, type PlotData, type Quantity } from "./plot_data.ts";
import type { Figure } from "./schema.ts";
import { is_dark, on_theme_change } from "./theme.ts";
import { is_labelled, log_ticks } from "./ticks.ts";

type Scale = "linear" | "log";

/** A line of the chart and its entry in the legend: a series, or a reference of the paper. */
interface Line {
  readonly label: string;
  readonly modelled: boolean;
  readonly reference: boolean;
  readonly style: LineStyle;
  /** The chart's indices of the line itself and, for a series, of its spread. */
  readonly indices: readonly number[];
  shown: boolean;
  /** Where the legend reads out the line's value and spread. */
  readonly value: HTMLElement;
  readonly spread: HTMLElement;
}

const kReferenceStyle: LineStyle = { light: "#767676", dark: "#9a9a9a", dash: [2, 3] };
const kFont = "12px system-ui, sans-serif";
const kYLabel: Record<Quantity, string> = { total: "total time", each: "time per collision" };

function legend_state(): Pick<Line, "shown" | "value" | "spread"> {
  return {
    shown: true,
    value: h("span", { class: "value" }),
    spread: h("span", { class: "spread" }),
  };
}

function lines_of(figure: Figure, styles: ReadonlyMap<string, LineStyle>): Line[] {
  const series = figure.series.map((s, n) => ({
    label: s.label,
    modelled: s.modelled,
    reference: false,
    style: styles.get(name_key(s)) ?? kReferenceStyle,
    indices: [3 * n + 1, 3 * n + 2, 3 * n + 3],
    ...legend_state(),
  }));
  const references = figure.references.map((r, n) => ({
    label: r.label,
    modelled: false,
    reference: true,
    style: kReferenceStyle,
    indices: [3 * figure.series.length + 1 + n],
    ...legend_state(),
  }));
  return [...series, ...references];
}

const colour_of = (line: Line): string => (is_dark() ? line.style.dark : line.style.light);

function line_sample(line: Line): SVGSVGElement {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
  svg.setAttribute("viewBox", "0 0 28 10");
  svg.setAttribute("class", "sample");
  path.setAttribute("d", "M0 5H28");
  path.setAttribute("stroke-dasharray", line.style.dash.join(" "));
  svg.append(path);
  svg.style.setProperty("--light", line.style.light);
  svg.style.setProperty("--dark", line.style.dark);
  return svg;
}

function line_name(line: Line): string {
  const says_so = line.label.toLowerCase().includes("modelled");
  return line.modelled && !says_so ? `${line.label} (modelled)` : line.label;
}

/** Colours and fonts of both axes, as the style sheet has them. */
function axis_look(style: CSSStyleDeclaration): uPlot.Axis {
  const line = { stroke: style.borderTopColor, width: 1 };
  return {
    stroke: style.color,
    font: kFont,
    labelFont: `600 ${kFont}`,
    labelSize: 20,
    gap: 4,
    grid: line,
    ticks: { ...line, size: 4 },
  };
}

/** What a logarithmic axis adds: its ticks, numbered where `label_pixels` fit. */
function log_axis(label_pixels: number): uPlot.Axis {
  return {
    splits: (_chart, _axis, min, max) => log_ticks(min, max),
    filter: (chart, ticks, axis) => {
      const key = axis === 0 ? "x" : "y";
      const decade = Math.abs(chart.valToPos(10, key) - chart.valToPos(1, key));
      return ticks.map((tick) => (is_labelled(tick, decade, label_pixels) ? tick : null));
    },
  };
}

/** Moves the cursor from the pointer to the nearest batch size. */
function snap_to_batch(chart: uPlot, left: number, top: number): [number, number] {
  const count = left < 0 ? undefined : chart.data[0][chart.posToIdx(left)];
  return [count === undefined ? left : chart.valToPos(count, "x"), top];
}

class FigureChart {
  readonly section: HTMLElement;
  private readonly lines_: Line[];
  private readonly plot_ = h("div", { class: "plot", tabindex: "0", role: "group" });
  private readonly batch_ = h("p", { class: "batch", role: "status" });
  private quantity_: Quantity = "total";
  private x_scale_: Scale = "log";
  private y_scale_: Scale = "log";
  private data_: PlotData;
  private unit_: TimeUnit = unit_of(1);
  private chart_: uPlot | undefined;

  constructor(
    private readonly figure_: Figure,
    styles: ReadonlyMap<string, LineStyle>,
  ) {
    this.lines_ = lines_of(figure_, styles);
    this.data_ = plot_data(figure_, this.quantity_);
    this.plot_.setAttribute(
      "aria-label",
      `Figure ${figure_.id}, a chart. ` +
        "Arrow keys move through the batch sizes, Home and End go to the ends.",
    );
    this.section = this.make_section();
    this.plot_.addEventListener("keydown", (event) => this.move_cursor(event));
    this.plot_.addEventListener("blur", () => this.chart_?.setCursor({ left: -10, top: -10 }));
    on_resize(this.plot_, () => this.chart_?.setSize(this.size()));
    on_theme_change(() => this.draw());
  }

  /** Draws the chart anew; the section must be in the document. */
  draw(): void {
    this.chart_?.destroy();
    this.data_ = plot_data(this.figure_, this.quantity_);
    const spreads = this.data_.series.flatMap((s) => [s.median, s.low, s.high]);
    this.unit_ = this.axis_unit();
    this.chart_ = new uPlot(
      this.options(),
      [this.data_.counts, ...spreads, ...this.data_.references] as uPlot.AlignedData,
      this.plot_,
    );
    this.show_values(this.chart_);
  }

  private make_section(): HTMLElement {
    const { id, title } = this.figure_;
    const scales = { log: "log", linear: "linear" };
    const redraw_with =
      <T>(set: (value: T) => void) =>
      (value: T): void => {
        set(value);
        this.draw();
      };
    const switches = h(
      "div",
      { class: "switches" },
      choice(
        "y shows",
        { total: "total time", each: "time per collision" },
        this.quantity_,
        redraw_with((value) => (this.quantity_ = value)),
      ),
      choice(
        "y axis",
        scales,
        this.y_scale_,
        redraw_with((value) => (this.y_scale_ = value)),
      ),
      choice(
        "x axis",
        scales,
        this.x_scale_,
        redraw_with((value) => (this.x_scale_ = value)),
      ),
    );
    const entries = this.lines_.map((line) => this.legend_entry(line));
    const hint =
      "Point at the chart, or focus it and use the arrow keys, for values. " +
      "Drag to zoom, double-click to go back. Bands show the spread of the runs.";
    return h(
      "section",
      { class: "figure", id: `figure-${id}`, "data-figure": id },
      h("h2", {}, `Figure ${id}. ${title}`),
      switches,
      h(
        "div",
        { class: "chart" },
        this.plot_,
        h("div", { class: "legend" }, this.batch_, h("ul", {}, ...entries)),
      ),
      h(
        "div",
        { class: "below" },
        h("p", { class: "hint" }, hint),
        download_button("Data as CSV", `harpoon-figure-${id}.csv`, () => figure_csv(this.figure_)),
      ),
    );
  }

  private legend_entry(line: Line): HTMLElement {
    const toggle = button(
      "",
      () => {
        line.shown = !line.shown;
        toggle.setAttribute("aria-pressed", String(line.shown));
        this.chart_?.batch(() => {
          for (const index of line.indices) this.chart_?.setSeries(index, { show: line.shown });
        });
      },
      "legend-entry",
    );
    toggle.setAttribute("aria-pressed", "true");
    toggle.append(
      line_sample(line),
      h("span", { class: "name" }, line_name(line)),
      line.value,
      line.spread,
    );
    return h("li", {}, toggle);
  }

  private size(): { width: number; height: number } {
    const width = Math.max(260, this.plot_.clientWidth);
    return { width, height: Math.round(Math.min(440, Math.max(320, width * 0.5))) };
  }

  /** The unit of the y axis: that of the largest time, or on a log axis of the middle. */
  private axis_unit(): TimeUnit {
    const { series, references } = this.data_;
    const times = [...series.flatMap((s) => s.median), ...references.flat()].filter(
      (t) => t !== null,
    );
    const largest = Math.max(...times, 1);
    return unit_of(this.y_scale_ === "linear" ? largest : Math.sqrt(largest * Math.min(...times)));
  }

  private options(): uPlot.Options {
    const style = getComputedStyle(this.plot_);
    const bands = this.lines_
      .filter((line) => !line.reference)
      .map((line) => ({
        series: [line.indices[2], line.indices[1]] as [number, number],
        fill: `${colour_of(line)}33`,
      }));
    return {
      ...this.size(),
      legend: { show: false },
      padding: [12, 24, 4, 0],
      scales: { x: this.x_axis_scale(), y: this.y_axis_scale() },
      axes: [this.x_axis(style), this.y_axis(style)],
      series: [{}, ...this.lines_.flatMap((line) => this.series_options(line))],
      bands,
      cursor: { y: false, drag: { x: true, y: false }, points: { size: 7 }, move: snap_to_batch },
      hooks: {
        draw: [(chart) => this.draw_reference_labels(chart, style.backgroundColor)],
        setCursor: [(chart) => this.show_values(chart)],
      },
    };
  }

  private x_axis(style: CSSStyleDeclaration): uPlot.Axis {
    return {
      ...axis_look(style),
      ...(this.x_scale_ === "log" ? log_axis(60) : { space: 70 }),
      label: "number of collisions",
      size: 30,
      values: (_, ticks) => ticks.map((tick) => (tick === null ? "" : whole(tick))),
    };
  }

  private y_axis(style: CSSStyleDeclaration): uPlot.Axis {
    return {
      ...axis_look(style),
      ...(this.y_scale_ === "log" ? log_axis(20) : { space: 40 }),
      label: `${kYLabel[this.quantity_]}, ${this.unit_.name}`,
      size: (_, labels) => 14 + 7 * Math.max(1, ...(labels ?? []).map((label) => label.length)),
      values: (_, ticks) =>
        ticks.map((tick) => (tick === null ? "" : tick_number(tick, this.unit_))),
    };
  }

  /** Without data, when every line is hidden, uPlot asks with null: any valid range will do. */
  private x_axis_scale(): uPlot.Scale {
    const log = this.x_scale_ === "log";
    const range = (min: number | null, max: number | null): [number, number] => {
      if (min === null || max === null) return [1, 10];
      if (log) return min < max ? [min, max] : [min / 2, min * 2];
      return [min === this.data_.counts[0] ? 0 : min, max];
    };
    return { time: false, distr: log ? 3 : 1, range: (_, min, max) => range(min, max) };
  }

  private y_axis_scale(): uPlot.Scale {
    const log = this.y_scale_ === "log";
    const range = (min: number | null, max: number | null): [number, number] => {
      if (min === null || max === null) return [1, 10];
      return log ? [min * 0.8, max * 1.9] : [0, max * 1.12];
    };
    return { distr: log ? 3 : 1, range: (_, min, max) => range(min, max) };
  }

  /** The line itself, and for a series the two invisible edges of its band. */
  private series_options(line: Line): uPlot.Series[] {
    const common: uPlot.Series = { show: line.shown, spanGaps: true };
    const edge: uPlot.Series = { ...common, width: 0, points: { show: false } };
    const drawn: uPlot.Series = {
      ...common,
      label: line.label,
      stroke: colour_of(line),
      width: line.reference ? 1.5 : 2,
      dash: line.style.dash,
      points: {
        show: !line.reference && this.data_.counts.length < 30,
        size: 5,
        fill: colour_of(line),
      },
    };
    return line.reference ? [drawn] : [drawn, edge, edge];
  }

  /** Writes each shown reference's label along the right end of its line, the first one above. */
  private draw_reference_labels(chart: uPlot, background: string): void {
    const { ctx } = chart;
    const ratio = devicePixelRatio;
    const right = chart.bbox.left + chart.bbox.width - 8 * ratio;
    const left = right - 120 * ratio;
    const shown = this.lines_.filter((line) => line.reference && line.shown);
    ctx.save();
    ctx.beginPath();
    ctx.rect(chart.bbox.left, chart.bbox.top, chart.bbox.width, chart.bbox.height);
    ctx.clip();
    ctx.font = `${12 * ratio}px system-ui, sans-serif`;
    ctx.textAlign = "right";
    ctx.lineWidth = 4 * ratio;
    ctx.lineJoin = "round";
    ctx.strokeStyle = background;
    shown.forEach((line, n) => {
      const y_at = (x: number): number => this.reference_y(chart, line, x);
      ctx.save();
      ctx.translate(right, y_at(right));
      ctx.rotate(Math.atan2(y_at(right) - y_at(left), right - left));
      ctx.fillStyle = colour_of(line);
      ctx.textBaseline = n === 0 ? "bottom" : "top";
      ctx.strokeText(line.label, 0, (n === 0 ? -3 : 4) * ratio);
      ctx.fillText(line.label, 0, (n === 0 ? -3 : 4) * ratio);
      ctx.restore();
    });
    ctx.restore();
  }

  /** Where the reference's line is at canvas pixel `x`, in canvas pixels. */
  private reference_y(chart: uPlot, line: Line, x: number): number {
    const reference =
      this.figure_.references[(line.indices[0] ?? 0) - 3 * this.figure_.series.length - 1];
    const count = chart.posToVal(x, "x", true);
    const ns = (reference?.ns_per_pair ?? 0) * (this.quantity_ === "each" ? 1 : count);
    return chart.valToPos(ns, "y", true);
  }

  private move_cursor(event: KeyboardEvent): void {
    const chart = this.chart_;
    const last = this.data_.counts.length - 1;
    if (!chart || last < 0) return;
    const now = chart.cursor.idx ?? -1;
    const next = {
      ArrowLeft: Math.max(0, now - 1),
      ArrowRight: Math.min(last, now + 1),
      Home: 0,
      End: last,
    }[event.key];
    if (next === undefined) return;
    event.preventDefault();
    const left = chart.valToPos(this.data_.counts[next] ?? 0, "x");
    chart.setCursor({ left, top: chart.over.clientHeight / 2 });
  }

  /** Reads out every line at the cursor, or at the largest batch when the cursor has left. */
  private show_values(chart: uPlot): void {
    const { idx, left = -1 } = chart.cursor;
    const pointed_at = left >= 0 && idx !== null && idx !== undefined;
    const at = pointed_at ? idx : this.data_.counts.length - 1;
    this.batch_.textContent = `at ${whole(this.data_.counts[at] ?? 0)} collisions`;
    for (const line of this.lines_) {
      const [value, low, high] = line.indices.map((index) => chart.data[index]?.[at] ?? undefined);
      line.value.textContent = value === undefined ? "no such batch" : time(value);
      const unit = unit_of(high ?? 0);
      const spread =
        low && high && low < high ? `${three_digits(low / unit.ns)} – ${time(high, unit)}` : "";
      line.spread.textContent = spread;
    }
  }
}

/** The section of one figure, and the call that draws its chart once it is in the document. */
export function make_figure(
  figure: Figure,
  styles: ReadonlyMap<string, LineStyle>,
): { section: HTMLElement; draw: () => void } {
  const chart = new FigureChart(figure, styles);
  return { section: chart.section, draw: () => chart.draw() };
}
