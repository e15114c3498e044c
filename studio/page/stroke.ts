// The parts of a value of `stroke:`, such as `0.4mm navy`.

export function splitStroke(value: string): { width: string; unit: string; rest: string } {
    const parts = /^\s*(\d*\.?\d+)\s*(mm|cm|in|pt|px|step)?\s*(.*)$/.exec(value);
    return parts
        ? { width: parts[1]!, unit: parts[2] ?? "mm", rest: parts[3]! }
        : { width: "", unit: "mm", rest: value.trim() };
}

export function joinedStroke(width: string, unit: string, rest: string): string {
    return `${width}${unit === "step" ? " step" : unit} ${rest}`.trim();
}
