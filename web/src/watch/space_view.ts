// The view in space: the same run in three dimensions. Loaded when it is first asked for, since three.js is large.
import { AmbientLight, Box3, type BufferGeometry, Color, DirectionalLight, Group, Line, Mesh, type MeshLambertMaterial, type Object3D, PerspectiveCamera, Points, Raycaster, Scene,
  Sprite, Vector2, Vector3, WebGLRenderer } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import type { Box } from "../base/camera";
import { h, iconButton } from "../base/dom";
import { clamp } from "../base/numbers";
import { onTheme, theme } from "../base/theme";
import type { Run } from "../log/run";
import { bodiesOf } from "../log/world";
import { areaOf } from "./area";
import type { Now } from "./layer";
import type { LayerChoice } from "./layer_choice";
import { coverActor } from "./space_cover";
import { stillWorld } from "./space_ground";
import { mapActor } from "./space_map";
import { mappingActor, sensedActor } from "./space_mapping";
import { labelActor, placeTexts, type Area } from "./space_labels";
import { stationActor, waypointActor, wayActor } from "./space_marks";
import type { Actor } from "./space_parts";
import { candidateActor, firingMapActor, tourActor } from "./space_planning";
import { beliefActor, robotActor } from "./space_robot";
import { eyeActor } from "./space_sight";
import { blockedActor, pursuitActor, targetActor, waterActor } from "./space_targets";

/** Each makes what it has messages of, by the name of its layer. */
const actorsOf: [string, (run: Run) => Actor[]][] = [["robot", robotActor], ["belief", beliefActor], ["map", mapActor], ["range finder", sensedActor], ["camera", eyeActor],
  ["landmarks", mappingActor], ["firing map", firingMapActor], ["planned tour", tourActor], ["path", waypointActor], ["path", wayActor], ["stations", stationActor],
  ["covered area", coverActor], ["targets", targetActor], ["candidates", candidateActor], ["names", labelActor], ["blocked flights", blockedActor], ["shots", waterActor],
  ["pursuit", pursuitActor]];

/** Draws a group as strongly as is chosen, whatever its materials are by themselves. */
function veil(group: Object3D, opacity: number): void {
  group.visible = opacity > 0;
  if (opacity === 1 && !group.userData.veiled) return;
  group.userData.veiled = true;
  group.traverse((thing) => {
    for (const material of [(thing as Mesh).material ?? []].flat()) {
      material.userData.own ??= { opacity: material.opacity, transparent: material.transparent };
      const own = material.userData.own as { opacity: number; transparent: boolean };
      material.opacity = own.opacity * opacity;
      material.transparent = own.transparent || opacity < 1;
    }
  });
}

const boxCorners = ({ min, max }: Box3): Vector3[] =>
  [min.x, max.x].flatMap((x) => [min.y, max.y].flatMap((y) => [min.z, max.z].map((z) => new Vector3(x, y, z)))).filter(({ x, y, z }) => Number.isFinite(x + y + z));

/** Gives back what a thing and its parts hold of the graphics card. */
function dispose(whole: Object3D): void {
  whole.traverse((thing) => {
    if (!(thing instanceof Mesh || thing instanceof Line || thing instanceof Points || thing instanceof Sprite)) return;
    if (!(thing instanceof Sprite)) (thing.geometry as BufferGeometry).dispose();  // all sprites share one
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
  private groups: { name: string; group: Group }[] = [];
  private drawn: Run | null = null;
  private now: Now = { t: 0, shot: null, target: null, speed: 0 };
  private free_px = 0;   // above
  private covered: Area[] = [];  // by its buttons
  private home = true;  // nobody moved the view
  private area: Box;
  private watcher: ResizeObserver;
  private off: () => void;

  constructor(private run: Run, private redraw: () => void, private choice: LayerChoice, private clicked: (x: number, y: number, now: Now) => void) {
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
    this.listen();
    this.controls.addEventListener("start", () => { this.home = false; });
    const sun = new DirectionalLight("#ffffff", 1.7);
    sun.position.set(-6, -9, 14);
    this.scene.add(new AmbientLight("#ffffff", 1.9), sun, this.still, this.moving);
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
    if (grew || !drawn || bodiesOf(run) !== bodiesOf(drawn)) {
      this.scene.background = new Color(theme.panel);
      this.still = this.exchanged(this.still, stillWorld(run, area));
      if (this.home) this.frameAll();
    }
    this.moving = this.exchanged(this.moving, new Group());
    this.actors = [];
    this.groups = actorsOf.flatMap(([name, make]) => {
      const made = make(run);
      const group = new Group();
      for (const { things } of made) for (const thing of things) group.add(thing);
      this.moving.add(group);
      this.actors.push(...made.flatMap(({ act }) => act ?? []));
      return made.length > 0 ? [{ name, group }] : [];
    });
  }

  /** Exchanges groups; the old one is disposed of after the next frame, which then needs no new shaders for the new one. */
  private exchanged(old: Group, made: Group): Group {
    this.scene.remove(old);
    this.scene.add(made);
    this.spent.push(old);
    return made;
  }

  get names(): string[] { return ["obstacles", ...new Set(this.groups.flatMap(({ name }) => name || []))]; }

  zoom(factor: number): void {
    this.home = false;
    const away = this.camera.position.clone().sub(this.controls.target).multiplyScalar(factor);
    this.camera.position.copy(this.controls.target).add(away);
    this.controls.update();
  }

  reset(): void {
    this.follow = false;
    this.frameAll();
    this.redraw();
  }

  /** Keeps this many pixels free above what is shown. */
  headroom(pixels: number): void {
    if (pixels === this.free_px) return;
    this.free_px = pixels;
    this.resize();
  }

  /** Shows the ground and what stands on it as large as possible, from the south. */
  private frameAll(): void {
    this.home = true;
    const [x0, y0, x1, y1] = this.area;
    const corners = [...boxCorners(new Box3(new Vector3(x0, y0, 0), new Vector3(x1, y1, 0))), ...this.still.children.flatMap((one) => boxCorners(new Box3().setFromObject(one)))];
    const middle = new Vector3((x0 + x1) / 2, (y0 + y1) / 2, 0);
    const { canvas: { clientHeight: tall }, camera } = this;
    const top = 1 - (2 * Math.min(0.5 * tall, this.free_px)) / Math.max(1, tall);
    const place = (size: number): void => {
      camera.position.set(middle.x, middle.y - 0.85 * size, 1.1 * size);
      camera.lookAt(middle);
      [camera.near, camera.far] = [0.01 * size, 10 * size];
      camera.updateProjectionMatrix();
      camera.updateMatrixWorld();
    };
    const fits = (size: number): boolean => {
      place(size);
      return corners.every((corner) => {
        const { x, y, z } = corner.clone().project(camera);
        return z < 1 && Math.abs(x) < 0.96 && y > -0.96 && y < top - 0.02;
      });
    };
    let [low, high] = [0.2, 4].map((share) => share * Math.max(1e-3, x1 - x0, y1 - y0)) as [number, number];
    for (let i = 0; i < 12; ++i) {
      const half = (low + high) / 2;
      if (fits(half)) high = half;
      else low = half;
    }
    place(high);
    this.controls.target.copy(middle);
    this.controls.update();
  }

  /** A click, no drag, selects what is there. */
  private listen(): void {
    let pressed: [number, number] = [0, 0];
    this.canvas.addEventListener("pointerdown", (event) => { pressed = [event.clientX, event.clientY]; });
    this.canvas.addEventListener("click", (event) => {
      if (Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) > 4) return;
      const { left, top, width, height } = this.canvas.getBoundingClientRect();
      const ray = new Raycaster();
      ray.setFromCamera(new Vector2((2 * (event.clientX - left)) / width - 1, 1 - (2 * (event.clientY - top)) / height), this.camera);
      const [hit] = ray.intersectObjects([this.still, this.moving], true).filter(({ object }) => object instanceof Mesh && object.visible);
      if (!hit) return;
      const { x, y } = hit.point.addScaledVector(ray.ray.direction, 0.02);  // within what was hit, not on its face
      this.clicked(x, y, this.now);
    });
  }

  private resize(): void {
    if (this.canvas.clientWidth === 0) return;  // hidden: it keeps its view until it is shown again
    const [width, height] = [Math.max(1, this.canvas.clientWidth), Math.max(1, this.canvas.clientHeight)];
    this.covered = [...this.element.querySelectorAll<HTMLElement>(".camera")].map(({ offsetLeft: x, offsetTop: y, offsetWidth, offsetHeight }): Area => [x, y, x + offsetWidth, y + offsetHeight]);
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio || 1));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.setViewOffset(width, height, 0, -Math.min(0.25 * height, 0.5 * this.free_px), width, height);
    if (this.home) this.frameAll();
    this.redraw();
  }

  draw(now: Now): void {
    this.now = now;
    if (this.run !== this.drawn) this.bringUpToDate();
    for (const act of this.actors) act(now);
    for (const { name, group } of [...this.groups, { name: "obstacles", group: this.still }]) veil(group, this.choice.of(name));
    if (this.follow) this.followRobot(now.t);
    this.placeTexts();
    this.renderer.render(this.scene, this.camera);
    for (const old of this.spent.splice(0)) dispose(old);
  }

  private placeTexts(): void {
    this.camera.updateMatrixWorld();
    const texts: Sprite[] = [];
    this.moving.traverseVisible((thing) => { if (thing instanceof Sprite) texts.push(thing); });
    this.element.dataset.names = String(placeTexts(texts, this.camera, this.canvas.clientWidth, this.canvas.clientHeight, this.covered));
  }

  /** Keeps the robot in the middle, from the side that was chosen. */
  private followRobot(t: number): void {
    const at = this.run.track.at(t);
    const offset = this.camera.position.clone().sub(this.controls.target);
    const reach = clamp(offset.length(), 1, 6 * Math.max(1, this.run.radius));
    this.controls.target.set(at.x, at.y, this.run.height(at.x, at.y) + 0.2);
    this.camera.position.copy(this.controls.target).add(offset.setLength(reach));
  }
}
