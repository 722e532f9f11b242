import assert from "node:assert/strict";
import { test } from "node:test";
import { parse_report } from "../../src/schema.ts";
import { sample } from "../template.ts";

type Path = readonly (string | number)[];

/** The sample with the value at `path` replaced, or removed when `value` is undefined. */
function sample_with(path: Path, value: unknown): string {
  const data = sample();
  let at = data as Record<string | number, unknown>;
  for (const key of path.slice(0, -1)) at = at[key] as Record<string | number, unknown>;
  const last = path[path.length - 1] as string | number;
  if (value === undefined) delete at[last];
  else at[last] = value;
  return JSON.stringify(data);
}

function every_field(value: unknown, path: Path = []): Path[] {
  if (Array.isArray(value)) return value.slice(0, 1).flatMap((v) => every_field(v, [...path, 0]));
  if (typeof value !== "object" || value === null) return [path];
  const inner = Object.entries(value).flatMap(([key, v]) => every_field(v, [...path, key]));
  return path.length ? [path, ...inner] : inner;
}

const written = (path: Path): string =>
  path
    .map((key) => (typeof key === "number" ? `[${key}]` : `.${key}`))
    .join("")
    .slice(1);

test("the sample is accepted whole", () => {
  assert.deepEqual(parse_report(JSON.stringify(sample())), sample());
});

test("every missing or mistyped field is refused by name", () => {
  const paths = every_field(sample()).filter((path) => typeof path.at(-1) === "string");
  assert.equal(paths.length, 53);
  for (const path of paths) {
    for (const wrong of [undefined, null, [[]]]) {
      assert.throws(
        () => parse_report(sample_with(path, wrong)),
        (error: Error) => error.message.startsWith(written(path)),
        `${written(path)} = ${JSON.stringify(wrong)}`,
      );
    }
  }
});

test("messages say what was expected and what came", () => {
  const message_of = (json: string): string => {
    try {
      parse_report(json);
    } catch (error) {
      return (error as Error).message;
    }
    return "accepted";
  };
  const cases: [string, string][] = [
    [
      sample_with(["results", 3, "ns_per_pair"], 0),
      "results[3].ns_per_pair: expected a number above 0, got 0",
    ],
    [
      sample_with(["results", 0, "type"], "odd"),
      'results[0].type: expected "real" or "fake" or "grazing" or "mixed", got "odd"',
    ],
    [sample_with(["schema"], 1), "schema: expected 2, got 1"],
    [sample_with(["commit"], undefined), "commit: expected text, it is missing"],
    [sample_with(["date"], "yesterday"), 'date: expected an ISO 8601 date, got "yesterday"'],
    [
      sample_with(["figures", 0, "series", 1, "points", 2, "total_us_low"], 1e9),
      "figures[0].series[1].points[2]: expected total_us_low <= total_us <= total_us_high",
    ],
    ["null", "This is the empty template: no data was written into it."],
    ["[]", "the data: expected an object, got []"],
  ];
  for (const [json, message] of cases) assert.equal(message_of(json), message);
  assert.match(message_of("{"), /^The data is not JSON: /);
});

test("devices, figures and fields to come are accepted", () => {
  assert.doesNotThrow(() => parse_report(sample_with(["results", 0, "device"], "quantum")));
  assert.doesNotThrow(() => parse_report(sample_with(["figures", 0, "id"], "12")));
  assert.doesNotThrow(() => parse_report(sample_with(["later"], { field: 1 })));
});
