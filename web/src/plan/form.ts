// A form generated from option descriptions. It returns the values that differ from their defaults.
import type { OptionRow } from "../api";
import { h } from "../base/dom";
import { choiceTitle } from "./titles";

export type Values = Record<string, number | boolean | string>;

/** Parses the text of a field; returns its value, or a sentence that says why it is invalid. */
export function valueOf(option: OptionRow, text: string): { value: number | string } | { refusal: string } {
  if (option.type === "string") return { value: text };
  const value = Number(text.trim() === "" ? NaN : text);
  const { low = -Infinity, high = Infinity } = option;
  const whole = option.type !== "integer" || Number.isInteger(value);
  if (Number.isFinite(value) && whole && value >= low && value <= high) return { value };
  const kind = option.type === "integer" ? "a whole number" : "a number";
  const range = Number.isFinite(low) && Number.isFinite(high) ? ` from ${low} to ${high}` : "";
  return { refusal: `${option.name}: '${text}' is not valid; expected ${kind}${range}${option.unit ? ` ${option.unit}` : ""}` };
}

function field(option: OptionRow, given: Values, changed: (refusal: string) => void): HTMLElement {
  const now = given[option.name] ?? option.default;
  const keep = (value: number | boolean | string): void => {
    if (value === option.default) delete given[option.name];
    else given[option.name] = value;
    changed("");
  };
  const id = `option-${option.name}`;
  if (option.type === "boolean") {
    const box = h("input", { type: "checkbox", id, checked: now === true });
    box.addEventListener("change", () => keep(box.checked));
    return box;
  }
  if (option.choices) {
    const select = h("select", { id }, ...option.choices.map((name) => h("option", { value: name, selected: name === now }, choiceTitle(name))));
    select.addEventListener("change", () => keep(select.value));
    return select;
  }
  const input = h("input", { type: option.type === "string" ? "text" : "number", id, value: String(now), min: option.low, max: option.high, step: option.type === "integer" ? 1 : "any" });
  input.addEventListener("change", () => {
    const read = valueOf(option, input.value);
    input.setAttribute("aria-invalid", String("refusal" in read));
    if ("refusal" in read) changed(read.refusal);
    else keep(read.value);
  });
  return input;
}

/**
 * Creates fields for all options. `given` receives the chosen values; `changed` is called with the reason of a refusal,
 * or an empty text.
 */
export function optionForm(options: OptionRow[], given: Values, changed: (refusal: string) => void): HTMLElement {
  const rows = options.map((option) => h("div", { class: "option", title: option.sentence },
    h("label", { for: `option-${option.name}` }, option.name.replaceAll("_", " "), option.unit ? h("span", {}, ` ${option.unit}`) : null),
    field(option, given, changed)));
  return h("form", { class: "options", onsubmit: (event: Event) => event.preventDefault() }, ...rows);
}
