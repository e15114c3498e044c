import type { MakePanel } from "./context";

export const makeBenchPanel: MakePanel = () => ({
    name: "bench", label: "Kolam bench", element: document.createElement("div"), show() {}, hide() {},
});
