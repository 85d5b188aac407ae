// What changes by itself is told to screen readers: one region for the whole page, which keeps what was said last.
import { h } from "./dom";

const region = h("p", { class: "unseen announced", role: "status" });

/** Says a sentence, unless it is what was said last. */
export function announce(sentence: string): void {
  if (!region.isConnected) document.body.append(region);
  if (region.textContent !== sentence) region.textContent = sentence;
}
