// The table of targets: a row each, its reason below it where there is something to explain.
import { h } from "../base/dom";
import { clockText, degrees, fixed } from "../base/numbers";
import { known, signElement } from "../base/signs";
import type { Run } from "../log/run";
import { targetsOf, type TargetStory } from "../log/targets";

interface Column {
  label: string;
  value: (target: TargetStory) => string | number;
  text: (target: TargetStory) => string;
}

const withUnit = (value: number, digits: number, unit: string): string =>
  (Number.isFinite(value) ? `${fixed(value, digits)} ${unit}` : "\u2013");

const columns: Column[] = [
  { label: "target", value: (one) => one.name, text: (one) => one.name },
  { label: "status", value: (one) => one.status, text: (one) => one.status },
  { label: "shots", value: (one) => one.last.shots, text: (one) => String(one.last.shots) },
  { label: "done", value: (one) => one.doneAt, text: (one) => clockText(one.doneAt) },
  { label: "clearance", value: (one) => one.clearance, text: (one) => withUnit(one.clearance, 3, "m") },
  { label: "pitch", value: (one) => one.pitch, text: (one) => degrees(one.pitch) },
];

export class TargetTable {
  readonly element: HTMLElement;
  private table = h("table");
  private bodies = new Map<string, HTMLTableSectionElement>();  // by name
  private listed = "";
  private all: TargetStory[] = [];
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
    this.all = targetsOf(run);
    const listed = JSON.stringify(this.all.map((one) => [...columns.map((column) => column.text(one)), one.last.reason]));
    if (listed === this.listed) return;
    this.listed = listed;
    for (const body of this.bodies.values()) body.remove();
    this.bodies = new Map(this.all.map((target) => [target.name, this.body(target)]));
    this.arrange();
  }

  private body(target: TargetStory): HTMLTableSectionElement {
    const cells = columns.map((column, i) => h("td", i === 1 ? { class: "status" } : {},
      i > 0 ? column.text(target) : h("button", { type: "button", title: target.name }, h("i"), h("span", {}, target.name))));
    return h("tbody", { onclick: () => this.choose(target.name) }, h("tr", {}, ...cells),
      h("tr", { class: "reason" }, h("td", { colspan: columns.length }, target.last.reason)));
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
      const [x, y] = [column.value(a), column.value(b)];
      return typeof x === "string" ? x.localeCompare(String(y), "en", { numeric: true }) : x - Number(y);
    };
    const none = (target: TargetStory): number => (Number.isNaN(column.value(target)) ? 1 : 0);  // last, either way round
    const sorted = [...this.all].sort((a, b) => none(a) - none(b) || (falling ? -1 : 1) * rank(a, b) || 0);
    this.table.append(...sorted.map(({ name }) => this.bodies.get(name)!));
  }

  /** Rows show the status at t. */
  show(t: number, selected: TargetStory | null): void {
    for (const target of this.all) {
      const body = this.bodies.get(target.name)!;
      const status = target.statusAt(t);
      const chosen = target.name === selected?.name;
      const key = `${status} ${chosen}`;
      if (body.dataset.key === key) continue;
      body.dataset.key = key;
      body.className = `${chosen ? "selected" : ""} ${status === "waiting" ? "waiting" : ""}`;
      body.querySelector("button")!.firstElementChild!.replaceWith(signElement(status));
      body.querySelector("button")!.setAttribute("aria-pressed", String(chosen));
      const cell = body.querySelector<HTMLElement>(".status")!;
      cell.textContent = status;
      cell.style.setProperty("color", `var(--${known(status)})`);
      const explains = chosen ? status !== "waiting" : status === "failed" || status === "unreachable";
      body.querySelector<HTMLElement>(".reason")!.hidden = !target.last.reason || !explains;
    }
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
