// The viewer: one self-contained file that contains the report of one run.
import "./base/style.css";
import { h } from "./base/dom";
import { showHelp } from "./base/help";
import { keys } from "./base/keys";
import { startTheme, toggleTheme } from "./base/theme";
import { parseAddress } from "./base/url";
import { parseReport } from "./report/types";
import { banner } from "./banner";
import { Watch } from "./watch/watch";

const { query } = parseAddress(location.hash);
startTheme(query.theme ?? null);
keys.set("Page", [
  { key: "?", words: "this help", act: showHelp },
  { key: "d", words: "light or dark", act: toggleTheme },
]);
document.addEventListener("keydown", (event) => keys.handle(event));

const text = document.getElementById("report")!.textContent ?? "";
const report = parseReport(text);
if (typeof report === "string") {
  document.body.append(h("p", { class: "refusal" }, report));
} else {
  const seed = text.match(/"seed": ?(\d+)/)?.[1] ?? "";  // kept as text because it may exceed 2^53
  document.body.append(banner(report, seed));
  document.body.append(new Watch(report, query).element);
}
