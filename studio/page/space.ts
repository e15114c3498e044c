import type { MakePanel } from "./context";

export const makeSpacePanel: MakePanel = () => ({
    name: "space", label: "Space", element: document.createElement("div"), show() {}, hide() {},
});
