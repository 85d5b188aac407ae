// A form that saves the content of the page as a scenario: a name below the folder, and the resulting message.
import { saveScenario, type ScenarioRequest } from "../api";
import { h } from "../base/dom";

export class SaveForm {
  readonly element: HTMLElement;
  private name: HTMLInputElement;
  private said = h("p", { class: "saved", role: "status" });
  /** The paths that this page saved or opened, and so may replace. */
  private own = new Set<string>();

  /** `opened` is the path of the scenario that the page shows; `made` returns what to save; `saved` is called after that. */
  constructor(suggested: string, opened: string, private made: () => ScenarioRequest, private saved: () => void = () => undefined, ...more: HTMLElement[]) {
    if (opened) this.own.add(opened);
    this.name = h("input", { type: "text", id: "save-name", value: suggested, "aria-label": "Name of the scenario", spellcheck: "false" });
    const form = h("form", { class: "row save" }, this.name, h("button", { type: "submit", class: "button", title: "Save as a scenario (S)" }, "Save"), ...more);
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      void this.save();
    });
    this.element = h("section", { "aria-label": "Save as a scenario" }, form, this.said);
  }

  /** Saves the scenario. Returns its path; null if saving was refused, which the page shows. */
  async save(): Promise<string | null> {
    const typed = this.name.value.trim();
    const path = typed.endsWith(".yaml") ? typed : `${typed}.yaml`;
    this.print("", false);
    try {
      const { files } = await saveScenario(path, this.made(), this.own.has(path));
      this.saved();
      this.own.add(path);
      this.name.value = path;
      this.print(`Saved ${files.join(", ")}. Ask again with: outrider run ${path}`, false);
      return path;
    } catch (error) {
      this.print(error instanceof Error ? error.message : String(error), true);
      return null;
    }
  }

  print(sentence: string, refused: boolean): void {
    this.said.textContent = sentence;
    this.said.classList.toggle("refused", refused);
  }
}
