// The table of targets: one row each, its reason below it where there is something to explain.

const columns = [
  { label: "target", value: (target) => target.name },
  { label: "status", value: (target) => target.status },
  { label: "shots", value: (target) => target.shots, text: (target) => String(target.shots) },
  { label: "done", value: (target) => target.end_s, text: (target) => clockText(target.done_s) },
  { label: "clearance", value: (target) => flown(target, target.clearance_m), text: (target) => fixed(flown(target, target.clearance_m), 3) + unit(target, " m") },
  { label: "speed", value: (target) => flown(target, target.speed_mps), text: (target) => fixed(flown(target, target.speed_mps), 2) + unit(target, " m/s") },
  { label: "pitch", value: (target) => flown(target, target.pitch_rad), text: (target) => (target.shots > 0 ? degrees(target.pitch_rad) : "\u2013") },
];

/** Numbers of a shot mean nothing for a target that was never shot at. */
const flown = (target, value) => (target.shots > 0 ? value : NaN);
const unit = (target, text) => (target.shots > 0 ? text : "");

class TargetTable {
  constructor(section, { selectTarget }) {
    this.table = section.querySelector("table");
    this.bodies = new Map(targets.map((target) => [target, this.body(target, selectTarget)]));
    this.order = { column: null, falling: false };
    const head = this.table.querySelector("thead tr");
    columns.forEach((column) => {
      const cell = element("th", "", { scope: "col" });
      const button = element("button", column.label, { type: "button" });
      button.addEventListener("click", () => this.sort(column, cell));
      cell.append(button);
      head.append(cell);
    });
    this.table.append(...this.bodies.values());
  }

  body(target, selectTarget) {
    const body = element("tbody");
    const row = element("tr");
    columns.forEach((column, i) => {
      const cell = element("td");
      if (i === 0) {
        const button = element("button", "", { type: "button", title: target.name });
        button.append(element("i"), element("span", target.name));
        cell.append(button);
      } else {
        cell.textContent = (column.text ?? column.value)(target);
      }
      if (i === 1) cell.className = "status";
      row.append(cell);
    });
    const reason = element("tr", "", { class: "reason" });
    reason.append(element("td", target.reason, { colspan: columns.length }));
    body.append(row, reason);
    body.addEventListener("click", () => selectTarget(target));
    return body;
  }

  sort(column, cell) {
    const { order } = this;
    order.falling = order.column === column && !order.falling;
    order.column = column;
    for (const other of this.table.querySelectorAll("th")) other.removeAttribute("aria-sort");
    cell.setAttribute("aria-sort", order.falling ? "descending" : "ascending");
    const rank = (a, b) => {
      const [x, y] = [column.value(a), column.value(b)];
      if (typeof x === "string") return x.localeCompare(y, "en", { numeric: true });
      return x - y;
    };
    const none = (target) => (Number.isNaN(column.value(target)) ? 1 : 0);  // last, either way round
    const sorted = [...targets].sort((a, b) => none(a) - none(b) || (order.falling ? -1 : 1) * rank(a, b) || 0);
    this.table.append(...sorted.map((target) => this.bodies.get(target)));
  }

  /** Rows show the status at t, and numbers once it is final. */
  show(t, selected) {
    for (const [target, body] of this.bodies) {
      const status = statusAt(target, t);
      const chosen = target === selected;
      const key = `${status} ${chosen}`;
      if (body.dataset.key === key) continue;
      body.dataset.key = key;
      body.className = `${chosen ? "selected" : ""} ${status === "waiting" ? "waiting" : ""}`;
      body.querySelector("button").firstChild.replaceWith(signElement(status));
      body.querySelector("button").setAttribute("aria-pressed", String(chosen));
      const cell = body.querySelector(".status");
      cell.textContent = status;
      cell.style.setProperty("--colour", `var(--${known(status)})`);
      const explains = chosen ? status !== "waiting" : status === "failed" || status === "unreachable";
      body.querySelector(".reason").hidden = !target.reason || !explains;
    }
  }

  reveal(target) {
    const panel = this.table.parentElement;
    const body = this.bodies.get(target);
    if (!body || panel.scrollHeight <= panel.clientHeight) return;
    const head = this.table.tHead.offsetHeight;
    const top = body.offsetTop - head;
    if (top < panel.scrollTop) panel.scrollTop = top;
    const bottom = body.offsetTop + body.offsetHeight;
    if (bottom > panel.scrollTop + panel.clientHeight) panel.scrollTop = bottom - panel.clientHeight;
  }
}

