// The formulas of a Markdown document as GitHub sees them: it reads the Markdown first, and takes for formulas what is
// left of $...$ and $$...$$ in the text then, $`...`$, and blocks of the language math.
import { fromMarkdown } from "mdast-util-from-markdown";
import { gfmFromMarkdown } from "mdast-util-gfm";
import { gfm } from "micromark-extension-gfm";

function textOf(node) {
  return node.value ?? (node.children ?? []).map(textOf).join("");
}

// In a paragraph, heading or cell: code between two dollars, and dollars in one text. A formula that Markdown has cut in
// pieces (emphasis, links) is none any more.
function inLine(node, found) {
  const children = node.children;
  const used = new Set();
  children.forEach((child, i) => {
    const before = children[i - 1];
    const after = children[i + 1];
    if (child.type === "inlineCode" && before?.type === "text" && after?.type === "text" &&
        before.value.endsWith("$") && after.value.startsWith("$")) {
      found.push({ latex: child.value, line: child.position.start.line, display: false });
      used.add(i);
    }
  });
  children.forEach((child, i) => {
    if (child.type !== "text") return;
    let value = child.value;
    if (used.has(i - 1)) value = value.slice(1);
    if (used.has(i + 1)) value = value.slice(0, -1);
    const rest = value.replace(/\$\$([^$]+)\$\$|\$(?![\s$])([^$]*[^$\s])\$(?![\w])/g, (_, block, inline) => {
      found.push({ latex: block ?? inline, line: child.position.start.line, display: block !== undefined });
      return "";
    });
    if (rest.includes("$")) {
      found.push({ stray: rest.slice(Math.max(0, rest.indexOf("$") - 30), rest.indexOf("$") + 50), line: child.position.start.line });
    }
  });
}

export function formulasOf(markdown) {
  const found = [];
  const visit = (node) => {
    if (node.type === "code" && node.lang === "math") {
      found.push({ latex: node.value, line: node.position.start.line, display: true });
    }
    if (node.children?.some((child) => ["text", "inlineCode"].includes(child.type))) inLine(node, found);
    node.children?.forEach(visit);
  };
  visit(fromMarkdown(markdown, { extensions: [gfm()], mdastExtensions: [gfmFromMarkdown()] }));
  return found;
}

// Where Markdown takes away what LaTeX needs: \{ becomes {, \\ becomes \, \, and \! lose their backslash.
export function lostBackslashes(markdown) {
  const lost = [];
  markdown.split("\n").forEach((line, i) => {
    const plain = line.replace(/\$`[^`]*`\$/g, "").replace(/`[^`]*`/g, "");
    for (const [formula] of plain.matchAll(/\$[^$]+\$/g)) {
      if (/\\[^a-zA-Z0-9\s]/.test(formula)) lost.push({ latex: formula, line: i + 1 });
    }
  });
  return lost;
}

export { textOf };
