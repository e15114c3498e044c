// The words of a command line as the program quotes them: `a`, `'it'\''s'`, `$'two\nlines'`, `--title-line='a b'`.
export function shellWords(line: string): string[] {
    const part = /\$'((?:[^'\\]|\\.)*)'|'([^']*)'|\\(.)|([^\s'\\]+?)(?=\$'|['\\\s]|$)|(\s+)/gy;
    const words: string[] = [];
    let word: string | null = null;
    for (const [, escaped, quoted, one, plain, blank] of line.matchAll(part)) {
        if (blank !== undefined) {
            if (word !== null) words.push(word);
            word = null;
            continue;
        }
        const escapes = /\\(x[0-9a-f]{2}|.)/g;
        const unescaped = escaped?.replace(escapes, (_, code: string) =>
            code === "n" ? "\n" : code.length > 1 ? String.fromCharCode(parseInt(code.slice(1), 16)) : code,
        );
        word = (word ?? "") + (unescaped ?? quoted ?? one ?? plain!);
    }
    if (word !== null) words.push(word);
    return words;
}
