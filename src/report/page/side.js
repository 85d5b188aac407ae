// The side view: the vertical plane of one shot, both axes in metres at the same scale.

/**
 * The place in the plane where the ball comes closest to what it does not touch at the end. The
 * report's clearance is of space: `here` tells that it is the distance to a piece of this plane.
 */
function leastClearance(shot) {
  const nearest = new Map();
  const steps = 400;
  for (let i = 0; i <= steps; ++i) {
    const ball = ballAt(shot, ((shot.end_s - shot.time_s) * i) / steps);
    for (const { name, polygon } of shot.profile) {
      if (name === shot.contact || polygon.length < 3) continue;
      const near = nearestOnPolygon(ball.s, ball.z, polygon);
      const clearance = near.distance - robot.ball_radius_m;
      if (!(nearest.get(name)?.clearance <= clearance)) nearest.set(name, { clearance, name, ball, near });
    }
  }
  const places = [...nearest.values()];
  if (places.length === 0) return null;
  const off = (place) => Math.abs(place.clearance - shot.clearance_m);
  const match = places.reduce((a, b) => (off(b) < off(a) ? b : a));
  const here = off(match) < Math.max(0.005, 0.02 * shot.clearance_m);
  return { ...(here ? match : places.reduce((a, b) => (b.clearance < a.clearance ? b : a))), here };
}

class SideView {
  constructor(section, { redraw }) {
    this.title = section.querySelector("h2");
    this.caption = section.querySelector("#shot-caption");
    this.nearButton = section.querySelector('[data-camera="near"]');
    this.camera = new Camera(section.querySelector("canvas"), {
      box: [0, 0, 6, 2],
      margin: { left: 40, right: 16, top: 8, bottom: 26 },
      redraw,
    });
    this.nearButton.addEventListener("click", () => this.showNear());
  }

  select(shot, target) {
    this.shot = shot;
    this.target = targets.find((one) => one.name === shot?.target) ?? target;
    this.near = shot ? leastClearance(shot) : null;
    this.nearButton.hidden = !this.near?.here;
    this.describe();
    if (shot) this.camera.show(this.frame(shot));
  }

  /** The flight, the target and what stands under and beside them. */
  frame(shot) {
    const flight = shot.end_s - shot.time_s;
    let [right, top, bottom] = [ballAt(shot, flight).s, shot.from[2], Math.min(0, shot.to[2])];
    for (let i = 0; i <= 40; ++i) top = Math.max(top, ballAt(shot, (flight * i) / 40).z);
    for (const { name, polygon } of shot.profile) {
      if (name !== shot.target && name !== shot.contact) continue;
      for (const [s, z] of polygon) {
        if (Math.abs(s) > 100 || Math.abs(z) > 100) continue;
        if (name === shot.target) right = Math.max(right, s);
        if (name === shot.target) top = Math.max(top, z);
      }
    }
    return [-finite(robot.gun_length_m) - 0.35, bottom - 0.15, right + 0.5, top + 0.2];
  }

  showNear() {
    const { ball, near } = this.near;
    const half = clamp(1.3 * near.distance, 0.08, 0.6);
    const [x, y] = [(ball.s + near.x) / 2, (ball.z + near.y) / 2];
    this.camera.fit([x - half, y - half, x + half, y + half]);
    this.camera.moved();
  }

  describe() {
    const { shot, target, title, caption } = this;
    title.replaceChildren();
    caption.replaceChildren();
    if (!shot) {
      title.append(target ? `No shot at ${target.name}` : "No shot was fired");
      caption.append(target?.reason ?? "");
      return;
    }
    const speed = Math.hypot(shot.across, shot.up);
    title.append(`Shot ${shot.index + 1} at ${shot.target} `,
      element("span", `try ${shot.attempt}, ${shot.hit ? "hit" : `touched ${shot.contact || "nothing"}`}`));
    title.title = title.textContent;
    caption.append(`${fixed(speed, 2)} m/s at ${degrees(Math.atan2(shot.up, shot.across))}, ${fixed(shot.along, 2)} m in ${fixed(shot.end_s - shot.time_s, 2)} s. Clearance `,
      element("b", `${fixed(shot.clearance_m, 3)} m`), this.whereNear());
  }

  whereNear() {
    const asked = robot.margin_m > 0 ? ` (${fixed(robot.margin_m, 3)} m kept in planning)` : "";
    if (!Number.isFinite(this.shot.clearance_m)) return ".";
    if (this.near?.here) return `, to ${this.near.name}${asked}.`;
    return `, to something beside this plane${asked}.`;
  }

  draw(t) {
    const { camera, shot } = this;
    const { ctx } = camera;
    ctx.setTransform(1, 0, 0, 1, 0, 0);
    ctx.clearRect(0, 0, camera.canvas.width, camera.canvas.height);
    camera.canvas.setAttribute("aria-label", shot ? `Side view. ${this.title.textContent}. ${this.caption.textContent}` : this.title.textContent);
    if (!shot) return;
    ctx.save();
    camera.toScreen(ctx);
    ctx.beginPath();
    ctx.rect(camera.margin.left, 0, camera.width, camera.height - camera.margin.bottom + 4);
    ctx.clip();
    this.drawGrid(ctx);
    camera.toPlane(ctx);
    this.drawProfile(ctx);
    this.drawFlight(ctx, t);
    ctx.restore();
    this.drawAxes(ctx);
  }

  step() { return roundStep(46 / this.camera.scale); }

  /** Calls back with every round coordinate in sight. */
  rounds(axis, use) {
    const { camera } = this;
    const step = this.step();
    const low = camera.plane({ x: 0, y: camera.height });
    const high = camera.plane({ x: camera.width, y: 0 });
    for (let k = Math.ceil(low[axis] / step); k * step <= high[axis]; ++k) use(k * step);
  }

  drawGrid(ctx) {
    const { camera } = this;
    ctx.strokeStyle = theme.grid;
    ctx.lineWidth = 1;
    ctx.beginPath();
    this.rounds("x", (s) => { const { x } = camera.screen(s, 0); ctx.moveTo(x, 0); ctx.lineTo(x, camera.height); });
    this.rounds("y", (z) => { const { y } = camera.screen(0, z); ctx.moveTo(0, y); ctx.lineTo(camera.width, y); });
    ctx.stroke();
  }

  drawProfile(ctx) {
    const { camera, shot } = this;
    for (const { name, polygon } of shot.profile) {
      if (polygon.length < 2) continue;
      const mine = name === shot.target;
      const path = new Path2D();
      for (const [s, z] of polygon) path.lineTo(s, z);
      path.closePath();
      ctx.fillStyle = mine ? statusColour(this.target?.status) : theme["solid-low"];
      ctx.globalAlpha = mine ? 0.4 : 1;
      ctx.fill(path);
      ctx.globalAlpha = 1;
      ctx.strokeStyle = mine ? statusColour(this.target?.status) : theme["solid-high"];
      ctx.lineWidth = camera.px(mine ? 2 : 1);
      ctx.stroke(path);
    }
  }

  drawFlight(ctx, t) {
    const { camera, shot, near } = this;
    const flight = shot.end_s - shot.time_s;
    const curve = (until) => {
      ctx.beginPath();
      for (let i = 0; i <= 96; ++i) {
        const { s, z } = ballAt(shot, (until * i) / 96);
        ctx.lineTo(s, z);
      }
    };
    const angle = Math.atan2(shot.up, shot.across);
    const length = Math.max(finite(robot.gun_length_m), 0.1);
    ctx.lineCap = "round";
    ctx.lineJoin = "round";
    ctx.strokeStyle = theme.robot;
    ctx.lineWidth = Math.max(camera.px(4), 0.03);
    ctx.beginPath();
    ctx.moveTo(-length * Math.cos(angle), shot.from[2] - length * Math.sin(angle));
    ctx.lineTo(0, shot.from[2]);
    ctx.stroke();
    ctx.lineCap = "butt";

    const colour = shot.hit ? theme.water : theme.failed;
    ctx.strokeStyle = colour;
    curve(flight);
    for (const [width, alpha] of [[2 * (robot.ball_radius_m + robot.margin_m), 0.18], [2 * robot.ball_radius_m, 0.35]]) {
      ctx.lineWidth = width;
      ctx.globalAlpha = alpha;
      ctx.stroke();
    }
    ctx.globalAlpha = 1;
    ctx.lineWidth = camera.px(1.5);
    ctx.stroke();
    if (near?.here) this.drawNear(ctx);

    const end = ballAt(shot, flight);
    ctx.strokeStyle = theme.ink;
    ctx.lineWidth = camera.px(1.6);
    const arm = camera.px(6);
    ctx.beginPath();
    ctx.moveTo(end.s - arm, end.z - arm);
    ctx.lineTo(end.s + arm, end.z + arm);
    ctx.moveTo(end.s - arm, end.z + arm);
    ctx.lineTo(end.s + arm, end.z - arm);
    ctx.stroke();
    const age = t - shot.time_s;
    if (age >= 0 && age < flight) {
      const ball = ballAt(shot, age);
      ctx.fillStyle = colour;
      ctx.beginPath();
      ctx.arc(ball.s, ball.z, Math.max(robot.ball_radius_m, camera.px(4.5)), 0, 2 * Math.PI);
      ctx.fill();
    }
  }

  drawNear(ctx) {
    const { camera } = this;
    const { ball, near, clearance } = this.near;
    ctx.strokeStyle = theme.ink;
    ctx.lineWidth = camera.px(1.2);
    ctx.beginPath();
    ctx.moveTo(ball.s, ball.z);
    ctx.lineTo(near.x, near.y);
    ctx.stroke();
    ctx.beginPath();
    ctx.arc((ball.s + near.x) / 2, (ball.z + near.y) / 2, Math.max(camera.px(7), 0.8 * near.distance), 0, 2 * Math.PI);
    ctx.setLineDash([camera.px(2), camera.px(2)]);
    ctx.stroke();
    ctx.setLineDash([]);
    camera.toScreen(ctx);
    const at = camera.screen((ball.s + near.x) / 2, (ball.z + near.y) / 2);
    const reach = Math.max(7, 0.8 * near.distance * camera.scale);
    const text = `${fixed(clearance, 3)} m`;
    ctx.font = `600 11px ${theme.sans}`;
    ctx.textBaseline = "middle";
    ctx.textAlign = "center";
    ctx.strokeStyle = theme.panel;
    ctx.lineWidth = 3.5;
    ctx.lineJoin = "round";
    ctx.strokeText(text, at.x, at.y - reach - 9);
    ctx.fillStyle = theme.ink;
    ctx.fillText(text, at.x, at.y - reach - 9);
    camera.toPlane(ctx);
  }

  drawAxes(ctx) {
    const { camera } = this;
    camera.toScreen(ctx);
    const left = camera.margin.left;
    const base = camera.height - camera.margin.bottom + 4;
    ctx.strokeStyle = theme.soft;
    ctx.lineWidth = 1;
    ctx.beginPath();
    ctx.moveTo(left + 0.5, 0);
    ctx.lineTo(left + 0.5, base + 0.5);
    ctx.lineTo(camera.width, base + 0.5);
    ctx.stroke();
    ctx.font = `10.5px ${theme.sans}`;
    ctx.fillStyle = theme.soft;
    const digits = Math.max(0, -Math.floor(Math.log10(this.step()) + 1e-9));
    ctx.textAlign = "center";
    ctx.textBaseline = "top";
    this.rounds("x", (s) => {
      const { x } = camera.screen(s, 0);
      if (x > left + 8 && x < camera.width - 34) ctx.fillText(fixed(s, digits), x, base + 5);
    });
    ctx.textAlign = "right";
    ctx.fillText("m", camera.width - 12, base + 5);
    ctx.textBaseline = "middle";
    this.rounds("y", (z) => {
      const { y } = camera.screen(0, z);
      if (y > 8 && y < base - 4) ctx.fillText(fixed(z, digits), left - 6, y);
    });
  }
}

