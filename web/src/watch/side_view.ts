// The side view: the vertical plane of one shot, both axes in metres at the same scale.
import { Camera, type Box } from "../base/camera";
import { h, iconButton } from "../base/dom";
import { clamp, degrees, fixed, roundStep } from "../base/numbers";
import { statusColour } from "../base/signs";
import { onTheme, theme } from "../base/theme";
import { ballOf, blockedOf, flightsOf, type Flight } from "../log/flights";
import type { Run } from "../log/run";
import { targetsOf, type TargetStory } from "../log/targets";
import { leastClearance, type Near } from "./clearance";

const margin = { left: 40, right: 16, top: 8, bottom: 26 };

export class SideView {
  readonly element: HTMLElement;
  private title = h("h2");
  private caption = h("p", { class: "caption" });
  private canvas = h("canvas", { tabindex: 0, role: "img", "aria-label": "Side view" });
  private nearButton = iconButton("near", "Place of least clearance", () => this.showNear());
  private camera: Camera;
  private shot: Flight | null = null;
  private target: TargetStory | null = null;
  private near: Near | null = null;
  private off: () => void;

  constructor(private run: Run, private redraw: () => void) {
    this.element = h("section", { class: "side", "aria-label": "Side view of the selected shot" }, this.title,
      h("div", { class: "view" }, this.canvas, h("div", { class: "camera", role: "group", "aria-label": "Side view" },
        this.nearButton, iconButton("fit", "Show the whole flight", () => this.camera.reset()))), this.caption);
    this.camera = new Camera(this.canvas, [0, 0, 6, 2], { redraw: () => this.redraw() }, margin);
    this.off = onTheme(redraw);
  }

  close(): void {
    this.off();
    this.camera.close();
  }

  /** The same shot, of a run that has gone on. */
  renew(run: Run): void {
    this.run = run;
    this.target = this.named(this.target?.name);
    this.shot = (this.shot && flightsOf(run)[this.shot.index]) ?? this.blocked;
    this.describe();
  }

  private named(name: string | undefined): TargetStory | null { return targetsOf(this.run).find((one) => one.name === name) ?? null; }

  select(shot: Flight | null, target: TargetStory | null): void {
    const chosen = this.named(shot?.target) ?? target;
    if (chosen === this.target && (shot ?? this.blockedAt(chosen)) === this.shot) return;
    this.target = chosen;
    this.shot = shot ??= this.blocked;
    this.near = shot && shot.index >= 0 ? leastClearance(this.run, shot) : null;
    this.nearButton.hidden = !this.near?.here;
    this.describe();
    if (shot) this.camera.show(this.frame(shot));
  }

  private get blocked(): Flight | null { return this.blockedAt(this.target); }
  private blockedAt(target: TargetStory | null): Flight | null { return (target && blockedOf(this.run).get(target.name)) ?? null; }

  /** The flight, the target and what stands under and beside them. */
  private frame(shot: Flight): Box {
    const flight = shot.end - shot.start;
    let right = ballOf(this.run, shot, flight).s;
    let top = shot.from[2];
    for (let i = 0; i <= 40; ++i) top = Math.max(top, ballOf(this.run, shot, (flight * i) / 40).z);
    for (const { name, polygon } of shot.profile) {
      if (name !== shot.target) continue;
      for (const [s, z] of polygon) {
        if (Math.abs(s) > 100 || Math.abs(z) > 100) continue;
        right = Math.max(right, s);
        top = Math.max(top, z);
      }
    }
    return [-this.run.info.gun_length - 0.35, Math.min(0, shot.to[2]) - 0.15, right + 0.5, top + 0.2];
  }

  private showNear(): void {
    if (!this.near) return;
    const { ball, near } = this.near;
    const half = clamp(1.3 * near.distance, 0.08, 0.6);
    const [x, y] = [(ball.s + near.x) / 2, (ball.z + near.y) / 2];
    this.camera.fit([x - half, y - half, x + half, y + half]);
    this.redraw();
  }

  private describe(): void {
    const { shot, target } = this;
    if (!shot) {
      this.title.replaceChildren(target ? `No shot at ${target.name}` : "No shot was fired");
      this.caption.replaceChildren(target?.last.reason ?? "");
      return;
    }
    const angle = degrees(Math.atan2(shot.up, shot.across));
    if (shot.index < 0) {
      this.title.replaceChildren(`No shot at ${shot.target} `, h("span", {}, `the best flight is blocked by ${shot.contact}`));
      const [x, y, z] = shot.to.map((value) => fixed(value, 2));
      this.caption.replaceChildren(`${fixed(shot.speed, 2)} m/s at ${angle} from (${fixed(shot.from[0], 2)}, ${fixed(shot.from[1], 2)}). It meets `, h("b", {}, shot.contact), ` at (${x}, ${y}, ${z}).`);
      return;
    }
    const outcome = shot.hit ? "hit" : `touched ${shot.contact || "nothing"}`;
    this.title.replaceChildren(`Shot ${shot.index + 1} at ${shot.target} `, h("span", {}, `try ${shot.attempt}, ${outcome}`));
    this.caption.replaceChildren(`${fixed(shot.speed, 2)} m/s at ${angle}, ${fixed(shot.along, 2)} m in ${fixed(shot.end - shot.start, 2)} s. Clearance `,
      h("b", {}, `${fixed(shot.clearance, 3)} m`), this.whereNear(shot));
  }

  private whereNear(shot: Flight): string {
    const { margin: kept } = this.run.info;
    const asked = kept > 0 ? ` (${fixed(kept, 3)} m kept in planning)` : "";
    if (!Number.isFinite(shot.clearance)) return ".";
    return this.near?.here ? `, to ${this.near.name}${asked}.` : `, to something beside this plane${asked}.`;
  }

  draw(t: number): void {
    const { camera, shot } = this;
    const { ctx } = camera;
    ctx.setTransform(1, 0, 0, 1, 0, 0);
    ctx.clearRect(0, 0, this.canvas.width, this.canvas.height);
    if (!shot) return;
    ctx.save();
    camera.toScreen(ctx);
    ctx.beginPath();
    ctx.rect(margin.left, 0, camera.width, camera.height - margin.bottom + 4);
    ctx.clip();
    this.drawGrid(ctx);
    camera.toPlane(ctx);
    this.drawProfile(ctx, shot);
    this.drawFlight(ctx, shot, t);
    if (this.near?.here) this.drawNear(ctx, this.near);
    ctx.restore();
    this.drawAxes(ctx);
  }

  private get step(): number { return roundStep(46 / this.camera.scale); }

  /** Calls back with every round coordinate in sight. */
  private rounds(axis: "x" | "y", use: (value: number) => void): void {
    const { camera, step } = this;
    const low = camera.plane({ x: 0, y: camera.height })[axis];
    const high = camera.plane({ x: camera.width, y: 0 })[axis];
    for (let k = Math.ceil(low / step); k * step <= high; ++k) use(k * step);
  }

  private drawGrid(ctx: CanvasRenderingContext2D): void {
    const { camera } = this;
    ctx.strokeStyle = theme.grid;
    ctx.lineWidth = 1;
    ctx.beginPath();
    this.rounds("x", (s) => { const { x } = camera.screen(s, 0); ctx.moveTo(x, 0); ctx.lineTo(x, camera.height); });
    this.rounds("y", (z) => { const { y } = camera.screen(0, z); ctx.moveTo(0, y); ctx.lineTo(camera.width, y); });
    ctx.stroke();
  }

  private drawProfile(ctx: CanvasRenderingContext2D, shot: Flight): void {
    const status = statusColour(this.target?.status ?? "");
    for (const { name, polygon } of shot.profile) {
      if (polygon.length < 2) continue;
      const mine = name === shot.target;
      ctx.beginPath();
      for (const [s, z] of polygon) ctx.lineTo(s, z);
      ctx.closePath();
      ctx.fillStyle = mine ? status : theme["solid-low"];
      ctx.globalAlpha = mine ? 0.4 : 1;
      ctx.fill();
      ctx.globalAlpha = 1;
      ctx.strokeStyle = mine ? status : theme["solid-high"];
      ctx.lineWidth = this.camera.px(mine ? 2 : 1);
      ctx.stroke();
    }
  }

  private drawFlight(ctx: CanvasRenderingContext2D, shot: Flight, t: number): void {
    const { camera, run } = this;
    const { ball_radius: ball, margin: kept, gun_length } = run.info;
    const flight = shot.end - shot.start;
    const angle = Math.atan2(shot.up, shot.across);
    const length = Math.max(gun_length, 0.1);
    ctx.lineCap = ctx.lineJoin = "round";
    ctx.strokeStyle = theme.robot;
    ctx.lineWidth = Math.max(camera.px(4), 0.03);
    ctx.beginPath();
    ctx.moveTo(-length * Math.cos(angle), shot.from[2] - length * Math.sin(angle));
    ctx.lineTo(0, shot.from[2]);
    ctx.stroke();
    ctx.lineCap = "butt";
    ctx.strokeStyle = ctx.fillStyle = shot.hit ? theme.water : theme.failed;
    ctx.beginPath();
    for (let i = 0; i <= 96; ++i) {
      const { s, z } = ballOf(run, shot, (flight * i) / 96);
      ctx.lineTo(s, z);
    }
    for (const [width, alpha] of [[2 * (ball + kept), 0.18], [2 * ball, 0.35], [camera.px(1.5), 1]] as const) {
      ctx.lineWidth = width;
      ctx.globalAlpha = alpha;
      ctx.stroke();
    }
    const age = t - shot.start;
    const at = ballOf(run, shot, clamp(age, 0, flight));
    ctx.beginPath();
    ctx.arc(at.s, at.z, Math.max(ball, camera.px(4.5)), 0, 2 * Math.PI);
    if (age >= 0) ctx.fill();
  }

  private drawNear(ctx: CanvasRenderingContext2D, { ball, near, clearance }: Near): void {
    const { camera } = this;
    const [x, y] = [(ball.s + near.x) / 2, (ball.z + near.y) / 2];
    const reach = Math.max(camera.px(7), 0.8 * near.distance);
    ctx.strokeStyle = theme.ink;
    ctx.lineWidth = camera.px(1.2);
    ctx.beginPath();
    ctx.moveTo(ball.s, ball.z);
    ctx.lineTo(near.x, near.y);
    ctx.stroke();
    ctx.beginPath();
    ctx.arc(x, y, reach, 0, 2 * Math.PI);
    ctx.setLineDash([camera.px(2), camera.px(2)]);
    ctx.stroke();
    ctx.setLineDash([]);
    camera.toScreen(ctx);
    const at = camera.screen(x, y + reach);
    ctx.font = `600 11px ${theme.sans}`;
    ctx.textBaseline = "middle";
    ctx.textAlign = "center";
    ctx.strokeStyle = theme.panel;
    ctx.lineWidth = 3.5;
    ctx.strokeText(`${fixed(clearance, 3)} m`, at.x, at.y - 9);
    ctx.fillStyle = theme.ink;
    ctx.fillText(`${fixed(clearance, 3)} m`, at.x, at.y - 9);
  }

  private drawAxes(ctx: CanvasRenderingContext2D): void {
    const { camera } = this;
    camera.toScreen(ctx);
    const [left, base] = [margin.left, camera.height - margin.bottom + 4];
    ctx.strokeStyle = ctx.fillStyle = theme.soft;
    ctx.lineWidth = 1;
    ctx.beginPath();
    ctx.moveTo(left + 0.5, 0);
    ctx.lineTo(left + 0.5, base + 0.5);
    ctx.lineTo(camera.width, base + 0.5);
    ctx.stroke();
    ctx.font = `10.5px ${theme.sans}`;
    const digits = Math.max(0, -Math.floor(Math.log10(this.step) + 1e-9));
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
