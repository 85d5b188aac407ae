// The view in space: the same run in three dimensions. Loaded when it is first asked for, since three.js is large.
import { AmbientLight, BoxGeometry, BufferGeometry, Color, DirectionalLight, EdgesGeometry, Float32BufferAttribute,
  Group, Line, LineBasicMaterial, LineSegments, Mesh, type MeshLambertMaterial, type Object3D, PerspectiveCamera, Points, RingGeometry, Scene, SphereGeometry, WebGLRenderer } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import type { Box } from "../base/camera";
import { h, iconButton } from "../base/dom";
import { clamp, finite } from "../base/numbers";
import { statusColour } from "../base/signs";
import { pursuerColours, onTheme, theme } from "../base/theme";
import type { Flight, Run } from "../report/run";
import type { Target } from "../report/types";
import { areaOf } from "./area";
import { costPicture, placeOnWay } from "./pursuit_layer";
import type { Now } from "./layer";
import { coverActor } from "./space_cover";
import { stillWorld } from "./space_ground";
import { mapActor } from "./space_map";
import { decisionActor, stationActor, stopActor } from "./space_marks";
import { carpet, lambert, lineOf } from "./space_parts";
import { beliefActor, robotActor } from "./space_robot";
import { eyeActor, laserActor } from "./space_sight";
import { slamActor } from "./space_slam";

/** Gives back what a thing and its parts hold of the graphics card. */
function dispose(whole: Object3D): void {
  whole.traverse((thing) => {
    if (!(thing instanceof Mesh || thing instanceof Line || thing instanceof Points)) return;
    (thing.geometry as BufferGeometry).dispose();
    for (const material of [thing.material].flat() as MeshLambertMaterial[]) {
      material.map?.dispose();
      material.dispose();
    }
  });
}

export class SpaceView {
  readonly element: HTMLElement;
  readonly canvas = h("canvas", { tabindex: 0, role: "img", "aria-label": "View in space" });
  follow = false;
  private renderer: WebGLRenderer;
  private camera = new PerspectiveCamera(42, 1, 0.05, 500);
  private controls: OrbitControls;
  private scene = new Scene();
  private still = new Group();   // the world
  private moving = new Group();  // what the run tells
  private spent: Group[] = [];   // taken away since the last frame
  private actors: ((now: Now) => void)[] = [];
  private drawn: Run | null = null;
  private home = true;  // nobody moved the view
  private area: Box;
  private watcher: ResizeObserver;
  private off: () => void;

  constructor(private run: Run, private redraw: () => void) {
    this.area = areaOf(run);
    this.renderer = new WebGLRenderer({ canvas: this.canvas, antialias: true, preserveDrawingBuffer: true });
    this.element = h("div", { class: "view space-view" }, this.canvas,
      h("div", { class: "camera", role: "group", "aria-label": "View" },
        iconButton("in", "Zoom in", () => this.zoom(1 / 1.3), "+"), iconButton("out", "Zoom out", () => this.zoom(1.3), "-"),
        iconButton("fit", "Show everything", () => this.reset(), "0")));
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.maxPolarAngle = 0.495 * Math.PI;
    this.controls.addEventListener("change", redraw);
    this.controls.addEventListener("start", () => { this.home = false; });
    const sun = new DirectionalLight("#ffffff", 1.7);
    sun.position.set(-6, -9, 14);
    this.scene.add(new AmbientLight("#ffffff", 1.9), sun, this.still, this.moving);
    this.frameAll();
    this.watcher = new ResizeObserver(() => this.resize());
    this.watcher.observe(this.canvas);
    this.off = onTheme(() => { this.drawn = null; redraw(); });
  }

  close(): void {
    this.off();
    this.watcher.disconnect();
    this.controls.dispose();
    dispose(this.scene);
    this.renderer.dispose();
  }

  /** Shows another run, or more of the same one, from its next frame on; a view that somebody moved stays. */
  renew(run: Run): void { this.run = run; }

  private bringUpToDate(): void {
    const { run, drawn } = this;
    this.drawn = run;
    const area = areaOf(run);
    const grew = area.some((value, i) => value !== this.area[i]);
    this.area = area;
    if (grew && this.home) this.frameAll();
    if (grew || run.report.world !== drawn?.report.world) {
      this.scene.background = new Color(theme.panel);
      this.still = this.exchanged(this.still, stillWorld(run, area));
    }
    this.moving = this.exchanged(this.moving, new Group());
    this.actors = [];
    for (const make of [robotActor, beliefActor, mapActor, laserActor, eyeActor, slamActor, stopActor, decisionActor, stationActor, coverActor]) {
      for (const { things, act } of make(this.run)) {
        this.moving.add(...things);
        if (act) this.actors.push(act);
      }
    }
    for (const target of this.run.report.targets) this.addTarget(target);
    if (this.run.flights.length > 0) this.addWater();
    this.addPursuit();
  }

  /** What is taken away is disposed of after the next frame, which then needs no new shaders for what came instead. */
  private exchanged(old: Group, made: Group): Group {
    this.scene.remove(old);
    this.scene.add(made);
    this.spent.push(old);
    return made;
  }

  private addTarget(target: Target): void {
    const [length = 0.3, width = 0.3, height = 0.3] = target.size.map((value) => Math.max(0.02, finite(value)));
    const material = lambert(theme.waiting, 0.92);
    const box = new Mesh(new BoxGeometry(length, width, height), material);
    box.rotation.z = finite(target.box_yaw_rad);
    box.add(new LineSegments(new EdgesGeometry(box.geometry), new LineBasicMaterial({ color: theme.ink })));
    const halo = new Mesh(new RingGeometry(0.32, 0.38, 40), lambert(theme.ink));
    this.moving.add(box, halo);
    this.actors.push((now) => {
      const place = this.run.place(target, now.t);
      box.visible = place !== null;
      halo.visible = place !== null && now.target === target;
      if (!place) return;
      box.position.set(place[0], place[1], finite(target.centre[2]));
      halo.position.set(place[0], place[1], finite(target.centre[2]) - height / 2 + 0.015);
      material.color.set(statusColour(this.run.status(target, now.t)));
    });
  }

  /** The flight of the ball, or of the selected shot while none is in the air. */
  private addWater(): void {
    const ball = new Mesh(new SphereGeometry(Math.max(0.05, 2 * finite(this.run.report.robot.ball_radius_m)), 20, 14), lambert(theme.water));
    const samples = 48;
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new Float32BufferAttribute(new Float32Array(3 * (samples + 1)), 3));
    const material = new LineBasicMaterial({ color: theme.water });
    const curve = new Line(geometry, material);
    curve.frustumCulled = false;
    this.moving.add(ball, curve);
    const draw = (shot: Flight, until: number): void => {
      const positions = geometry.getAttribute("position");
      for (let i = 0; i <= samples; ++i) {
        const { x, y, z } = this.run.ball(shot, (until * i) / samples);
        positions.setXYZ(i, x, y, z);
      }
      positions.needsUpdate = true;
      material.color.set(shot.hit ? theme.water : theme.failed);
    };
    this.actors.push(({ t, shot }) => {
      const flying = this.run.flights.find((one) => t >= one.start && t < one.end);
      ball.visible = flying !== undefined;
      const shown = flying ?? shot;
      curve.visible = shown !== null;
      if (shown) draw(shown, flying ? t - shown.start : shown.end - shown.start);
      if (!flying) return;
      const { x, y, z } = this.run.ball(flying, t - flying.start);
      ball.position.set(x, y, z);
    });
  }

  private addPursuit(): void {
    const { pursuit, world } = this.run.report;
    if (!pursuit || !world.bounds) return;
    const [x, y] = world.bounds[0];
    this.moving.add(carpet(costPicture(this.run), [x, y, x + pursuit.columns * pursuit.cell_m, y + pursuit.rows * pursuit.cell_m], 0).mesh);
    const size = 0.6 * pursuit.cell_m;
    [pursuit.target, ...pursuit.robots].forEach((way, i) => {
      const colour = i === 0 ? theme.failed : pursuerColours()[(i - 1) % pursuerColours().length]!;
      const body = new Mesh(new SphereGeometry(size, 20, 14), lambert(colour));
      this.moving.add(body, lineOf(way.map(([wx, wy]) => [wx, wy, 0.1]), colour));
      this.actors.push(({ t }) => body.position.set(...placeOnWay(way, t), size));
    });
  }

  zoom(factor: number): void {
    this.home = false;
    const away = this.camera.position.clone().sub(this.controls.target).multiplyScalar(factor);
    this.camera.position.copy(this.controls.target).add(away);
    this.controls.update();
  }

  reset(): void {
    this.follow = false;
    this.frameAll();
  }

  private frameAll(): void {
    this.home = true;
    const [x0, y0, x1, y1] = this.area;
    const size = Math.max((x1 - x0) / Math.max(0.6, this.camera.aspect) * 1.1, y1 - y0);
    this.controls.target.set((x0 + x1) / 2, (y0 + y1) / 2, 0);
    this.camera.position.set((x0 + x1) / 2, (y0 + y1) / 2 - 0.85 * size, 1.1 * size);
    this.camera.near = 0.01 * size;
    this.camera.far = 10 * size;
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.redraw();
  }

  private resize(): void {
    const [width, height] = [Math.max(1, this.canvas.clientWidth), Math.max(1, this.canvas.clientHeight)];
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio || 1));
    this.renderer.setSize(width, height, false);
    const first = this.camera.aspect === 1;
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    if (first) this.frameAll();
    this.redraw();
  }

  draw(now: Now): void {
    if (this.run !== this.drawn) this.bringUpToDate();
    for (const act of this.actors) act(now);
    if (this.follow) this.followRobot(now.t);
    this.renderer.render(this.scene, this.camera);
    for (const old of this.spent.splice(0)) dispose(old);
  }

  /** Keeps the robot in the middle, from the side that was chosen. */
  private followRobot(t: number): void {
    const at = this.run.track.at(t);
    const offset = this.camera.position.clone().sub(this.controls.target);
    const reach = clamp(offset.length(), 1, 6 * Math.max(1, finite(this.run.report.robot.radius_m)));
    this.controls.target.set(at.x, at.y, this.run.height(at.x, at.y) + 0.2);
    this.camera.position.copy(this.controls.target).add(offset.setLength(reach));
  }
}
