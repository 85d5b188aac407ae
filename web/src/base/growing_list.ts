// The elements of a list that mostly grows. Elements at the front with unchanged items stay; the rest is rebuilt.

export class GrowingList<T> {
  readonly elements: HTMLElement[] = [];
  private keys: string[] = [];

  /** `key` distinguishes items whose elements differ. An element finds its item by its index in the list. */
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
