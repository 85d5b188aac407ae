// Addresses of the page on which a file of the folder is opened.
import type { FileRow } from "./api";
import { formatAddress } from "./base/url";
import { editorOf } from "./plan/editors";

export function addressOf(file: FileRow): string | null {
  const { path, kind } = file;
  if (kind === "log") return formatAddress({ view: "watch", path, query: {} });
  if (kind === "map") return formatAddress({ view: "plan", path, query: {} });
  if (kind !== "scenario") return null;
  return editorOf(file) === "question" ? formatAddress({ view: "change", path, query: {} }) : formatAddress({ view: "live", path: "", query: { scenario: path } });
}
