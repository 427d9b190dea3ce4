// Every formula of docs/ and of generated documents renders, as GitHub reads them: formulas_test.mjs FILE.md...
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import katex from "katex";
import { formulasOf, lostBackslashes } from "./formulas.mjs";

const files = (process.env.DOCUMENTS ?? "").split("\n").filter(Boolean);

test("formulas are found in each of their forms, and what Markdown takes away is noticed", () => {
  const latex = (text) => formulasOf(text).map((one) => one.latex ?? `stray ${one.stray}`);
  assert.deepEqual(latex("a $`\\{x\\}`$ and $y_1$, `$z$`"), ["\\{x\\}", "y_1"]);
  assert.deepEqual(latex("| $`a`$ |\n| - |\n| $b$ |"), ["a", "b"]);
  assert.deepEqual(latex("```math\nx^2\n```"), ["x^2"]);
  assert.deepEqual(latex("$\\{x\\}$"), ["{x}"]); // the braces are lost
  assert.equal(lostBackslashes("$\\{x\\}$ $`\\{x\\}`$ `$\\{$`").length, 1);
  assert.match(latex("$a_*b*_c$")[0], /^stray/);
});

test("there are documents", () => assert.ok(files.length > 20, `${files.length} documents`));

for (const file of files) {
  test(file, () => {
    const markdown = readFileSync(file, "utf8");
    const wrong = lostBackslashes(markdown).map(({ latex, line }) => `line ${line}: loses a backslash: ${latex}`);
    for (const { latex, stray, line, display } of formulasOf(markdown)) {
      if (stray !== undefined) {
        wrong.push(`line ${line}: a dollar that is no formula: ${stray}`);
        continue;
      }
      try {
        katex.renderToString(latex, { displayMode: display, throwOnError: true, strict: "error" });
      } catch (error) {
        wrong.push(`line ${line}: ${error.message}`);
      }
    }
    assert.deepEqual(wrong, []);
  });
}
