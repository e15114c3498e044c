// Why the studio cannot start, as a sentence.

/// @param error  that was thrown while the page started
export function troubleOf(error: unknown): { sentence: string; isAboutWork: boolean } {
    const text = error instanceof Error ? error.message : String(error);
    if (typeof WebAssembly === "undefined" || /webassembly|wasm/i.test(text) || (error instanceof Error && error.name === "CompileError")) {
        return {
            sentence:
                "The studio needs WebAssembly, which this browser has turned off for the page. A strict mode of the " +
                "browser, such as Lockdown Mode, an extension or a rule of the server may block it.",
            isAboutWork: false,
        };
    }
    if (typeof Worker === "undefined" || /worker/i.test(text)) {
        return { sentence: "The studio needs web workers, which this browser does not start for the page.", isAboutWork: false };
    }
    return { sentence: `The studio could not start: ${text}`, isAboutWork: true };
}
