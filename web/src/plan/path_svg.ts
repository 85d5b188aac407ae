// The map and its path as an SVG drawing in metres, for papers.
import type { Scene } from "./pane";
import type { Shown } from "./shown";

const digits = (value: number): string => String(+value.toFixed(4));

export function pathSvg(scene: Scene, answer: Shown | null): string {
  const { ground } = scene;
  const [x0, y0, x1, y1] = ground.box;
  const shapes: string[] = [];
  const points = (list: [number, number][]): string => list.map(([x, y]) => `${digits(x)},${digits(-y)}`).join(" ");
  if (ground.kind === "grid") {
    const { width, height, resolution_m: r } = ground.grid;
    for (let y = 0; y < height; ++y) {
      for (let x = 0; x < width; ++x) {
        const value = ground.cells[y * width + x]!;
        if (value === 0) continue;
        let end = x + 1;
        while (end < width && ground.cells[y * width + end] === value) ++end;
        shapes.push(`<rect x="${digits(x0 + x * r)}" y="${digits(-(y0 + (y + 1) * r))}" width="${digits((end - x) * r)}" height="${digits(r)}" fill="${value === 1 ? "#5d6d7a" : "#cfd7dd"}"/>`);
        x = end - 1;
      }
    }
  } else {
    for (const polygon of ground.obstacles) if (polygon) shapes.push(`<polygon points="${points(polygon)}" fill="#5d6d7a"/>`);
  }
  const pen = Math.max(x1 - x0, y1 - y0) / 200;
  if (answer?.waypoints?.length) {
    shapes.push(`<polyline points="${points(answer.waypoints)}" fill="none" stroke="#6b4000" stroke-width="${digits(pen)}" stroke-linejoin="round"/>`);
  }
  for (const [place, colour] of [[scene.start, "#6b4000"], [scene.goal, "#00785a"]] as const) {
    if (!place) continue;
    const [x, y] = place;
    shapes.push(`<circle cx="${digits(x)}" cy="${digits(-y)}" r="${digits(2 * pen)}" fill="${colour}"/>`);
  }
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="${digits(x0)} ${digits(-y1)} ${digits(x1 - x0)} ${digits(y1 - y0)}">\n${shapes.join("\n")}\n</svg>\n`;
}
