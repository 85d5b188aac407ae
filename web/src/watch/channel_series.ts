// Any number of any channel as a plot: "/pose:pose.position.x".
import type { Colour } from "../base/theme";
import { numberAt, numericPaths } from "../log/fields";
import type { Run } from "../log/run";
import type { Series } from "./plotted";

const colours: Colour[] = ["water", "failed", "reached", "belief", "unreachable", "robot"];

/** Returns the numbers of a run that can be plotted: its topics, each with the paths of its numbers. */
export function channelsOf({ log }: Run): { topic: string; paths: string[] }[] {
  return [...log.channels.values()].filter(({ topic, count }) => count > 1 && !log.isLazy(topic))
    .map(({ topic, sample }) => ({ topic, paths: numericPaths(sample) })).filter(({ paths }) => paths.length > 0);
}

/** The plots that were chosen; one that this run has no channel for is left out. */
export function channelSeries({ log }: Run, chosen: readonly string[]): Series[] {
  return chosen.flatMap((one, i) => {
    const [topic = "", path = ""] = one.split(/:(.*)/s);
    const messages = log.isLazy(topic) ? [] : log.messages(topic);
    if (messages.length === 0) return [];
    return [{ title: path.replaceAll(".", " "), unit: topic, key: one, time: messages.map(({ t }) => t),
      lines: [{ name: path.split(".").at(-1)!, colour: colours[i % colours.length]!, values: messages.map(({ message }) => numberAt(message, path)), steps: true }] }];
  });
}
