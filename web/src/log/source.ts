// Sources of the bytes of a log: memory, disk, or a server that sends the parts that are asked for.

export interface Source {
  readonly size: number;
  read(from: number, to: number): Promise<Uint8Array>;
  /** All of it, to be saved. */
  whole(): Promise<Blob>;
}

export const sourceOf = (blob: Blob): Source => ({
  size: blob.size,
  read: async (from, to) => new Uint8Array(await blob.slice(from, to).arrayBuffer()),
  whole: () => Promise.resolve(blob),
});
