// The options that change how the curve becomes notes.
import { optionField, type OptionAct } from "../option_fields";
import { offered } from "../option_scopes";
import { optionOf } from "../options";
import type { Help, Options } from "../protocol";

const names = "scale tonic instrument unit meter mapping vertical runs velocity range transpose bars".split(" ");

/// Shows the fields, the most important first, unless one of them is being edited.
export function showReading(place: HTMLElement, help: Help, options: Options, act: OptionAct): void {
    if (place.contains(document.activeElement)) return;
    const rows = names.flatMap((name) => offered(help, help.play.options).filter((option) => option.name === name));
    place.replaceChildren(...rows.map((option) => optionField(option, optionOf(options, option.name), act)));
}
