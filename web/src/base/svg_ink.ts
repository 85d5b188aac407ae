// Ink that writes SVG: drawings become shapes and text; images are embedded as PNG.
import { Path, PathText, type Ink } from "./ink";

type Matrix = [number, number, number, number, number, number];

/** Composes two matrices: the result applies the second one first. */
const product = ([a, b, c, d, e, f]: Matrix, [g, h, i, j, k, l]: Matrix): Matrix =>
  [a * g + c * h, b * g + d * h, a * i + c * j, b * i + d * j, a * k + c * l + e, b * k + d * l + f];

interface State {
  matrix: Matrix;
  clip: string;
  fillStyle: Ink["fillStyle"];
  strokeStyle: Ink["strokeStyle"];
  lineWidth: number;
  lineCap: CanvasLineCap;
  lineJoin: CanvasLineJoin;
  dash: number[];
  globalAlpha: number;
  font: string;
  textAlign: CanvasTextAlign;
  textBaseline: CanvasTextBaseline;
  imageSmoothingEnabled: boolean;
}

const escaped = (text: string): string => text.replace(/[&<>"]/g, (one) => `&#${one.charCodeAt(0)};`);
const number = (value: number): string => String(+value.toFixed(4));
const anchors: Partial<Record<CanvasTextAlign, string>> = { center: "middle", right: "end", end: "end" };

export class SvgInk implements Ink {
  private shapes: string[] = [];
  private clips = 0;
  private kept: State[] = [];
  private path: PathText;
  private probe: CanvasRenderingContext2D;
  private colours = new Map<string, [string, number]>();
  private state: State = { matrix: [1, 0, 0, 1, 0, 0], clip: "", fillStyle: "#000", strokeStyle: "#000", lineWidth: 1, lineCap: "butt",
    lineJoin: "miter", dash: [], globalAlpha: 1, font: "10px sans-serif", textAlign: "start", textBaseline: "alphabetic", imageSmoothingEnabled: true };

  /** Draws in the pixel coordinates of a canvas, which sets the size. */
  constructor(readonly canvas: HTMLCanvasElement) {
    const probe = document.createElement("canvas");
    probe.width = probe.height = 1;
    this.probe = probe.getContext("2d", { willReadFrequently: true })!;
    this.path = this.begun();
  }

  /** Returns the drawing as SVG, `width` screen pixels wide. */
  text(width: number): string {
    const { width: w, height: h } = this.canvas;
    return `<svg xmlns="http://www.w3.org/2000/svg" width="${number(width)}" height="${number(width * h / w)}" viewBox="0 0 ${w} ${h}">\n`
      + `${this.shapes.join("\n")}\n</svg>\n`;
  }

  get fillStyle(): Ink["fillStyle"] { return this.state.fillStyle; }
  set fillStyle(value) { this.state.fillStyle = value; }
  get strokeStyle(): Ink["strokeStyle"] { return this.state.strokeStyle; }
  set strokeStyle(value) { this.state.strokeStyle = value; }
  get lineWidth(): number { return this.state.lineWidth; }
  set lineWidth(value) { this.state.lineWidth = value; }
  get lineCap(): CanvasLineCap { return this.state.lineCap; }
  set lineCap(value) { this.state.lineCap = value; }
  get lineJoin(): CanvasLineJoin { return this.state.lineJoin; }
  set lineJoin(value) { this.state.lineJoin = value; }
  get globalAlpha(): number { return this.state.globalAlpha; }
  set globalAlpha(value) { this.state.globalAlpha = value; }
  get font(): string { return this.state.font; }
  set font(value) { this.state.font = value; }
  get textAlign(): CanvasTextAlign { return this.state.textAlign; }
  set textAlign(value) { this.state.textAlign = value; }
  get textBaseline(): CanvasTextBaseline { return this.state.textBaseline; }
  set textBaseline(value) { this.state.textBaseline = value; }
  get imageSmoothingEnabled(): boolean { return this.state.imageSmoothingEnabled; }
  set imageSmoothingEnabled(value) { this.state.imageSmoothingEnabled = value; }
  setLineDash(dash: Iterable<number>): void { this.state.dash = [...dash]; }

  save(): void { this.kept.push({ ...this.state }); }
  restore(): void { this.state = this.kept.pop() ?? this.state; }
  setTransform(a?: number | DOMMatrix2DInit, b = 0, c = 0, d = 1, e = 0, f = 0): void {
    if (typeof a === "number") this.state.matrix = [a, b, c, d, e, f];
  }
  private turn(by: Matrix): void { this.state.matrix = product(this.state.matrix, by); }
  translate(x: number, y: number): void { this.turn([1, 0, 0, 1, x, y]); }
  scale(x: number, y: number): void { this.turn([x, 0, 0, y, 0, 0]); }
  rotate(angle: number): void { this.turn([Math.cos(angle), Math.sin(angle), -Math.sin(angle), Math.cos(angle), 0, 0]); }

  private begun(): PathText {
    return new PathText((x, y) => {
      const [a, b, c, d, e, f] = this.state.matrix;
      return [a * x + c * y + e, b * x + d * y + f];
    });
  }
  beginPath(): void { this.path = this.begun(); }
  closePath(): void { this.path.closePath(); }
  moveTo(x: number, y: number): void { this.path.moveTo(x, y); }
  lineTo(x: number, y: number): void { this.path.lineTo(x, y); }
  rect(x: number, y: number, width: number, height: number): void { this.path.rect(x, y, width, height); }
  arc(x: number, y: number, radius: number, from: number, to: number): void { this.path.ellipse(x, y, radius, radius, 0, from, to); }
  ellipse(x: number, y: number, across: number, tall: number, turn: number, from: number, to: number): void {
    this.path.ellipse(x, y, across, tall, turn, from, to);
  }

  fill(path?: Path): void { this.draw(path, this.paint("fill", this.state.fillStyle)); }
  stroke(path?: Path): void {
    // A path argument is drawn with the matrix, including the pen; the current path is already in pixels.
    const [a, b] = this.state.matrix;
    this.draw(path, `fill="none" ${this.pen(path ? 1 : Math.hypot(a, b))}`);
  }
  clip(): void {
    const name = `clip${++this.clips}`;
    this.shapes.push(`<clipPath id="${name}"${this.within()}><path d="${this.path.d}"/></clipPath>`);
    this.state.clip = name;
  }
  fillRect(x: number, y: number, width: number, height: number): void {
    this.put(`<path d="${rectangle(x, y, width, height)}" ${this.paint("fill", this.state.fillStyle)}`);
  }
  strokeRect(x: number, y: number, width: number, height: number): void {
    this.put(`<path d="${rectangle(x, y, width, height)}" fill="none" ${this.pen(1)}`);
  }
  fillText(words: string, x: number, y: number): void { this.write(words, x, y, this.paint("fill", this.state.fillStyle)); }
  strokeText(words: string, x: number, y: number): void { this.write(words, x, y, `fill="none" ${this.pen(1)}`); }
  measureText(words: string): TextMetrics {
    this.probe.font = this.state.font;
    return this.probe.measureText(words);
  }
  drawImage(image: HTMLCanvasElement, x: number, y: number): void {
    const { imageSmoothingEnabled: smooth, globalAlpha } = this.state;
    this.put(`<image href="${image.toDataURL("image/png")}" x="${number(x)}" y="${number(y)}" width="${image.width}" height="${image.height}"`
      + `${smooth ? "" : ' style="image-rendering:pixelated"'} opacity="${number(globalAlpha)}"`);
  }

  private draw(path: Path | undefined, paint: string): void {
    if (path) this.put(`<path d="${path.d}" ${paint}`);
    else if (this.path.d) this.shapes.push(`<path d="${this.path.d}" ${paint}${this.within()}/>`);
  }

  private write(words: string, x: number, y: number, paint: string): void {
    const { font, textAlign } = this.state;
    this.put(`<text x="${number(x)}" y="${number(y + this.drop())}" style="font:${escaped(font)};white-space:pre" text-anchor="${anchors[textAlign] ?? "start"}" ${paint}`,
      `${escaped(words)}</text>`);
  }

  /** Returns the offset from the text baseline in use to the alphabetic one, which every SVG reader supports. */
  private drop(): number {
    this.probe.font = this.state.font;
    const ascent = (line: CanvasTextBaseline): number => {
      this.probe.textBaseline = line;
      return this.probe.measureText("x").fontBoundingBoxAscent;
    };
    return ascent("alphabetic") - ascent(this.state.textBaseline);
  }

  /** Adds an element with the current matrix. */
  private put(open: string, rest = ""): void {
    const matrix = this.state.matrix.map((value) => +value.toPrecision(8)).join(" ");
    this.shapes.push(`${open} transform="matrix(${matrix})"${rest ? `>${rest}` : "/>"}`);
    if (this.state.clip) this.shapes.push(`<g${this.within()}>${this.shapes.pop()!}</g>`);
  }

  private within(): string { return this.state.clip ? ` clip-path="url(#${this.state.clip})"` : ""; }

  private paint(what: "fill" | "stroke", style: Ink["fillStyle"]): string {
    const [colour, opacity] = this.colour(style);
    return `${what}="${colour}" ${what}-opacity="${number(opacity * this.state.globalAlpha)}"`;
  }

  private pen(scale: number): string {
    const { strokeStyle, lineWidth, lineCap, lineJoin, dash } = this.state;
    const dashes = dash.length > 0 ? ` stroke-dasharray="${dash.map((one) => number(one * scale)).join(" ")}"` : "";
    return `${this.paint("stroke", strokeStyle)} stroke-width="${number(lineWidth * scale)}" stroke-linecap="${lineCap}" stroke-linejoin="${lineJoin}"${dashes}`;
  }

  /** Converts any CSS colour to a form that every SVG version reads, by sampling one pixel of it. */
  private colour(style: Ink["fillStyle"]): [string, number] {
    if (typeof style !== "string") return ["none", 1];
    let found = this.colours.get(style);
    if (!found) {
      this.probe.clearRect(0, 0, 1, 1);
      this.probe.fillStyle = style;
      this.probe.fillRect(0, 0, 1, 1);
      const [r = 0, g = 0, b = 0, a = 0] = this.probe.getImageData(0, 0, 1, 1).data;
      found = [`#${[r, g, b].map((value) => value.toString(16).padStart(2, "0")).join("")}`, a / 255];
      this.colours.set(style, found);
    }
    return found;
  }
}

const rectangle = (x: number, y: number, width: number, height: number): string =>
  `M${number(x)} ${number(y)}h${number(width)}v${number(height)}h${number(-width)}Z`;
