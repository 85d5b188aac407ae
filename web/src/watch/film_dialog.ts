// Asks for the range of a film, tells how far it is, and gives the archive.
import { h } from "../base/dom";
import { saveBlob } from "../base/save";
import { filmed, frameCount, rangeFault, type Range } from "./film";

export interface Stage {
  duration: number;
  now: number;
  name: string;
  draw: (t: number) => HTMLCanvasElement;
  /** The film is over: the view shows what it showed. */
  done: () => void;
}

export function showFilmDialog(stage: Stage): void {
  const field = (words: string, unit: string, value: number): { row: HTMLElement; input: HTMLInputElement } => {
    const input = h("input", { type: "number", step: "any", min: 0, value: +value.toFixed(2), "aria-label": words });
    return { row: h("label", {}, h("span", {}, words), input, unit), input };
  };
  const from = field("From", "s", stage.now < stage.duration ? stage.now : 0);
  const to = field("To", "s", Math.min(stage.duration, Number(from.input.value) + 10));
  const rate = field("Frames a second", "of the run", 25);
  const words = h("p", { class: "hint", role: "status" });
  const bar = h("progress", { max: 1, value: 0, hidden: true, "aria-label": "Frames done" });
  const start = h("button", { type: "submit", class: "button primary" }, "Save frames");
  const form = h("form", { method: "dialog" }, from.row, to.row, rate.row, words, bar,
    h("footer", {}, h("button", { type: "button", class: "button", onclick: () => dialog.close() }, "Cancel"), start));
  const dialog = h("dialog", { class: "film", "aria-label": "Frames of a film" },
    h("header", {}, h("h2", {}, "Frames of a film")), form);

  const asked = (): Range => ({ from: from.input.valueAsNumber, to: to.input.valueAsNumber, rate: rate.input.valueAsNumber });
  const report = (): void => {
    const fault = rangeFault(asked(), stage.duration);
    start.disabled = fault !== "";
    words.textContent = fault || `${frameCount(asked()).toLocaleString("en")} pictures of this view, numbered, in one zip archive`;
  };
  const make = async (): Promise<void> => {
    const range = asked();
    const count = frameCount(range);
    for (const { input } of [from, to, rate]) input.disabled = true;
    start.disabled = true;
    bar.hidden = false;
    try {
      const archive = await filmed(range, stage.draw, (done) => {
        bar.value = done / count;
        words.textContent = `${done.toLocaleString("en")} of ${count.toLocaleString("en")}`;
        return dialog.open;
      });
      if (archive) saveBlob(archive, `${stage.name}-frames.zip`);
      dialog.close();
    } catch (error) {
      words.textContent = error instanceof Error ? error.message : String(error);
    }
    stage.done();
  };
  form.addEventListener("input", report);
  form.addEventListener("submit", (event) => { event.preventDefault(); void make(); });
  dialog.addEventListener("close", () => dialog.remove());
  report();
  document.body.append(dialog);
  dialog.showModal();
}
