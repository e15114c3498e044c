import type { MakePanel } from "./context";

export const makePlayPanel: MakePanel = () => ({
    name: "play", label: "Play", element: document.createElement("div"), show() {}, hide() {},
});
