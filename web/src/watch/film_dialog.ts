// Asks for the range of a film, tells how far it is, and gives the archive.
import { h } from "../base/dom";
import { saveBlob } from "../base/save";
import { encoded, hasEncoder } from "./encode";
import { filmed, frameCount, rangeFault, type Range } from "./film";

export interface Stage {
  duration: number;
  now: number;
  name: string;
  draw: (t: number) => HTMLCanvasElement;
  /** The film is over: the view shows what it showed. */
  done: () => void;
}

const formats = [
  { name: "film (WebM)", ending: ".webm", words: "frames of this view, one film", make: encoded, there: hasEncoder },
  { name: "pictures (zip of PNG)", ending: "-frames.zip", words: "pictures of this view, numbered, in one zip archive", make: filmed, there: () => true },
];

export function showFilmDialog(stage: Stage): void {
  const offered = formats.filter(({ there }) => there());
  const choice = h("select", { "aria-label": "Format" }, ...offered.map(({ name }, i) => h("option", { value: i }, name)));
  const format = (): (typeof formats)[number] => offered[Number(choice.value)]!;
  const field = (words: string, unit: string, value: number): { row: HTMLElement; input: HTMLInputElement } => {
    const input = h("input", { type: "number", step: "any", min: 0, value: +value.toFixed(2), "aria-label": words });
    return { row: h("label", {}, h("span", {}, words), input, unit), input };
  };
  const from = field("From", "s", stage.now < stage.duration ? stage.now : 0);
  const to = field("To", "s", Math.min(stage.duration, Number(from.input.value) + 10));
  const rate = field("Frames a second", "of the run", 25);
  const words = h("p", { class: "hint", role: "status" });
  const bar = h("progress", { max: 1, value: 0, hidden: true, "aria-label": "Frames done" });
  const start = h("button", { type: "submit", class: "button primary" }, "Save");
  const form = h("form", { method: "dialog" }, h("label", {}, h("span", {}, "Format"), choice), from.row, to.row, rate.row, words, bar,
    h("footer", {}, h("button", { type: "button", class: "button", onclick: () => dialog.close() }, "Cancel"), start));
  const dialog = h("dialog", { class: "film", "aria-label": "Save a film" },
    h("header", {}, h("h2", {}, "Save a film")), form);

  const asked = (): Range => ({ from: from.input.valueAsNumber, to: to.input.valueAsNumber, rate: rate.input.valueAsNumber });
  const report = (): void => {
    const fault = rangeFault(asked(), stage.duration);
    start.disabled = fault !== "";
    words.textContent = fault || `${frameCount(asked()).toLocaleString("en")} ${format().words}`;
  };
  const make = async (): Promise<void> => {
    const range = asked();
    const count = frameCount(range);
    for (const input of [from.input, to.input, rate.input, choice, start]) input.disabled = true;
    bar.hidden = false;
    try {
      const archive = await format().make(range, stage.draw, (done) => {
        bar.value = done / count;
        words.textContent = `${done.toLocaleString("en")} of ${count.toLocaleString("en")}`;
        return dialog.open;
      });
      if (archive) saveBlob(archive, stage.name + format().ending);
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
