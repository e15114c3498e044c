import type { MakePanel } from "./context";

export const makeVariationsPanel: MakePanel = () => ({
    name: "variations", label: "Variations", element: document.createElement("div"), show() {}, hide() {},
});
