// Corrections that the libraries' messages name: lines in other notations (`F → F+F`) and misspelt keys.

/// The line as a message proposes it, perhaps as several lines; null if it proposes none, or not all of it.
export function correctedLine(line: string, message: string): string | null {
    const indent = /^\s*/.exec(line)![0];
    const one = /; write '([^]*?)'(?:$|; in another: )/.exec(message);
    if (one) return /…$/.test(one[1]!) ? null : indent + one[1]!;
    const several = /; write each in its own line: ('.*')$/.exec(message);
    if (several) return [...several[1]!.matchAll(/'(.*?)'(?:, |$)/g)].map((each) => indent + each[1]!).join("\n");
    if (/; leave this line out(;|$)/.test(message)) return "";
    const name = /^unknown key '(.+?)'; did you mean '([^']+)'\?$/.exec(message);
    if (name && line.trimStart().startsWith(name[1]!)) return line.replace(name[1]!, () => name[2]!);
    return null;
}
