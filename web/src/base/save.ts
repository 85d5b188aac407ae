// Saves files from the page to the user's disk.
import { h } from "./dom";

export function saveBlob(blob: Blob, name: string): void {
  const link = h("a", { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);  // a busy browser starts the download late
}

export function saveText(text: string, name: string, type = "application/json"): void {
  saveBlob(new Blob([text], { type }), name);
}

export function pngOf(canvas: HTMLCanvasElement): Promise<Blob> {
  return new Promise((done, fail) => {
    canvas.toBlob((blob) => (blob ? done(blob) : fail(new Error("the browser made no picture of this view"))), "image/png");
  });
}

export function saveCanvas(canvas: HTMLCanvasElement, name: string): void {
  void pngOf(canvas).then((blob) => saveBlob(blob, name));
}
