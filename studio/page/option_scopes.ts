// Selects options by their scopes in the libraries' table.
import type { Help, OptionHelp, Options } from "./protocol";

/// The options of prints for which `choose` is true. Keys and defines of the pattern have the scope `look`.
function chosen(help: Help, options: Options, choose: (scope: string, row?: OptionHelp) => boolean): Options {
    return options.filter(([name]) => {
        const row = help.draw.options.find((each) => each.name === name);
        return choose(row?.scope ?? "look", row);
    });
}

export function hasScope(help: Help, options: Options, scope: string): boolean {
    return chosen(help, options, (each) => each === scope).length > 0;
}

/// Options that pictures of the page depend on: answer_pixels() ignores the others.
export function pageOptions(help: Help, options: Options): Options {
    const scopes = new Set("look turn space kolam cost page place scale extras copies".split(" "));
    return chosen(help, options, (scope) => scopes.has(scope));
}

/// Options that also apply to a part of the plane.
export function planeOptions(help: Help, options: Options): Options {
    const scopes = new Set(["look", "kolam", "cost"]);
    return chosen(help, options, (scope, row) => scopes.has(scope) && !row?.sets_scale);
}

/// Options that a model in space depends on.
export function modelOptions(help: Help, options: Options): Options {
    return chosen(help, options, (scope) => scope === "look" || scope === "cost");
}

/// Options of thumbnails, which have a page of their own.
export function thumbnailOptions(help: Help, options: Options): Options {
    const scopes = new Set(["look", "turn", "space", "kolam", "place", "copies"]);
    return chosen(help, options, (scope, row) => scopes.has(scope) && !row?.sets_scale);
}

/// Options with fields. The page itself sets the part of the drawing that is seen, limits, and keys such
/// as the seed; keys of the style belong to the text.
export function offered(help: Help, options: OptionHelp[]): OptionHelp[] {
    const own = new Set(["framing", "threads", "cost"]);
    const isOfEngine = (name: string) => help.keys.some((key) => key.owner === "engine" && key.name === name);
    return options.filter(({ name, scope, group }) => !own.has(scope) && group !== "Style" && !isOfEngine(name));
}
