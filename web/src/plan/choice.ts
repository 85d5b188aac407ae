// The choice of a planner: its name, its guarantee, and its options in a form.
import type { PlannerRow } from "../api";
import { h } from "../base/dom";
import { titleOf } from "./titles";
import { optionForm, type Values } from "./form";

export class Choice {
  readonly element: HTMLElement;
  private row: PlannerRow;
  private select: HTMLSelectElement;
  private about = h("p", { class: "about" });
  private options = h("details", {});

  /** `changed` is called after every choice; its argument says why the choice was refused, or is empty. */
  constructor(planners: PlannerRow[], name: string, private changed: (refusal: string) => void, private given: Values = {}) {
    this.row = planners.find((one) => one.name === name) ?? planners[0]!;
    this.select = h("select", { "aria-label": "Planner" }, ...planners.map((one) => h("option", { value: one.name, selected: one === this.row }, titleOf(one.name))));
    this.select.addEventListener("change", () => {
      this.row = planners.find((one) => one.name === this.select.value)!;
      this.given = {};
      this.show();
      changed("");
    });
    this.element = h("section", { class: "choice" }, this.select, this.about, this.options);
    this.show();
  }

  get planner(): PlannerRow { return this.row; }
  get name(): string { return this.row.name; }
  get values(): Values { return { ...this.given }; }
  /** Returns the value of an option; undefined if the planner has no option of that name. */
  value(name: string): Values[string] | undefined { return this.given[name] ?? this.row.options.find((one) => one.name === name)?.default; }

  /** Sets options as if they had been typed, without calling `changed`. */
  set(values: Values): void {
    for (const [name, value] of Object.entries(values)) {
      const option = this.row.options.find((one) => one.name === name);
      if (!option) continue;
      if (value === option.default) delete this.given[name];
      else this.given[name] = value;
      const field = this.options.querySelector<HTMLInputElement>(`#option-${name}`);
      if (field?.type === "checkbox") field.checked = value === true;
      else if (field) field.value = String(value);
    }
  }

  private show(): void {
    const { sentence, guarantee } = this.row;
    this.about.textContent = `${sentence} ${guarantee.sentence.charAt(0).toUpperCase()}${guarantee.sentence.slice(1)}.`.replaceAll("`", "");
    this.about.title = this.row.paper;
    this.options.hidden = this.row.options.length === 0;
    this.options.replaceChildren(h("summary", {}, this.row.options.length === 1 ? "1 option" : `${this.row.options.length} options`),
      optionForm(this.row.options, this.given, this.changed));
  }
}
