// A picture of what does not move in a view of the plane, painted once. A view that only slides, as one that follows the robot, takes it
// from a picture that is larger than the view; it is painted again when the view comes to its edge, or has another scale.
import type { Camera } from "../base/camera";

/** How far the picture reaches beyond a view that was moved, as a part of its size. */
const beyond = 0.25;

export class StillPicture {
  private canvas = document.createElement("canvas");
  private drawn: { x: number; y: number; scale: number; width: number; height: number } | null = null;

  /** `paint` paints onto a context for a camera. */
  constructor(private camera: Camera, private paint: (ctx: CanvasRenderingContext2D, camera: Camera) => void) {}

  /** From now on it looks otherwise. */
  forget(): void { this.drawn = null; }

  /** Puts the picture onto the whole view. */
  put(ctx: CanvasRenderingContext2D): void {
    const { camera } = this;
    if (!this.covers()) this.repaint();
    const { x, y } = this.drawn!;
    ctx.setTransform(1, 0, 0, 1, 0, 0);
    ctx.drawImage(this.canvas, Math.round((camera.x - x) * camera.dpr), Math.round((camera.y - y) * camera.dpr));
  }

  private covers(): boolean {
    const { camera, drawn, canvas } = this;
    const { width, height } = camera.canvas;
    if (!drawn || drawn.scale !== camera.scale || drawn.width !== width || drawn.height !== height) return false;
    const [left, top] = [Math.round((camera.x - drawn.x) * camera.dpr), Math.round((camera.y - drawn.y) * camera.dpr)];
    return left <= 0 && top <= 0 && left + canvas.width >= width && top + canvas.height >= height;
  }

  private repaint(): void {
    const { camera, canvas } = this;
    const { width, height } = camera.canvas;
    const reach = camera.home ? [0, 0] : [Math.round(beyond * width), Math.round(beyond * height)];
    [canvas.width, canvas.height] = [width + 2 * reach[0]!, height + 2 * reach[1]!];
    const [x, y] = [camera.x + reach[0]! / camera.dpr, camera.y + reach[1]! / camera.dpr];
    const wider = Object.assign(Object.create(camera) as Camera, { x, y, width: canvas.width / camera.dpr, height: canvas.height / camera.dpr });
    this.paint(canvas.getContext("2d")!, wider);
    this.drawn = { x, y, scale: camera.scale, width, height };
  }
}
