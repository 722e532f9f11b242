// A few combinators that check a JSON value against a shape and name the first field that does not
// fit. The type of the checked value is inferred from the shape, so that type and check are one.

/** Thrown by a check; `path` is the field as a person would write it: `results[3].ns_per_pair`. */
export class FieldError extends Error {
  constructor(
    readonly path: string,
    problem: string,
  ) {
    super(`${path || "the data"}: ${problem}`);
    this.name = "FieldError";
  }
}

export type Check<T> = (value: unknown, path: string) => T;
export type Checked<C> = C extends Check<infer T> ? T : never;

function describe(value: unknown): string {
  if (value === undefined) return "it is missing";
  const text = JSON.stringify(value) ?? String(value);
  return `got ${text.length > 40 ? `${text.slice(0, 40)}…` : text}`;
}

function scalar<T>(expected: string, accepts: (value: unknown) => value is T): Check<T> {
  return (value, path) => {
    if (accepts(value)) return value;
    throw new FieldError(path, `expected ${expected}, ${describe(value)}`);
  };
}

const is_number = (value: unknown): value is number =>
  typeof value === "number" && Number.isFinite(value);

export const text = scalar("text", (v): v is string => typeof v === "string");
export const flag = scalar("true or false", (v): v is boolean => typeof v === "boolean");
export const positive = scalar("a number above 0", (v): v is number => is_number(v) && v > 0);
export const not_negative = scalar(
  "a number, at least 0",
  (v): v is number => is_number(v) && v >= 0,
);
export const count = scalar(
  "a whole number, at least 0",
  (v): v is number => Number.isSafeInteger(v) && (v as number) >= 0,
);
export const date = scalar(
  "an ISO 8601 date",
  (v): v is string =>
    typeof v === "string" && /^\d{4}-\d\d-\d\d/.test(v) && !Number.isNaN(Date.parse(v)),
);

export function one_of<const T extends string | number>(...values: T[]): Check<T> {
  const list = values.map((value) => JSON.stringify(value)).join(" or ");
  return scalar(list, (v): v is T => (values as unknown[]).includes(v));
}

export function list<T>(item: Check<T>): Check<T[]> {
  return (value, path) => {
    if (!Array.isArray(value)) throw new FieldError(path, `expected a list, ${describe(value)}`);
    return value.map((entry, index) => item(entry, `${path}[${index}]`));
  };
}

/** Fields that the shape does not name are ignored, so that later writers may add some. */
export function object<S extends Record<string, Check<unknown>>>(
  shape: S,
): Check<{ [K in keyof S]: Checked<S[K]> }> {
  return (value, path) => {
    if (typeof value !== "object" || value === null || Array.isArray(value)) {
      throw new FieldError(path, `expected an object, ${describe(value)}`);
    }
    const fields = value as Record<string, unknown>;
    const result = Object.entries(shape).map(([key, check]) => [
      key,
      check(fields[key], path ? `${path}.${key}` : key),
    ]);
    return Object.fromEntries(result) as { [K in keyof S]: Checked<S[K]> };
  };
}

/** Adds a rule over several fields to a check; `rule` returns what is wrong, or nothing. */
export function with_rule<T>(check: Check<T>, rule: (value: T) => string | undefined): Check<T> {
  return (value, path) => {
    const checked = check(value, path);
    const problem = rule(checked);
    if (problem !== undefined) throw new FieldError(path, problem);
    return checked;
  };
}
