// The command palette: everything that can be done here, found by a few letters of what it is called.
import { h } from "./dom";
import { keyName, keys } from "./keys";

export interface Command { words: string; group: string; key?: string; act: () => void }

/** Returns further commands, besides those that have a key: such as opening a file. */
let more: () => Promise<Command[]> = () => Promise.resolve([]);
export function offerMore(ask: () => Promise<Command[]>): void { more = ask; }

/** Returns how close the letters are together if they stand in the text in their order, less being closer; else null. */
export function likeness(text: string, letters: string): number | null {
  let [at, spread] = [-1, 0];
  for (const letter of letters.toLowerCase().replaceAll(" ", "")) {
    const next = text.toLowerCase().indexOf(letter, at + 1);
    if (next < 0) return null;
    spread += at < 0 ? next / 20 : next - at - 1;
    at = next;
  }
  return spread;
}

/** After which a server that was too busy is asked again, while the palette is open. */
const againMs = 1000;

const ofKeys = (): Command[] => keys.list().flatMap(([group, list]) => list.map(({ key, words, act }) => ({ group, words, key, act })));

export function showPalette(): void {
  document.querySelector("dialog.palette")?.remove();
  let commands = ofKeys();
  let found: Command[] = [];
  let chosen = 0;
  const list = h("ul", { role: "listbox", id: "palette-list", "aria-label": "Commands" });
  const field = h("input", { type: "text", role: "combobox", placeholder: "What do you want to do?", "aria-label": "Command", "aria-expanded": "true", "aria-controls": "palette-list", "aria-autocomplete": "list" });
  const dialog = h("dialog", { class: "palette", "aria-label": "Commands" }, field, list);
  const mark = (to: number): void => {
    chosen = found.length > 0 ? (to + found.length) % found.length : 0;
    [...list.children].forEach((one, i) => one.setAttribute("aria-selected", String(i === chosen)));
    const row = list.children[chosen];
    field.setAttribute("aria-activedescendant", row?.id ?? "");
    row?.scrollIntoView({ block: "nearest" });
  };
  const run = (command: Command | undefined): void => {
    if (!command) return;
    dialog.close();
    dialog.remove(); // at once: a key that follows must not go to its field
    command.act();
  };
  const show = (): void => {
    found = commands.map((one) => ({ one, rank: likeness(`${one.words} ${one.group}`, field.value) })).filter(({ rank }) => rank !== null)
      .sort((a, b) => a.rank! - b.rank!).slice(0, 60).map(({ one }) => one);
    list.replaceChildren(...found.map((one, i) => h("li", { role: "option", id: `command-${i}`, "aria-selected": "false", onclick: () => run(one) },
      h("span", {}, one.words), h("small", {}, one.group), one.key ? h("kbd", {}, keyName(one.key)) : null)));
    mark(0);
  };
  field.addEventListener("input", show);
  field.addEventListener("keydown", (event) => {
    if (event.key === "Enter") run(found[chosen]);
    else if (event.key === "ArrowDown" || event.key === "ArrowUp") mark(chosen + (event.key === "ArrowDown" ? 1 : -1));
    else return;
    event.preventDefault();
  });
  dialog.addEventListener("close", () => dialog.remove());
  dialog.addEventListener("click", (event) => { if (event.target === dialog) dialog.close(); });
  document.body.append(dialog);
  dialog.showModal();
  show();
  const ask = (): void => void more().then((others) => { commands = [...commands, ...others]; show(); }, () => { if (dialog.isConnected) setTimeout(ask, againMs); });
  ask();
}
