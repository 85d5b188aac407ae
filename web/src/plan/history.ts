// Steps that can be undone and done again. A step is what takes the work back to where it was before.

/** Takes the work back to a state. */
export type Restore = () => void;

export class History {
  private done: Restore[] = [];
  private undone: Restore[] = [];

  /** `snapshot` returns what takes the work back to its present state. At most `most` steps are kept. */
  constructor(private snapshot: () => Restore, private most = 200) {}

  /** Call it before a change. */
  remember(): void {
    this.done.push(this.snapshot());
    if (this.done.length > this.most) this.done.shift();
    this.undone = [];
  }

  /** Takes back the last change, or does it `again`; returns false if there is none. */
  undo(again = false): boolean {
    const [from, to] = again ? [this.undone, this.done] : [this.done, this.undone];
    const restore = from.pop();
    if (!restore) return false;
    to.push(this.snapshot());
    restore();
    return true;
  }
}
