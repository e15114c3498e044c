import type { MakePanel } from "./context";

export const makeMapPanel: MakePanel = () => ({
    name: "map", label: "Picture", element: document.createElement("div"), show() {}, hide() {},
});
