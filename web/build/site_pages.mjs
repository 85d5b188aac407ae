// Pages of the docs site that are made from something else than Markdown: headers, examples, files, notebooks.
import { basename, extname } from "node:path";

/** Text for Markdown that the reader sees as it stands. */
export const plain = (text) => text.replace(/[&<>{}*_`[\]|]/g, (sign) => `&#${sign.charCodeAt(0)};`);
export const fence = (language, text) => `\`\`\`\`${language}\n${text.trimEnd()}\n\`\`\`\`\n`;
const languages = { ".cpp": "cpp", ".hpp": "cpp", ".py": "python", ".json": "json", ".yaml": "yaml", ".xml": "xml" };
const languageOf = (path) => languages[extname(path)] ?? "text";

/** A header: its opening comment as text (lists and indented lines keep their lines), then what it declares. */
export function headerPage(path, source) {
  const lines = source.split("\n");
  const end = lines.findIndex((line) => !line.startsWith("//"));
  const comment = lines.slice(0, end).map((line) => line.replace(/^\/\/ ?/, "")).join("\n");
  const declared = lines.slice(end).filter((line) => line !== "#pragma once").join("\n").trim();
  const paragraphs = comment.split(/\n\s*\n/).map((paragraph) =>
    /^(-|\s)/m.test(paragraph) ? fence("text", paragraph) : plain(paragraph));
  return `# ${path.replace("include/", "")}\n\n${paragraphs.join("\n\n")}\n\n## Declarations\n\n${fence("cpp", declared)}`;
}

/** An example, whose last comment, from the line "Prints:", is its output; a test compares the two. */
export function examplePage(path, source) {
  const [code, output] = source.split(/^(?:\/\/|#) Prints:\n/m);
  const printed = output === undefined ? "" : `\nIt prints:\n\n${fence("text", output.replace(/^(?:\/\/|#) ?/gm, ""))}`;
  return `# ${basename(path)}\n\n${fence(languageOf(path), code)}${printed}`;
}

/** A file that a page links to, as it stands; the search leaves it out. */
export const filePage = (path, source) => `---\nsearch: false\n---\n# ${path}\n\n${fence(languageOf(path), source)}`;

/** The page that plans in the browser, with this planner; it stands beside the pages of the site. */
export const planFrame = (name) =>
  `\n## Try it\n\n<iframe src="/plan.html#${name}" title="a map on which ${name} plans" loading="lazy" style="width: 100%; height: 640px; border: 0"></iframe>\n`;

export const listPage = (title, entries) =>
  `# ${title}\n\n${entries.map(({ text, link }) => `- [${plain(text)}](${link})`).join("\n")}\n`;

/** A notebook that was not run: its text and its code. */
export function notebookPage(source) {
  const cells = JSON.parse(source).cells.map(({ cell_type, source: lines }) =>
    cell_type === "markdown" ? lines.join("") : fence("python", lines.join("")));
  return `${cells.join("\n\n")}\n\nIt was not run when this page was made, so there are no outputs.\n`;
}
