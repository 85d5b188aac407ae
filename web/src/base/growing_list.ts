// Elements of a list that mostly grows: those at its front whose items are as they were stay, the rest is made.

export class GrowingList<T> {
  readonly elements: HTMLElement[] = [];
  private keys: string[] = [];

  /** `key` tells items apart whose elements differ; an element knows its item by its place in the list. */
  constructor(private parent: Element, private key: (item: T) => string, private make: (item: T, index: number) => HTMLElement) {}

  show(items: readonly T[]): void {
    const keys = items.map(this.key);
    let same = 0;
    while (same < keys.length && keys[same] === this.keys[same]) same += 1;
    for (const old of this.elements.splice(same)) old.remove();
    const made = items.slice(same).map((item, i) => this.make(item, same + i));
    this.elements.push(...made);
    this.parent.append(...made);
    this.keys = keys;
  }
}
