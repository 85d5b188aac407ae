// A yard that is edited by hand: its robot, targets, things of the world, and added obstacles.
import type { ScenarioAnswer, YardRequest, YardTarget, YardThing } from "../api";
import { nearestOnPolygon, type Vec2 } from "../base/outline";
import { newName } from "./names";
import { wrapAngle } from "./turning";

export type YardScenario = Exclude<ScenarioAnswer, { goal: unknown }>;
/** Describes an added obstacle: a box centred at `middle`. */
export interface YardBox { middle: Vec2; size: Vec2; turn_rad: number }
export interface Item { what: "robot" | "target" | "thing" | "box"; index: number }

interface Changes { start: Vec2; heading_rad: number; targets: YardTarget[]; things: Pick<YardThing, "place" | "turn_rad" | "removed">[]; boxes: YardBox[] }

const most_steps = 200;
const cat: [number, number, number] = [0.5, 0.205, 0.372];

/** Moves a polygon from one place to another and turns it about that place. */
export function placed(polygon: Vec2[], [mx, my]: Vec2, [x, y]: Vec2, turn: number): Vec2[] {
  const [c, s] = [Math.cos(turn), Math.sin(turn)];
  return polygon.map(([u, v]) => [x + c * (u - mx) - s * (v - my), y + s * (u - mx) + c * (v - my)]);
}

export class Yard {
  start: Vec2;
  heading_rad: number;
  targets: YardTarget[];
  things: YardThing[];
  boxes: YardBox[] = [];
  private undone: Changes[] = [];
  private done: Changes[] = [];

  constructor(private scenario: YardScenario) {
    this.start = scenario.start;
    this.heading_rad = scenario.heading_rad;
    this.targets = structuredClone(scenario.targets);
    this.things = structuredClone(scenario.things);
  }

  name({ what, index }: Item): string {
    if (what === "robot") return "robot";
    if (what === "box") return `new obstacle ${index + 1}`;
    return (what === "target" ? this.targets : this.things)[index]!.name;
  }

  middle({ what, index }: Item): Vec2 {
    if (what === "robot") return this.start;
    if (what === "box") return this.boxes[index]!.middle;
    if (what === "thing") return this.things[index]!.place;
    const [x, y] = this.targets[index]!.position;
    return [x, y];
  }

  turn({ what, index }: Item): number {
    if (what === "robot") return this.heading_rad;
    if (what === "target") return this.targets[index]!.heading_rad;
    return (what === "box" ? this.boxes : this.things)[index]!.turn_rad;
  }

  /** Returns the polygons of an item that block the robot, at its current place. */
  outlines({ what, index }: Item): Vec2[][] {
    if (what === "thing") {
      const { polygons, middle, place, turn_rad } = this.things[index]!;
      return polygons.map((polygon) => placed(polygon, middle, place, turn_rad));
    }
    if (what !== "box") return [];
    const { middle, size: [length, width], turn_rad } = this.boxes[index]!;
    const [l, w] = [length / 2, width / 2];
    return [placed([[-l, -w], [l, -w], [l, w], [-l, w]], [0, 0], middle, turn_rad)];
  }

  /** Returns the greatest distance of the item's outline from its middle. */
  radius(item: Item): number {
    const [x, y] = this.middle(item);
    if (item.what === "target") return Math.hypot(this.targets[item.index]!.size[0], this.targets[item.index]!.size[1]) / 2;
    return Math.max(0, ...this.outlines(item).flat().map(([u, v]) => Math.hypot(u - x, v - y)));
  }

  private all(what: Item["what"]): Item[] {
    const list = { robot: [0], target: this.targets, thing: this.things, box: this.boxes }[what];
    return list.map((_: unknown, index: number) => ({ what, index }));
  }

  get obstacles(): Item[] { return [...this.all("thing"), ...this.all("box")]; }

  isRemoved(item: Item): boolean { return item.what === "thing" && this.things[item.index]!.removed; }
  isMoved(item: Item): boolean {
    const thing = item.what === "thing" ? this.things[item.index]! : null;
    return thing !== null && (thing.turn_rad !== 0 || thing.place[0] !== thing.middle[0] || thing.place[1] !== thing.middle[1]);
  }

  /**
   * Returns the item at a place: the robot or a target within reach, else an obstacle; the smallest if several overlap.
   */
  at(place: Vec2, reach: number): Item | null {
    const away = (item: Item): number => Math.hypot(this.middle(item)[0] - place[0], this.middle(item)[1] - place[1]);
    const signs = [...this.all("robot"), ...this.all("target")].filter((item) => away(item) <= reach);
    if (signs.length > 0) return signs.reduce((best, item) => (away(item) < away(best) ? item : best));
    const under = this.obstacles.filter((item) => this.outlines(item).some((polygon) => nearestOnPolygon(...place, polygon).distance <= 0));
    return under.reduce<Item | null>((best, item) => (best === null || this.radius(item) <= this.radius(best) ? item : best), null);
  }

  /** Returns the item that follows `after` in the list; the list wraps around. */
  next(kinds: Item[], after: Item | null): Item | null {
    const present = kinds.findIndex((item) => item.what === after?.what && item.index === after.index);
    return kinds[(present + 1) % kinds.length] ?? null;
  }
  nextTarget(after: Item | null): Item | null { return this.next(this.all("target"), after); }
  nextObstacle(after: Item | null): Item | null { return this.next(this.obstacles, after); }

  // Changes.

  moveTo(item: Item, [x, y]: Vec2): void {
    if (item.what === "robot") this.start = [x, y];
    else if (item.what === "box") this.boxes[item.index]!.middle = [x, y];
    else if (item.what === "thing") this.things[item.index]!.place = [x, y];
    else this.targets[item.index]!.position = [x, y, this.targets[item.index]!.position[2]];
  }

  turnTo(item: Item, angle: number): void {
    const turn = wrapAngle(angle);
    if (item.what === "robot") this.heading_rad = turn;
    else if (item.what === "target") this.targets[item.index]!.heading_rad = turn;
    else (item.what === "box" ? this.boxes : this.things)[item.index]!.turn_rad = turn;
  }

  addTarget(at: Vec2): Item {
    this.targets.push({ name: newName(this.targets), position: [...at, 0], size: cat, heading_rad: 0 });
    return { what: "target", index: this.targets.length - 1 };
  }

  addBox(middle: Vec2): Item {
    this.boxes.push({ middle, size: [1, 1], turn_rad: 0 });
    return { what: "box", index: this.boxes.length - 1 };
  }

  /**
   * Removes a target or an added obstacle; a thing of the world is removed, or restored if it was. Returns the item
   * that stays selected.
   */
  remove({ what, index }: Item): Item | null {
    if (what === "robot") return { what, index };
    if (what === "thing") {
      this.things[index]!.removed = !this.things[index]!.removed;
      return { what, index };
    }
    (what === "target" ? this.targets : this.boxes).splice(index, 1);
    return null;
  }

  /** Puts a thing back to its place in the world file. */
  putBack(item: Item): void {
    if (item.what !== "thing") return;
    const thing = this.things[item.index]!;
    [thing.place, thing.turn_rad, thing.removed] = [thing.middle, 0, false];
  }

  // Undo.

  private get changes(): Changes {
    const { start, heading_rad, targets, boxes } = this;
    return structuredClone({ start, heading_rad, targets, boxes, things: this.things.map(({ place, turn_rad, removed }) => ({ place, turn_rad, removed })) });
  }

  private take({ start, heading_rad, targets, boxes, things }: Changes): void {
    Object.assign(this, { start, heading_rad, targets, boxes });
    things.forEach((one, i) => Object.assign(this.things[i]!, one));
  }

  /** Saves the state for undo; call it before a change. */
  remember(): void {
    this.done.push(this.changes);
    if (this.done.length > most_steps) this.done.shift();
    this.undone = [];
  }

  /** Undoes the last change, or with `again` redoes it; returns false if there is none. */
  undo(again = false): boolean {
    const [from, to] = again ? [this.undone, this.done] : [this.done, this.undone];
    const before = from.pop();
    if (!before) return false;
    to.push(this.changes);
    this.take(before);
    return true;
  }

  get request(): YardRequest {
    const boxes = this.boxes.map(({ middle: [x, y], size: [l, w], turn_rad }) => [x - l / 2, y - w / 2, x + l / 2, y + w / 2, turn_rad]);
    const targets = this.targets.map(({ name, position: [x, y], heading_rad }) => ({ name, position: [x, y] as Vec2, heading_rad }));
    const things = this.things.filter((one) => !one.removed);
    return { scenario: this.scenario.path, start: this.start, heading_rad: this.heading_rad, targets, boxes,
      moved: things.filter((one) => this.isMoved({ what: "thing", index: this.things.indexOf(one) })).map(({ name, place, turn_rad }) => ({ name, place, turn_rad })),
      removed: this.things.filter((one) => one.removed).map(({ name }) => name) };
  }
}
