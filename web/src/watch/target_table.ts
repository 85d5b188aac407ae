// The table of targets: a row each, its reason below it where there is something to explain.
import { h } from "../base/dom";
import { clockText, degrees, fixed } from "../base/numbers";
import { known, signElement } from "../base/signs";
import type { Run } from "../report/run";
import type { Num, Target } from "../report/types";

interface Column {
  label: string;
  value: (target: Target) => string | number;
  text: (target: Target) => string;
}

/** Numbers of a shot mean nothing for a target that was never shot at. */
const flown = (target: Target, value: Num): number => (target.shots > 0 ? (value ?? NaN) : NaN);
const withUnit = (value: number, digits: number, unit: string): string =>
  (Number.isFinite(value) ? `${fixed(value, digits)} ${unit}` : "\u2013");

const columns: Column[] = [
  { label: "target", value: (one) => one.name, text: (one) => one.name },
  { label: "status", value: (one) => one.status, text: (one) => one.status },
  { label: "shots", value: (one) => one.shots, text: (one) => String(one.shots) },
  { label: "done", value: (one) => one.done_s ?? NaN, text: (one) => clockText(one.done_s) },
  { label: "clearance", value: (one) => flown(one, one.clearance_m), text: (one) => withUnit(flown(one, one.clearance_m), 3, "m") },
  { label: "pitch", value: (one) => flown(one, one.pitch_rad), text: (one) => degrees(flown(one, one.pitch_rad)) },
];

export class TargetTable {
  readonly element: HTMLElement;
  private table = h("table");
  private bodies = new Map<Target, HTMLTableSectionElement>();
  private listed: Target[] = [];
  private run!: Run;
  private order: { column: Column | null; falling: boolean } = { column: null, falling: false };

  constructor(run: Run, private select: (target: Target) => void) {
    const head = h("tr", {}, ...columns.map((column) => {
      const cell = h("th", { scope: "col" }, h("button", { type: "button", onclick: () => this.sort(column, cell) }, column.label));
      return cell;
    }));
    this.table.append(h("thead", {}, head));
    this.element = h("section", { class: "targets scrolls", tabindex: 0, "aria-label": "Targets" }, this.table);
    this.renew(run);
  }

  renew(run: Run): void {
    this.run = run;
    if (run.report.targets === this.listed) return;
    this.listed = run.report.targets;
    for (const body of this.bodies.values()) body.remove();
    this.bodies = new Map(this.listed.map((target) => [target, this.body(target)]));
    this.arrange();
  }

  private body(target: Target): HTMLTableSectionElement {
    const cells = columns.map((column, i) => h("td", i === 1 ? { class: "status" } : {},
      i > 0 ? column.text(target) : h("button", { type: "button", title: target.name }, h("i"), h("span", {}, target.name))));
    return h("tbody", { onclick: () => this.select(target) }, h("tr", {}, ...cells),
      h("tr", { class: "reason" }, h("td", { colspan: columns.length }, target.reason)));
  }

  private sort(column: Column, cell: HTMLElement): void {
    const { order } = this;
    order.falling = order.column === column && !order.falling;
    order.column = column;
    for (const other of this.table.querySelectorAll("th")) other.removeAttribute("aria-sort");
    cell.setAttribute("aria-sort", order.falling ? "descending" : "ascending");
    this.arrange();
  }

  /** In the order of the column that was chosen; in that of the report before one was. */
  private arrange(): void {
    const { column, falling } = this.order;
    if (!column) {
      this.table.append(...this.bodies.values());
      return;
    }
    const rank = (a: Target, b: Target): number => {
      const [x, y] = [column.value(a), column.value(b)];
      return typeof x === "string" ? x.localeCompare(String(y), "en", { numeric: true }) : x - Number(y);
    };
    const none = (target: Target): number => (Number.isNaN(column.value(target)) ? 1 : 0);  // last, either way round
    const sorted = [...this.bodies.keys()].sort((a, b) => none(a) - none(b) || (falling ? -1 : 1) * rank(a, b) || 0);
    this.table.append(...sorted.map((target) => this.bodies.get(target)!));
  }

  /** Rows show the status at t. */
  show(t: number, selected: Target | null): void {
    for (const [target, body] of this.bodies) {
      const status = this.run.status(target, t);
      const chosen = target === selected;
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
      body.querySelector<HTMLElement>(".reason")!.hidden = !target.reason || !explains;
    }
  }

  reveal(target: Target): void {
    const body = this.bodies.get(target);
    const panel = this.element;
    if (!body || panel.scrollHeight <= panel.clientHeight) return;
    const head = this.table.tHead!.offsetHeight;
    const top = body.offsetTop - head;
    const bottom = body.offsetTop + body.offsetHeight;
    if (top < panel.scrollTop) panel.scrollTop = top;
    if (bottom > panel.scrollTop + panel.clientHeight) panel.scrollTop = bottom - panel.clientHeight;
  }
}
