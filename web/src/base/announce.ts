// Changes that happen by themselves are told to screen readers: one region for the whole page keeps what was said last.
import { h } from "./dom";

const region = h("p", { class: "unseen announced", role: "status" });

/** Says a sentence, unless it is what was said last. */
export function announce(sentence: string): void {
  if (!region.isConnected) document.body.append(region);
  if (region.textContent !== sentence) region.textContent = sentence;
}
