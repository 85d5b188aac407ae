// The viewer: one self-contained file that contains the log of one run.
import "./base/style.css";
import "./base/access.css";
import { h } from "./base/dom";
import { showHelp, startLetters } from "./base/help";
import { keys } from "./base/keys";
import { showPalette } from "./base/palette";
import { startTheme, toggleTheme } from "./base/theme";
import { parseAddress } from "./base/url";
import { bytesOfBase64 } from "./base/base64";
import { openLog } from "./log/file";
import { banner } from "./banner";
import { Watch } from "./watch/watch";

const { query } = parseAddress(location.hash);
startTheme(query.theme ?? null);
keys.set("Page", [
  { key: "?", words: "every key that works here", act: showHelp },
  { key: "Ctrl+k", words: "find a command", act: showPalette },
  { key: "d", words: "light or dark", act: toggleTheme },
]);
startLetters();
keys.listen();

async function show(): Promise<void> {
  const element = document.getElementById("log")!;
  const file = new Blob([bytesOfBase64(element.textContent ?? "")]);
  element.remove();
  const log = await openLog(file);
  document.body.append(banner(log), h("main", {}, new Watch(log, query).element));
}

show().catch((error: Error) => document.body.append(h("p", { class: "refusal" }, error.message)));
