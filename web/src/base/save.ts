// Files that the page gives to a person.
import { h } from "./dom";

function saveBlob(blob: Blob, name: string): void {
  const link = h("a", { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

export function saveText(text: string, name: string, type = "application/json"): void {
  saveBlob(new Blob([text], { type }), name);
}

export function saveCanvas(canvas: HTMLCanvasElement, name: string): void {
  canvas.toBlob((blob) => { if (blob) saveBlob(blob, name); }, "image/png");
}
