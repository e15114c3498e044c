// Models of a pattern at each derivation length, made on demand and cached.
import { RequestFailed, type Engine, type Work } from "./context";
import { readModel } from "./glb";
import { isAbort } from "./pictures";
import { modelOptions } from "./option_scopes";
import { withOption } from "./options";
import type { Help, Made, PatternRequest } from "./protocol";
import { Recent } from "./recent";
import type { Stage, Staged } from "./space_stage";

const mostBytes = 48 * 1024 * 1024;

/// The model at a derivation length; `empty`: nothing is drawn.
export type Grown = Staged | "empty";

export class Growth {
    private readonly models = new Recent<{ model: Grown; bytes: number; close(): void }>(mostBytes);

    constructor(private readonly engine: Engine, private readonly help: Help, private readonly stage: Stage) {}

    /// Everything that models of the work depend on, except the derivation length.
    static subject(help: Help, work: Work): { pattern: PatternRequest; options: [string, string][]; name: string } {
        const settings = withOption(work.pattern.settings, "derivation length", null);
        const options = modelOptions(help, work.draw);
        const pattern = { ...work.pattern, settings };
        return { pattern, options, name: JSON.stringify([pattern, options]) };
    }

    /// The cached model, if any.
    kept(work: Work, n: number): Grown | undefined {
        return this.models.get(`${n} ${Growth.subject(this.help, work).name}`)?.model;
    }

    /// @throws the error of the libraries if the drawing has no model
    async make(work: Work, n: number, options: { key: string; isAhead?: boolean }): Promise<Grown> {
        const kept = this.kept(work, n);
        if (kept) return kept;
        const { pattern, options: settings, name } = Growth.subject(this.help, work);
        const numbered = { ...pattern, settings: withOption(pattern.settings!, "derivation length", String(n)) };
        let model: Grown;
        try {
            const { bytes } = await this.engine.request<Made>(
                { do: "make", interpreter: "draw", format: "glb", options: settings, pattern: numbered },
                { key: options.key, lane: options.isAhead ? "back" : "front" },
            );
            model = this.stage.add(readModel(bytes));
        } catch (error) {
            if (isAbort(error) || !(error instanceof RequestFailed) || !isEmpty(error)) throw error;
            model = "empty";
        }
        this.keep(`${n} ${name}`, model);
        return model;
    }

    private keep(name: string, model: Grown): void {
        if (this.models.has(name)) return;
        if (model === "empty") this.models.add(name, { model, bytes: 0, close: () => {} });
        else this.models.add(name, { model, bytes: model.bytes, close: () => this.stage.remove(model) });
    }
}

function isEmpty({ message }: RequestFailed): boolean {
    return message.startsWith("nothing to draw") || message.startsWith("nothing to model");
}
