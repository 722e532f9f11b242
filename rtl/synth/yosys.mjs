// Runs one script in the yosys of the npm package @yowasp/yosys, which lives in a virtual file
// system: the files named after the script are put there, *.rpt files are brought back.
//
//   node yosys.mjs PACKAGE_FOLDER SCRIPT OUTPUT_FOLDER FILE...
import { readFileSync, writeFileSync } from "node:fs";
import { basename, join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [packageFolder, script, outputFolder, ...files] = process.argv.slice(2);
const { runYosys } = await import(
  pathToFileURL(resolve(packageFolder, "@yowasp/yosys/gen/bundle.js")));
const tree = { "script.ys": readFileSync(script, "utf8") };
for (const file of files) tree[basename(file)] = readFileSync(file, "utf8");
const decoder = new TextDecoder();
const print = (bytes) => bytes && process.stderr.write(decoder.decode(bytes));
const out = await runYosys(["-q", "-s", "script.ys"], tree, { stdout: print, stderr: print });
for (const [name, text] of Object.entries(out)) {
  if (name.endsWith(".rpt")) writeFileSync(join(outputFolder, name), text);
}
