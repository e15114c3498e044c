// The source of a pattern in the command line that makes the same file.
import type { Engine } from "./context";
import { given_kind } from "./given";
import type { Link, PatternEntry, PatternRequest } from "./protocol";

const longest_link = 2000; // characters

/// The name of a bundled pattern if the text is unchanged; otherwise a link that contains the text. For a text
/// that is too long for a link in a command, the name of the file that it is saved as.
export async function commandSource(
    engine: Engine,
    patterns: readonly PatternEntry[],
    { name, text }: PatternRequest,
): Promise<string> {
    const bundled = patterns.find((each) => `${each.name}.lsys` === name && each.kind !== given_kind);
    if (bundled?.text === text) return bundled.name;
    const { json } = await engine.request<Link>(
        { do: "link", shared: { pattern: { name, text } } },
        { key: "command-link" },
    );
    return json.link.length <= longest_link ? `#${json.link}` : name;
}
