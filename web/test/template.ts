// Fills the template as the C++ side does: the marker's `null` becomes the JSON, `<` escaped.

import { readFileSync } from "node:fs";

const kMarker = '<script type="application/json" id="harpoon-data">null</script>';

export function fill(data: unknown): string {
  const template = readFileSync("dist/report.template.html", "utf8");
  if (template.split(kMarker).length !== 2)
    throw new Error("the template must hold its marker once");
  const json = JSON.stringify(data).replaceAll("<", "\\u003c");
  return template.replace(kMarker, () => kMarker.replace("null", () => json));
}

/** The data inside a filled report. */
export function data_of(page: string): unknown {
  const found = /<script type="application\/json" id="harpoon-data">(.*?)<\/script>/s.exec(page);
  if (!found?.[1]) throw new Error("the report holds no data");
  return JSON.parse(found[1]);
}

export function sample(): unknown {
  return JSON.parse(readFileSync("test/sample.json", "utf8"));
}
