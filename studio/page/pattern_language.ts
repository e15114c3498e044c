// Syntax highlighting of patterns: the kind of each part of a line. Only the libraries parse the language.
import { HighlightStyle, StreamLanguage, type StreamParser, type StringStream } from "@codemirror/language";
import { Tag, tags } from "@lezer/highlight";

const parts = {
    patternKey: Tag.define(),
    draw: Tag.define(),
    turn: Tag.define(),
    branch: Tag.define(),
    arrow: Tag.define(),
    word: Tag.define(),
};

type LineKind = "empty" | "key" | "word" | "production" | "define" | "section" | "other";

/// The kind of a line. Values of some keys are words of symbols, coloured like productions.
function kindOf(line: string): LineKind {
    if (/^\s*(\/\/|$)/.test(line)) return "empty";
    if (line.includes("-->")) return "production";
    if (/^\s*define\s/.test(line)) return "define";
    if (/^\s*(table\s+[^:]*|interpret\s*|variant\s+[^:]*):/.test(line)) return "section";
    if (/^\s*axiom\s*:/.test(line)) return "word";
    return /^\s*[\p{L} -]+:/u.test(line) ? "key" : "other";
}

interface State {
    kind: LineKind;
    continues: boolean; // the line before ends in a backslash
    isComment: boolean; // between /* and */
    isNamed: boolean; // the name before the colon has been read
    depth: number; // of parentheses
}

function readName(stream: StringStream, state: State): string {
    state.isNamed = true;
    stream.match(state.kind === "define" ? /^\s*define/ : /^[^:]*:/);
    return "patternKey";
}

function readSymbol(stream: StringStream, state: State): string | null {
    if (stream.match("-->")) return "arrow";
    const symbol = stream.next()!;
    if (symbol === "(") ++state.depth;
    if (symbol === ")") state.depth = Math.max(0, state.depth - 1);
    if (symbol === "(" || symbol === ")") return "number";
    if (state.depth > 0) {
        if (/[\d.]/.test(symbol)) stream.match(/^[\d.]+/);
        return "number";
    }
    if (symbol === "@") {
        stream.next();
        return "draw";
    }
    if (/[Ff]/.test(symbol)) return "draw";
    if ("+-&^\\/|$".includes(symbol)) return "turn";
    return "[]{}%".includes(symbol) ? "branch" : "word";
}

function readValue(stream: StringStream): string | null {
    if (stream.match(/^#[\da-fA-F]{3,8}\b/)) return "draw";
    if (stream.match(/^-?(\d+\.?\d*|\.\d+)/)) return "number";
    if (stream.match(/^[\p{L}_][\p{L}\d_-]*/u)) return "word";
    stream.next();
    return null;
}

const parser: StreamParser<State> = {
    name: "pattern",
    startState: () => ({ kind: "empty", continues: false, isComment: false, isNamed: false, depth: 0 }),
    token(stream, state) {
        if (stream.sol() && !state.isComment) {
            if (!state.continues) Object.assign(state, { kind: kindOf(stream.string), isNamed: false, depth: 0 });
            state.continues = /\s\\\s*$/.test(stream.string);
        }
        if (state.isComment || stream.match("/*")) {
            state.isComment = !stream.match(/^.*?\*\//);
            if (state.isComment) stream.skipToEnd();
            return "comment";
        }
        if (stream.sol() && stream.match(/^\s*\/\/.*/)) return "comment";
        if (stream.eatSpace()) return null;
        if (!state.isNamed && ["key", "word", "section", "define"].includes(state.kind)) return readName(stream, state);
        if (state.kind === "word" || state.kind === "production") return readSymbol(stream, state);
        return readValue(stream);
    },
    languageData: {
        commentTokens: { line: "//", block: { open: "/*", close: "*/" } },
        closeBrackets: { brackets: ["(", "["] },
    },
    tokenTable: { ...parts, comment: tags.comment, number: tags.number },
};

export const pattern_language = StreamLanguage.define(parser);

export const pattern_colours = HighlightStyle.define([
    { tag: parts.patternKey, color: "var(--code-key)", fontWeight: "600" },
    { tag: parts.draw, color: "var(--code-draw)", fontWeight: "600" },
    { tag: parts.turn, color: "var(--code-turn)" },
    { tag: parts.branch, color: "var(--code-branch)" },
    { tag: parts.arrow, color: "var(--code-arrow)", fontWeight: "600" },
    { tag: parts.word, color: "var(--code-word)" },
    { tag: tags.number, color: "var(--code-number)" },
    { tag: tags.comment, color: "var(--code-comment)", fontStyle: "italic" },
]);
