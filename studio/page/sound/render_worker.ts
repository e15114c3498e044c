// A worker that renders timbres.
import { renderTimbre, timbreNamed } from "./timbres";

export interface RenderRequest {
    timbre: string;
    key: number;
    rate: number;
}
export interface Rendered extends RenderRequest {
    data: Float32Array<ArrayBuffer>;
    frequency: number;
    loops: boolean;
}

onmessage = (event: MessageEvent<RenderRequest>) => {
    const { timbre, key, rate } = event.data;
    const sample = renderTimbre(timbreNamed(timbre), key, rate);
    const rendered = { ...event.data, ...sample } as Rendered;
    (postMessage as (message: Rendered, transfer: Transferable[]) => void)(rendered, [rendered.data.buffer]);
};
