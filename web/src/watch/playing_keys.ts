// The keys that play, step and seek.
import type { Key } from "../base/keys";
import type { Clock } from "./clock";

/** `step` goes to the next or the previous event. */
export const playingKeys = (clock: Clock, step: (direction: 1 | -1) => void): Key[] => [
  { key: " ", words: "play or pause", act: () => clock.toggle() },
  { key: "ArrowLeft", words: "1 s back", act: () => clock.seek(clock.t - 1) },
  { key: "ArrowRight", words: "1 s on", act: () => clock.seek(clock.t + 1) },
  { key: "Shift+ArrowLeft", words: "10 s back", act: () => clock.seek(clock.t - 10) },
  { key: "Shift+ArrowRight", words: "10 s on", act: () => clock.seek(clock.t + 10) },
  { key: ",", words: "a frame back", act: () => clock.seek(clock.t - 0.05) },
  { key: ".", words: "a frame on", act: () => clock.seek(clock.t + 0.05) },
  { key: "p", words: "previous event", act: () => step(-1) },
  { key: "n", words: "next event", act: () => step(1) },
  { key: "Home", words: "to the start", act: () => clock.seek(0) },
  { key: "End", words: "to the end", act: () => clock.follow() },
  ...(clock.goesOn ? [{ key: "l", words: "keep to what happens now", act: () => clock.follow() }] : []),
  { key: "<", words: "slower", act: () => clock.shift(-1) },
  { key: ">", words: "faster", act: () => clock.shift(1) },
];
