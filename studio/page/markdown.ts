// Shows the Markdown of the libraries' help: paragraphs and tables with bold text and code.
import { element } from "./elements";

function inline(text: string): (Node | string)[] {
    return text
        .split(/(\*\*.+?\*\*|`` .+? ``|`[^`]+`)/)
        .filter((part) => part !== "")
        .map((part) => {
            if (/^\*\*.+\*\*$/.test(part)) return element("strong", {}, ...inline(part.slice(2, -2)));
            const code = /^`` (.+) ``$/.exec(part) ?? /^`([^`]+)`$/.exec(part);
            return code ? element("code", {}, code[1]!) : part;
        });
}

function table(lines: string[]): HTMLElement {
    const cells = (line: string, name: "td" | "th") =>
        element("tr", {}, ...line.split("|").slice(1, -1).map((cell) => element(name, {}, ...inline(cell.trim()))));
    const [head, , ...rows] = lines;
    return element("table", {}, cells(head!, "th"), ...rows.map((row) => cells(row, "td")));
}

export function fromMarkdown(text: string): HTMLElement[] {
    return text.split(/\n{2,}/).map((block) => {
        const lines = block.split("\n");
        return lines[0]!.startsWith("|") ? table(lines) : element("p", {}, ...inline(lines.join(" ")));
    });
}
