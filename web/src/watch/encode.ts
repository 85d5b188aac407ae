// A film by the encoder of the browser (WebCodecs): the same pictures as the archive of frames has, as one WebM file.
import { frameCount, frameTime, type Range } from "./film";
import { webm, type EncodedFrame } from "./webm";

const keyEvery = 50;  // frames: as far as a player has to go back
const mostWaiting = 8;
const bitsPerPixel = 0.14;

const codecs = [["vp09.00.41.08", "V_VP9"], ["vp8", "V_VP8"]] as const;

/** Returns true if this browser has an encoder here; pages over plain http from another machine have none. */
export const hasEncoder = (): boolean => typeof VideoEncoder !== "undefined";

async function chosenCodec(width: number, height: number, bitrate: number, framerate: number): Promise<{ config: VideoEncoderConfig; name: "V_VP8" | "V_VP9" }> {
  for (const [codec, name] of codecs) {
    const config: VideoEncoderConfig = { codec, width, height, bitrate, framerate };
    if ((await VideoEncoder.isConfigSupported(config)).supported) return { config, name };
  }
  throw new Error("this browser encodes neither VP9 nor VP8; save the frames instead");
}

/** The film of the frames that `draw` draws; null once `goOn`, which hears how many are done, says no. */
export async function encoded(range: Range, draw: (t: number) => HTMLCanvasElement, goOn: (done: number) => boolean): Promise<Blob | null> {
  const count = frameCount(range);
  const { width, height } = draw(range.from);
  const { config, name } = await chosenCodec(width, height, Math.max(1e6, bitsPerPixel * width * height * range.rate), range.rate);
  const frames: EncodedFrame[] = [];
  const faults: Error[] = [];
  const encoder = new VideoEncoder({ error: (error) => faults.push(error), output: (chunk) => {
    const data = new Uint8Array(chunk.byteLength);
    chunk.copyTo(data);
    frames.push({ data, time_ms: chunk.timestamp / 1000, key: chunk.type === "key" });
  } });
  encoder.configure(config);
  try {
    for (let k = 0; k < count; ++k) {
      if (!goOn(k)) return null;
      const frame = new VideoFrame(draw(frameTime(range, k)), { timestamp: Math.round((1e6 * k) / range.rate), duration: Math.round(1e6 / range.rate) });
      encoder.encode(frame, { keyFrame: k % keyEvery === 0 });
      frame.close();
      do await new Promise((done) => setTimeout(done, 0)); while (encoder.encodeQueueSize > mostWaiting && faults.length === 0);
      if (faults.length > 0) throw faults[0]!;
    }
    await encoder.flush();
  } finally {
    if (encoder.state !== "closed") encoder.close();
  }
  return goOn(count) ? new Blob([webm({ codec: name, width, height, duration_ms: (1000 * count) / range.rate }, frames)], { type: "video/webm" }) : null;
}
