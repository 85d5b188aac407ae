// A notice over what is shown: an error that leaves the work as it is. It stays until it is closed or the view changes.
import { h } from "./base/dom";

const words = h("p");
const element = h("div", { class: "notice-over", role: "alert", hidden: true }, words,
  h("button", { type: "button", class: "quiet", "aria-label": "Close the notice", onclick: () => hideNotice() }, "\u00d7"));

export function showNotice(sentence: string): void {
  if (!element.isConnected) document.body.append(element);
  words.textContent = sentence;
  element.hidden = false;
}

export function hideNotice(): void { element.hidden = true; }
