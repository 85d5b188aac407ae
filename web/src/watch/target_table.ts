// The table of targets at the present time: a row each, its reason below it where there is something to explain.
import { h } from "../base/dom";
import { clockText, degrees, fixed } from "../base/numbers";
import { typeset } from "../base/typeset";
import { known, signElement } from "../base/signs";
import type { Run } from "../log/run";
import { targetsOf, type TargetStory } from "../log/targets";

interface Column {
  label: string;
  value: (target: TargetStory, t: number) => string | number;
  text: (target: TargetStory, t: number) => string;
}

const withUnit = (value: number, digits: number, unit: string): string =>
  (Number.isFinite(value) ? `${fixed(value, digits)} ${unit}` : "\u2013");

/** Columns of what is known at t: none tells what comes later. */
const columns: Column[] = [
  { label: "target", value: (one) => one.name, text: (one) => one.name },
  { label: "status", value: (one, t) => one.statusAt(t), text: (one, t) => one.statusAt(t) },
  { label: "shots", value: (one, t) => one.at(t).shots, text: (one, t) => String(one.at(t).shots) },
  { label: "done", value: (one, t) => one.doneBy(t), text: (one, t) => clockText(one.doneBy(t)) },
  { label: "clearance", value: (one, t) => one.clearanceBy(t), text: (one, t) => withUnit(one.clearanceBy(t), 3, "m") },
  { label: "pitch", value: (one, t) => one.pitchBy(t), text: (one, t) => degrees(one.pitchBy(t)) },
];

export class TargetTable {
  readonly element: HTMLElement;
  private table = h("table");
  private bodies = new Map<string, HTMLTableSectionElement>();  // by name
  private all: TargetStory[] = [];
  private t = 0;
  private order: { column: Column | null; falling: boolean } = { column: null, falling: false };

  constructor(run: Run, private select: (target: TargetStory) => void) {
    const head = h("tr", {}, ...columns.map((column) => {
      const cell = h("th", { scope: "col" }, h("button", { type: "button", onclick: () => this.sort(column, cell) }, column.label));
      return cell;
    }));
    this.table.append(h("thead", {}, head));
    this.element = h("section", { class: "targets scrolls", tabindex: 0, "aria-label": "Targets" }, this.table);
    this.renew(run);
  }

  renew(run: Run): void {
    const before = this.all.map(({ name }) => name).join("\n");
    this.all = targetsOf(run);
    if (this.all.map(({ name }) => name).join("\n") === before) return;
    for (const body of this.bodies.values()) body.remove();
    this.bodies = new Map(this.all.map((target) => [target.name, this.body(target)]));
    this.arrange();
  }

  private body({ name }: TargetStory): HTMLTableSectionElement {
    const cells = columns.map((_, i) => h("td", i === 1 ? { class: "status" } : {},
      i > 0 ? "" : h("button", { type: "button", title: name }, h("i"), h("span", {}, name))));
    return h("tbody", { onclick: () => this.choose(name) }, h("tr", {}, ...cells),
      h("tr", { class: "reason" }, h("td", { colspan: columns.length })));
  }

  private choose(name: string): void {
    const target = this.all.find((one) => one.name === name);
    if (target) this.select(target);
  }

  private sort(column: Column, cell: HTMLElement): void {
    const { order } = this;
    order.falling = order.column === column && !order.falling;
    order.column = column;
    for (const other of this.table.querySelectorAll("th")) other.removeAttribute("aria-sort");
    cell.setAttribute("aria-sort", order.falling ? "descending" : "ascending");
    this.arrange();
  }

  /** In the order of the column that was chosen; in that of the log before one was. */
  private arrange(): void {
    const { column, falling } = this.order;
    if (!column) {
      this.table.append(...this.bodies.values());
      return;
    }
    const rank = (a: TargetStory, b: TargetStory): number => {
      const [x, y] = [column.value(a, this.t), column.value(b, this.t)];
      return typeof x === "string" ? x.localeCompare(String(y), "en", { numeric: true }) : x - Number(y);
    };
    const none = (target: TargetStory): number => (Number.isNaN(column.value(target, this.t)) ? 1 : 0);  // last, either way round
    const sorted = [...this.all].sort((a, b) => none(a) - none(b) || (falling ? -1 : 1) * rank(a, b) || 0);
    this.table.append(...sorted.map(({ name }) => this.bodies.get(name)!));
  }

  /** Rows show what is known at t; a row is written only when that changes. */
  show(t: number, selected: TargetStory | null): void {
    this.t = t;
    let changed = false;
    for (const target of this.all) {
      const body = this.bodies.get(target.name)!;
      const chosen = target.name === selected?.name;
      const { status, reason } = target.at(t);
      const texts = columns.map((column) => column.text(target, t));
      const key = JSON.stringify([chosen, reason, ...texts]);
      if (body.dataset.key === key) continue;
      body.dataset.key = key;
      changed = true;
      body.className = `${chosen ? "selected" : ""} ${status === "waiting" ? "waiting" : ""}`;
      const button = body.querySelector("button")!;
      button.firstElementChild!.replaceWith(signElement(status));
      button.setAttribute("aria-pressed", String(chosen));
      const [row, below] = body.rows;
      texts.forEach((text, i) => { if (i > 0) row!.cells[i]!.textContent = text; });
      row!.cells[1]!.style.setProperty("color", `var(--${known(status)})`);
      below!.cells[0]!.textContent = typeset(reason);
      below!.hidden = !reason || !(chosen ? status !== "waiting" : status === "failed" || status === "unreachable");
    }
    if (changed && this.order.column) this.arrange();
  }

  reveal(target: TargetStory): void {
    const body = this.bodies.get(target.name);
    const panel = this.element;
    if (!body || panel.scrollHeight <= panel.clientHeight) return;
    const head = this.table.tHead!.offsetHeight;
    const top = body.offsetTop - head;
    const bottom = body.offsetTop + body.offsetHeight;
    if (top < panel.scrollTop) panel.scrollTop = top;
    if (bottom > panel.scrollTop + panel.clientHeight) panel.scrollTop = bottom - panel.clientHeight;
  }
}
