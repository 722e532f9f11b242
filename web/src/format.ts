// Numbers as a person reads them: three significant digits, thousands grouped, units attached.

const kTimeUnits = [
  { name: "s", ns: 1e9 },
  { name: "ms", ns: 1e6 },
  { name: "µs", ns: 1e3 },
  { name: "ns", ns: 1 },
] as const;

export type TimeUnit = (typeof kTimeUnits)[number];

/** The largest unit in which `ns` is at least 1. */
export function unit_of(ns: number): TimeUnit {
  return kTimeUnits.find((unit) => ns >= unit.ns * 0.9995) ?? kTimeUnits[3];
}

/** A whole number with its thousands grouped: 90,000. */
export function whole(value: number): string {
  return Math.round(value).toLocaleString("en-US");
}

/** Three significant digits, never an exponent, whole numbers whole: 0.106, 1.06, 12.3, 4,560. */
export function three_digits(value: number): string {
  if (value === 0) return "0";
  return value.toLocaleString("en-US", {
    minimumSignificantDigits: Math.abs(value) >= 1000 ? 1 : 3,
    maximumSignificantDigits: Math.max(3, Math.floor(Math.log10(Math.abs(value))) + 1),
  });
}

/** A time with its unit: 1.06 ns, 6.40 µs. */
export function time(ns: number, unit: TimeUnit = unit_of(ns)): string {
  return `${three_digits(ns / unit.ns)} ${unit.name}`;
}

/** A time on an axis that names the unit: as few digits as it needs, 0 included. */
export function tick_number(ns: number, unit: TimeUnit): string {
  return Number((ns / unit.ns).toPrecision(6)).toLocaleString("en-US", {
    maximumFractionDigits: 6,
  });
}
