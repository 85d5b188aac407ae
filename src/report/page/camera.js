// A view of the plane, y up, on a canvas: fits a box, zooms about the pointer, pans by drag or pinch.

class Camera {
  constructor(canvas, { box, margin = {}, redraw, click, hover }) {
    this.canvas = canvas;
    this.ctx = canvas.getContext("2d");
    this.box = box;
    this.margin = { left: 24, right: 24, top: 24, bottom: 24, ...margin };
    this.redraw = redraw;
    this.click = click;
    this.hover = hover;
    this.pointers = new Map();
    this.home = true;
    this.resize();
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.listen();
  }

  resize() {
    this.width = Math.max(1, this.canvas.clientWidth);
    this.height = Math.max(1, this.canvas.clientHeight);
    this.dpr = Math.min(3, window.devicePixelRatio || 1);
    const size = [Math.round(this.width * this.dpr), Math.round(this.height * this.dpr)];
    if (this.canvas.width !== size[0] || this.canvas.height !== size[1]) [this.canvas.width, this.canvas.height] = size;
    if (this.home) this.fit();
    this.moved();
  }

  /** Puts the box into the middle, as large as it goes. */
  fit(box = this.box) {
    const { left, right, top, bottom } = this.margin;
    const [x0, y0, x1, y1] = box;
    this.scale = Math.max(1e-3, Math.min((this.width - left - right) / Math.max(1e-6, x1 - x0),
      (this.height - top - bottom) / Math.max(1e-6, y1 - y0)));
    this.x = left + (this.width - left - right) / 2 - this.scale * (x0 + x1) / 2;
    this.y = top + (this.height - top - bottom) / 2 + this.scale * (y0 + y1) / 2;
    this.home = box === this.box;
    this.least = this.home ? this.scale / 2 : this.least;
  }

  show(box) {
    this.box = box;
    this.fit();
    this.moved();
  }

  zoom(factor, at = { x: this.width / 2, y: this.height / 2 }) {
    const scale = clamp(this.scale * factor, this.least, 4000);
    this.x = at.x - (at.x - this.x) * (scale / this.scale);
    this.y = at.y - (at.y - this.y) * (scale / this.scale);
    this.scale = scale;
    this.home = false;
    this.moved();
  }

  moved() {
    this.version = (this.version ?? 0) + 1;
    this.canvas.style.touchAction = this.home ? "pan-y" : "none";
    this.redraw?.();
  }

  screen(x, y) { return { x: this.x + this.scale * x, y: this.y - this.scale * y }; }
  plane(p) { return { x: (p.x - this.x) / this.scale, y: (this.y - p.y) / this.scale }; }

  /** Coordinates of the plane, in which a width of px(1) is one pixel. */
  toPlane(ctx) {
    const k = this.dpr * this.scale;
    ctx.setTransform(k, 0, 0, -k, this.dpr * this.x, this.dpr * this.y);
  }
  toScreen(ctx) { ctx.setTransform(this.dpr, 0, 0, this.dpr, 0, 0); }
  px(pixels) { return pixels / this.scale; }

  command(name) {
    if (name === "in") this.zoom(1.5);
    if (name === "out") this.zoom(1 / 1.5);
    if (name === "fit") { this.fit(); this.moved(); }
  }

  listen() {
    const { canvas, pointers } = this;
    const position = (event) => {
      const frame = canvas.getBoundingClientRect();
      return { x: event.clientX - frame.left, y: event.clientY - frame.top };
    };
    const middle = () => {
      const all = [...pointers.values()];
      const x = all.reduce((sum, p) => sum + p.x, 0) / all.length;
      const y = all.reduce((sum, p) => sum + p.y, 0) / all.length;
      return { x, y, spread: all.length > 1 ? Math.hypot(all[0].x - all[1].x, all[0].y - all[1].y) : 0 };
    };
    let travel = 0;
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      pointers.set(event.pointerId, position(event));
      if (pointers.size === 1) travel = 0;
    });
    canvas.addEventListener("pointermove", (event) => {
      const at = position(event);
      if (!pointers.has(event.pointerId)) { this.hover?.(at); return; }
      const before = middle();
      pointers.set(event.pointerId, at);
      const after = middle();
      travel += Math.hypot(after.x - before.x, after.y - before.y);
      if (travel < 4 && pointers.size < 2) return;
      if (event.pointerType === "touch" && this.home && pointers.size < 2) return;  // the page scrolls
      this.x += after.x - before.x;
      this.y += after.y - before.y;
      this.home = false;
      if (before.spread > 0 && after.spread > 0) this.zoom(after.spread / before.spread, after);
      this.hover?.(null);
      this.moved();
    });
    const release = (event) => {
      if (!pointers.delete(event.pointerId)) return;
      if (event.type === "pointerup" && travel < 4 && pointers.size === 0) this.click?.(position(event));
    };
    canvas.addEventListener("pointerup", release);
    canvas.addEventListener("pointercancel", release);
    canvas.addEventListener("pointerleave", () => this.hover?.(null));
    canvas.addEventListener("dblclick", () => this.command("fit"));
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoom(Math.exp(-clamp(event.deltaY, -120, 120) * 0.0022), position(event));
    }, { passive: false });
    canvas.addEventListener("keydown", (event) => {
      const name = { "+": "in", "=": "in", "-": "out", 0: "fit" }[event.key];
      if (name) this.command(name);
    });
    for (const button of canvas.parentElement.querySelectorAll("[data-camera]")) {
      button.addEventListener("click", () => this.command(button.dataset.camera));
    }
  }
}

/** 1, 2 or 5 times a power of ten, at least `least`. */
function roundStep(least) {
  const power = 10 ** Math.floor(Math.log10(least));
  return power * ([1, 2, 5, 10].find((k) => k * power >= least * (1 - 1e-9)) ?? 10);
}

/** Outline of a convex core grown by a radius, counter-clockwise. */
function traceRounded(path, core, radius) {
  const count = core.length;
  if (count === 0) return;
  if (count === 1) {
    path.moveTo(core[0][0] + radius, core[0][1]);
    path.arc(core[0][0], core[0][1], Math.max(0, radius), 0, 2 * Math.PI);
    path.closePath();
    return;
  }
  const outward = (a, b) => Math.atan2(a[0] - b[0], b[1] - a[1]);
  core.forEach((corner, i) => {
    const from = outward(core[(i + count - 1) % count], corner);
    const to = outward(corner, core[(i + 1) % count]);
    const start = [corner[0] + radius * Math.cos(from), corner[1] + radius * Math.sin(from)];
    if (i === 0) path.moveTo(...start);
    else path.lineTo(...start);
    if (radius > 0) path.arc(corner[0], corner[1], radius, from, to);
  });
  path.closePath();
}

/** Distance from a point to a convex or simple polygon, 0 inside, and the nearest point. */
function nearestOnPolygon(x, y, polygon) {
  let best = { distance: Infinity, x, y };
  let inside = false;
  polygon.forEach((a, i) => {
    const b = polygon[(i + 1) % polygon.length];
    const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    const square = dx * dx + dy * dy;
    const share = square > 0 ? clamp(((x - a[0]) * dx + (y - a[1]) * dy) / square, 0, 1) : 0;
    const [px, py] = [a[0] + share * dx, a[1] + share * dy];
    const distance = Math.hypot(x - px, y - py);
    if (distance < best.distance) best = { distance, x: px, y: py };
    if (a[1] > y !== b[1] > y && x < a[0] + (dx * (y - a[1])) / dy) inside = !inside;
  });
  return inside ? { distance: 0, x, y } : best;
}

