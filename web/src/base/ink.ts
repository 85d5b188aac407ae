// The drawing interface: the part of a canvas context that can also be written as SVG.

type Same = "save" | "restore" | "setTransform" | "translate" | "rotate" | "scale" | "beginPath" | "closePath" | "moveTo" | "lineTo"
  | "rect" | "fillRect" | "strokeRect" | "fillText" | "strokeText" | "measureText" | "setLineDash" | "lineWidth" | "lineCap" | "lineJoin"
  | "globalAlpha" | "font" | "textAlign" | "textBaseline" | "imageSmoothingEnabled" | "canvas";

export interface Ink extends Pick<CanvasRenderingContext2D, Same> {
  fillStyle: CanvasRenderingContext2D["fillStyle"];
  strokeStyle: CanvasRenderingContext2D["strokeStyle"];
  arc(x: number, y: number, radius: number, from: number, to: number): void;
  ellipse(x: number, y: number, across: number, tall: number, turn: number, from: number, to: number): void;
  fill(): void;
  fill(path: Path): void;
  stroke(): void;
  stroke(path: Path): void;
  clip(): void;
  drawImage(image: HTMLCanvasElement, x: number, y: number): void;
}

/**
 * Approximates an arc of an ellipse by cubic curves of at most a quarter turn; the error is below 0.0003 of its radius.
 */
export function arcCurves(x: number, y: number, across: number, tall: number, turn: number, from: number, to: number): number[][] {
  const whole = to - from >= 2 * Math.PI ? 2 * Math.PI : (to - from) % (2 * Math.PI);
  const sweep = whole < 0 ? whole + 2 * Math.PI : whole;  // like a canvas, towards larger angles
  const pieces = Math.max(1, Math.ceil(sweep / (Math.PI / 2) - 1e-9));
  const reach = (4 / 3) * Math.tan(sweep / pieces / 4);
  const [cos, sin] = [Math.cos(turn), Math.sin(turn)];
  const at = (u: number, v: number): [number, number] => [x + across * u * cos - tall * v * sin, y + across * u * sin + tall * v * cos];
  return Array.from({ length: pieces }, (_, i) => {
    const [a, b] = [from + (sweep * i) / pieces, from + (sweep * (i + 1)) / pieces];
    const [ca, sa, cb, sb] = [Math.cos(a), Math.sin(a), Math.cos(b), Math.sin(b)];
    return [...at(ca, sa), ...at(ca - reach * sa, sa + reach * ca), ...at(cb + reach * sb, sb - reach * cb), ...at(cb, sb)];
  });
}

type Place = (x: number, y: number) => [number, number];
const text = (numbers: number[]): string => numbers.map((value) => +value.toFixed(4)).join(" ");

/** Records a path as the `d` attribute of SVG, with each point transformed by `place`. */
export class PathText {
  private parts: string[] = [];
  private begun = false;

  constructor(private place: Place = (x, y) => [x, y]) {}

  get d(): string { return this.parts.join(""); }

  moveTo(x: number, y: number): void {
    this.parts.push(`M${text(this.place(x, y))}`);
    this.begun = true;
  }
  lineTo(x: number, y: number): void {
    if (this.begun) this.parts.push(`L${text(this.place(x, y))}`);
    else this.moveTo(x, y);
  }
  ellipse(x: number, y: number, across: number, tall: number, turn: number, from: number, to: number): void {
    for (const [x0, y0, ...rest] of arcCurves(x, y, across, tall, turn, from, to)) {
      this.lineTo(x0!, y0!);
      this.parts.push(`C${[0, 2, 4].map((k) => text(this.place(rest[k]!, rest[k + 1]!))).join(" ")}`);
    }
  }
  rect(x: number, y: number, width: number, height: number): void {
    this.moveTo(x, y);
    for (const [u, v] of [[x + width, y], [x + width, y + height], [x, y + height]] as const) this.lineTo(u, v);
    this.closePath();
  }
  closePath(): void { this.parts.push("Z"); }
}

const Native = globalThis.Path2D ?? class {};  // the unit tests run without a browser

/** Is a Path2D whose lines can be read back. */
export class Path extends Native {
  private lines = new PathText();

  constructor(private given = "") {
    super(given);
  }

  get d(): string { return this.given + this.lines.d; }

  override moveTo(x: number, y: number): void { super.moveTo(x, y); this.lines.moveTo(x, y); }
  override lineTo(x: number, y: number): void { super.lineTo(x, y); this.lines.lineTo(x, y); }
  override rect(x: number, y: number, width: number, height: number): void { super.rect(x, y, width, height); this.lines.rect(x, y, width, height); }
  override arc(x: number, y: number, radius: number, from: number, to: number): void {
    super.arc(x, y, radius, from, to);
    this.lines.ellipse(x, y, radius, radius, 0, from, to);
  }
  override closePath(): void { super.closePath(); this.lines.closePath(); }
}
