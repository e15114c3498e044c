// The bundled patterns, and files that are dropped on the page.
import type { MakePanel } from "./context";
import { element } from "./elements";

export const makeGalleryPanel: MakePanel = () => ({
    name: "gallery", label: "Gallery", element: element("div", { class: "gallery" }), show() {}, hide() {},
});
