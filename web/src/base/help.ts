// The help overlay: it lists every key of the current view, and switches those of a single character off and on.
import { h } from "./dom";
import { keyName, keys } from "./keys";
import { keep, kept } from "./kept";

const letters = "letter-keys";

/** As it was chosen here before. */
export function startLetters(): void { keys.letters = kept(letters) !== "off"; }

function letterSwitch(): HTMLElement {
  const box = h("input", { type: "checkbox", checked: keys.letters });
  box.addEventListener("change", () => {
    keys.letters = box.checked;
    keep(letters, box.checked ? "on" : "off");
  });
  return h("label", { class: "letters" }, box, "Keys of a single character");
}

export function showHelp(): void {
  document.querySelector("dialog.help")?.remove();
  const groups = keys.list().map(([name, list]) =>
    h("section", {}, h("h3", {}, name),
      h("dl", {}, ...list.map((one) => h("div", {}, h("dt", {}, h("kbd", {}, keyName(one.key))), h("dd", {}, one.words))))));
  const dialog = h("dialog", { class: "help", "aria-label": "Keys" },
    h("header", {}, h("h2", {}, "Keys"), letterSwitch(),
      h("button", { type: "button", class: "quiet", onclick: () => dialog.close() }, "Close")),
    h("div", { class: "columns" }, ...groups));
  dialog.addEventListener("close", () => dialog.remove());
  dialog.addEventListener("click", (event) => { if (event.target === dialog) dialog.close(); });
  dialog.addEventListener("keydown", (event) => { if (event.key === "?") dialog.close(); });
  document.body.append(dialog);
  dialog.showModal();
}
