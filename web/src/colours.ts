// The line style of every series on the page. Measured and modelled series draw from two palettes
// without a common colour, and modelled ones are dashed besides: nobody can take one for the
// other. Within a palette the colours differ in lightness too, for colour-blind readers. A series
// keeps its style in every figure.

export interface SeriesName {
  readonly label: string;
  readonly device: string;
  readonly precision: string;
  readonly modelled: boolean;
}

export interface LineStyle {
  readonly light: string;
  readonly dark: string;
  /** Canvas dash pattern in pixels; empty is a solid line. */
  readonly dash: number[];
}

interface Colour {
  readonly light: string;
  readonly dark: string;
  /** The series this colour is kept for, as "device precision". */
  readonly of?: string;
}

const kMeasured: readonly Colour[] = [
  { light: "#d55e00", dark: "#f08a4b", of: "ode f64" },
  { light: "#005a9c", dark: "#4c9be8", of: "cpu f32" },
  { light: "#3b95cc", dark: "#a5d0f7", of: "cpu f64" },
  { light: "#00735c", dark: "#2bb591", of: "cuda f32" },
  { light: "#2a9d7c", dark: "#8fe0c8", of: "cuda f64" },
  { light: "#8c510a", dark: "#c99a5b" },
  { light: "#b58900", dark: "#e8d28a" },
];

const kModelled: readonly Colour[] = [
  { light: "#c51b7d", dark: "#f06bb0", of: "afu f32" },
  { light: "#7a0177", dark: "#c77dff" },
  { light: "#e06aa5", dark: "#f9b5d6" },
  { light: "#9e5fb0", dark: "#e0c3f0" },
];

const kModelledDash = [7, 4];

export function name_key(name: SeriesName): string {
  return JSON.stringify([name.label, name.device, name.precision, name.modelled]);
}

/** Darkens a colour: used, up to twice, where there are more series than colours. */
function darken(hex: string, times: number): string {
  const channels = [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16) * 0.75 ** times);
  return `#${channels.map((c) => Math.round(c).toString(16).padStart(2, "0")).join("")}`;
}

function nth_colour(palette: readonly Colour[], index: number): Colour {
  const colour = palette[index % palette.length] as Colour;
  const times = Math.floor(index / palette.length) % 3;
  return { light: darken(colour.light, times), dark: darken(colour.dark, times) };
}

/** First whoever a colour is kept for, then the rest in order over what is left. */
function assign_palette(
  names: readonly SeriesName[],
  palette: readonly Colour[],
  dash: number[],
): [string, LineStyle][] {
  const slots = new Map<string, number>();
  const taken = new Set<number>();
  const take = (name: SeriesName, slot: number): void => {
    slots.set(name_key(name), slot);
    taken.add(slot);
  };
  for (const name of names) {
    const slot = palette.findIndex((colour) => colour.of === `${name.device} ${name.precision}`);
    if (slot >= 0 && !taken.has(slot)) take(name, slot);
  }
  const free = palette.map((_, slot) => slot).filter((slot) => !taken.has(slot));
  const order = [
    ...free.filter((slot) => palette[slot]?.of === undefined),
    ...free.filter((slot) => palette[slot]?.of !== undefined),
  ];
  let beyond = palette.length;
  for (const name of names) {
    if (!slots.has(name_key(name))) take(name, order.shift() ?? beyond++);
  }
  return [...slots].map(([key, slot]) => {
    const { light, dark } = nth_colour(palette, slot);
    return [key, { light, dark, dash }];
  });
}

/** The style of each series, by `name_key`. */
export function assign_styles(names: readonly SeriesName[]): Map<string, LineStyle> {
  const unique = [...new Map(names.map((name) => [name_key(name), name])).values()];
  return new Map([
    ...assign_palette(
      unique.filter((name) => !name.modelled),
      kMeasured,
      [],
    ),
    ...assign_palette(
      unique.filter((name) => name.modelled),
      kModelled,
      kModelledDash,
    ),
  ]);
}
