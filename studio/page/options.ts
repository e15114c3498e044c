// Options and settings: lists of names with values.
import type { Options } from "./protocol";

export function optionOf(options: Options, name: string): string | undefined {
    return options.find(([each]) => each === name)?.[1];
}

/// Other options: without one, or with another value of it, which comes last.
export function withOption(options: Options, name: string, value: string | null): Options {
    const others = options.filter(([each]) => each !== name);
    return value === null ? others : [...others, [name, value]];
}
