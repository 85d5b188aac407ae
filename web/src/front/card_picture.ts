// The picture of a card, made when it first comes into view; an emblem until then, and where there is nothing to draw.
import { emblem } from "../banner";
import { h } from "../base/dom";
import { onTheme } from "../base/theme";
import { drawScene } from "./scene_picture";
import { sceneOf } from "../scenes";

/** How far below the window a picture is made already. */
const ahead = "300px";

export class CardPictures {
  private pictures = new Map<Element, () => void>();
  private seen = new IntersectionObserver((entries) => {
    for (const { isIntersecting, target } of entries) if (isIntersecting) this.make(target);
  }, { rootMargin: ahead });
  private drawn = new Set<() => void>();
  private off = onTheme(() => { for (const draw of this.drawn) draw(); });

  close(): void {
    this.seen.disconnect();
    this.off();
  }

  /** The place of a picture of a scenario. */
  of(path: string): HTMLElement {
    const canvas = h("canvas", { "aria-hidden": "true" });
    const element = h("div", { class: "card-picture" }, emblem(), canvas);
    this.pictures.set(element, () => void sceneOf(path).then((scene) => {
      const draw = (): boolean => scene !== null && canvas.isConnected && drawScene(canvas, scene);
      const done = draw();
      element.classList.add(done ? "drawn" : "bare");
      if (done) this.drawn.add(draw);
    }));
    this.seen.observe(element);
    return element;
  }

  private make(element: Element): void {
    this.seen.unobserve(element);
    this.pictures.get(element)?.();
    this.pictures.delete(element);
  }
}
